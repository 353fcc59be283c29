//! The section `[hazard]`: how the curves combine horizontal components, and what that makes of them.

use std::collections::BTreeMap;

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_hazard::ComponentDefinition;
use uplift_motion::{Combination, IntensityMeasure};
use uplift_plausible::CONVERSION;

use super::measures;
use crate::keys::{Choice, Key, Number, SectionKeys, Shape, Special, choice, number, special};
use crate::reading::{Field, Rule, Section, optional};

pub(super) const KEYS: SectionKeys = SectionKeys::new("hazard", &[&COMPONENT, &CONVERSIONS]);
const COMPONENT: Key<Choice<ComponentDefinition>> = definition("component")
    .without_default("taken as the geometric mean, with a note; needed for records measured in another way")
    .meaning("definition of the curves whose files do not say it");
const CONVERSIONS: Key<Special> = special("conversions", || json!({}))
    .without_default("none")
    .meaning("list of `{ from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }`, of the keys below")
    .note("each pair of `from` and `to` once");

pub(super) const CONVERSION_KEYS: SectionKeys =
    SectionKeys::new("hazard.conversions", &[&FROM, &TO, &FACTOR]).shape(Shape::TableOrList);
const FROM: Key<Choice<ComponentDefinition>> = definition("from").meaning("definition of a curve");
const TO: Key<Choice<ComponentDefinition>> = definition("to").meaning("definition that the records are measured by");
const FACTOR: Key<Number> =
    number("pgv", "", Rule::Within(CONVERSION)).also(&["pga", "sa_1s"]).without_default("one is needed").meaning(
        "what the levels of such a curve are multiplied by, that is the records' definition of the measure over the \
         curve's; of any measure, by its name",
    );

/// A definition of the horizontal component.
const fn definition(name: &'static str) -> Key<Choice<ComponentDefinition>> {
    choice(name, &ComponentDefinition::ALL, ComponentDefinition::key)
}

/// What all hazard curves of a study have in common.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Hazard {
    /// Definition of the curves whose files do not say it.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "write_component")]
    pub component: Option<ComponentDefinition>,
    /// How curves of other definitions than that of the records are used.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub conversions: Vec<Conversion>,
}

/// The ratio of the records' definition of a measure over that of a curve.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Conversion {
    /// Definition of the curve.
    #[serde(serialize_with = "write_definition")]
    pub from: ComponentDefinition,
    /// Definition that the records are measured by.
    #[serde(serialize_with = "write_definition")]
    pub to: ComponentDefinition,
    /// By what its levels are multiplied.
    #[serde(flatten, serialize_with = "write_factors")]
    pub factors: Vec<(IntensityMeasure, f64)>,
}

#[allow(clippy::ref_option, clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_component<S: Serializer>(component: &Option<ComponentDefinition>, serializer: S) -> Result<S::Ok, S::Error> {
    component.map(ComponentDefinition::key).serialize(serializer)
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_definition<S: Serializer>(definition: &ComponentDefinition, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(definition.key())
}

/// The factors by the alphabet of their measures.
fn write_factors<S: Serializer>(factors: &[(IntensityMeasure, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    let factors: BTreeMap<_, _> = factors.iter().map(|&(measure, factor)| (measure.key(), factor)).collect();
    factors.serialize(serializer)
}

impl Hazard {
    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.component.is_none() && self.conversions.is_empty()
    }

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

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Hazard> {
    let component_field = section.given(&COMPONENT);
    let conversions = section.given(&CONVERSIONS).map_or(Some(Vec::new()), |field| conversions(&field));
    section.finish();
    let component = optional(component_field.as_ref(), |field| COMPONENT.read(field));
    Some(Hazard { component: component?, conversions: conversions? })
}

fn conversions(field: &Field<'_>) -> Option<Vec<Conversion>> {
    let mut read = Some(Vec::new());
    for item in field.items() {
        let mut section = item.section();
        if !section.is_present() {
            return None;
        }
        let [from, to] = [FROM, TO].map(|key| {
            let message = format!("the conversion does not say {} which definition", key.name);
            let help = "write { from = \"GMRotI50\", to = \"geometric mean\", pgv = 1.0, pga = 1.0 }";
            section.read_needed(&key, message, help)
        });
        let mut factors = Some(Vec::new());
        for measure in measures::named(&section) {
            let Some(field) = section.field(measure.key()) else { continue };
            match (&mut factors, FACTOR.read(&field)) {
                (Some(factors), Some(factor)) => factors.push((measure, factor)),
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
