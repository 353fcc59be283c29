//! The section `[hazard]`: how the curves combine horizontal components, and what that makes of them.

use uplift_hazard::ComponentDefinition;
use uplift_motion::{Combination, IntensityMeasure};

use super::form::DEFINITIONS;
use super::measures::MEASURES;
use super::reader::{ABOVE_ZERO, Field, Section, optional};

/// What all hazard curves of a study have in common.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hazard {
    /// Definition of the curves whose files do not say it.
    pub component: Option<ComponentDefinition>,
    /// How curves of other definitions than that of the records are used.
    pub conversions: Vec<Conversion>,
}

/// The ratio of the records' definition of a measure over that of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Conversion {
    /// Definition of the curve.
    pub from: ComponentDefinition,
    /// By what its levels are multiplied.
    pub factors: Vec<(IntensityMeasure, f64)>,
}

impl Hazard {
    /// By what the levels of a curve of `measure` by the definition `from` are multiplied, if the study says so.
    pub fn factor(&self, from: ComponentDefinition, measure: IntensityMeasure) -> Option<f64> {
        let conversion = self.conversions.iter().find(|conversion| conversion.from == from)?;
        conversion.factors.iter().find_map(|&(known, factor)| (known == measure).then_some(factor))
    }
}

/// The definition of a hazard curve that goes with a combination of records.
pub fn definition_of(combination: Combination) -> ComponentDefinition {
    match combination {
        Combination::GeometricMean => ComponentDefinition::GeometricMean,
        Combination::RotD50 => ComponentDefinition::RotD50,
        Combination::RotD100 => ComponentDefinition::RotD100,
    }
}

pub(super) fn read(mut section: Section<'_>) -> Option<Hazard> {
    let component_field = section.field("component");
    let conversions = section.field("conversions").map_or(Some(Vec::new()), |field| conversions(&field));
    section.finish();
    let component = optional(component_field.as_ref(), |field| field.choice(&DEFINITIONS));
    Some(Hazard { component: component?, conversions: conversions? })
}

fn conversions(field: &Field<'_>) -> Option<Vec<Conversion>> {
    let mut read = Some(Vec::new());
    for item in field.items() {
        let mut section = item.section();
        if !section.is_present() {
            return None;
        }
        let from = match section.field("from") {
            Some(field) => field.choice(&DEFINITIONS),
            None => {
                section.mistake("from", "the conversion does not say from which definition", "add from = \"GMRotI50\"");
                None
            }
        };
        let mut factors = Some(Vec::new());
        for keys in &MEASURES {
            let Some(field) = section.field(keys.section) else { continue };
            match (&mut factors, field.number("", ABOVE_ZERO)) {
                (Some(factors), Some(factor)) => factors.push((keys.measure, factor)),
                _ => factors = None,
            }
        }
        if factors.as_ref().is_some_and(Vec::is_empty) {
            section.mistake("", "the conversion has no factor", "add pgv = 1.0, pga = 1.0 or both");
            factors = None;
        }
        section.finish();
        match (&mut read, from, factors) {
            (Some(known), Some(from), _) if known.iter().any(|conversion: &Conversion| conversion.from == from) => {
                item.mistake(format!("{from} is converted twice"), "give each definition once");
                read = None;
            }
            (Some(known), Some(from), Some(factors)) => known.push(Conversion { from, factors }),
            _ => read = None,
        }
    }
    read
}
