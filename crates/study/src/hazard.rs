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
    /// Definition that the records are measured by.
    pub to: ComponentDefinition,
    /// By what its levels are multiplied.
    pub factors: Vec<(IntensityMeasure, f64)>,
}

impl Hazard {
    /// By what the levels of a curve of `measure` are multiplied from one definition to another, if the study says so.
    pub fn factor(&self, from: ComponentDefinition, to: ComponentDefinition, measure: IntensityMeasure) -> Option<f64> {
        let mut conversions = self.conversions.iter();
        let conversion = conversions.find(|conversion| conversion.from == from && conversion.to == to)?;
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

/// What a study file calls a definition.
pub fn definition_word(definition: ComponentDefinition) -> &'static str {
    DEFINITIONS.iter().find_map(|(word, known)| (*known == definition).then_some(*word)).unwrap_or_default()
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
        let [from, to] = ["from", "to"].map(|key| {
            if let Some(field) = section.field(key) {
                return field.choice(&DEFINITIONS);
            }
            section.mistake(
                key,
                format!("the conversion does not say {key} which definition"),
                "write { from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }",
            );
            None
        });
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
        let (Some(known), Some(from), Some(to), Some(factors)) = (&mut read, from, to, factors) else {
            read = None;
            continue;
        };
        if known.iter().any(|conversion: &Conversion| conversion.from == from && conversion.to == to) {
            item.mistake(format!("{from} is converted to {to} twice"), "give each conversion once");
            read = None;
            continue;
        }
        known.push(Conversion { from, to, factors });
    }
    read
}
