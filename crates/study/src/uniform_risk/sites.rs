//! The sections `[[sites]]`: names, and where the hazard curves are.

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_motion::IntensityMeasure;

use super::curve::{self, CurveFile};
use super::measures::{self, cannot_be_scaled_to, section_of};
use crate::keys::{Key, SectionKeys, Shape, Special, Text, special};
use crate::reading::{Field, Paths};
use crate::sections::name;

pub(super) const KEYS: SectionKeys = SectionKeys::new("sites", &[&NAME, &CURVE, &FURTHER_CURVE]).shape(Shape::List);
const NAME: Key<Text> = name::KEY
    .meaning("name")
    .note(r#"each once (capitals do not count); at most 100 bytes, none of `/ \ : * ? " < > \|`"#);
const CURVE: Key<Special> = special("pgv", || json!({}))
    .also(&["pga"])
    .without_default("needed if the measure is switched on")
    .meaning("hazard curve: a path, or a table of the keys below");
const FURTHER_CURVE: Key<Special> = special("sa_1s", || json!({}))
    .without_default("needed if the measure is switched on")
    .meaning("the same of any further measure, by its name")
    .note("the names below but `d5_75`, `d5_95`");

/// Most sites in one study.
const MOST_SITES: usize = 1000;

/// A site.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Site {
    /// Its name, of no other site.
    pub name: String,
    /// Its hazard curves, at most one of each measure; at least those of the measures studied.
    #[serde(flatten, serialize_with = "write_curves")]
    pub curves: Vec<CurveFile>,
}

impl Site {
    /// The hazard curve of `measure`.
    pub fn curve(&self, measure: IntensityMeasure) -> Option<&CurveFile> {
        self.curves.iter().find(|curve| curve.measure == measure)
    }

    /// Whether its hazard in `measure` is uncertain: weighted curves.
    pub fn has_weighted_curves(&self, measure: IntensityMeasure) -> bool {
        self.curve(measure).is_some_and(|curve| !curve.branches.is_empty())
    }
}

fn write_curves<S: Serializer>(curves: &[CurveFile], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(curves.iter().map(|curve| (curve.measure.key(), curve)))
}

/// Reads the sites; each must have a curve of each measure in `measures`.
pub(super) fn read(field: Option<Field<'_>>, measures: &[IntensityMeasure], paths: &Paths) -> Option<Vec<Site>> {
    let Some(field) = field else { return Some(Vec::new()) };
    let mut names = Vec::new();
    field.sections("site", 0..=MOST_SITES, |item| site(&item, measures, paths, &mut names))
}

fn site(item: &Field<'_>, studied: &[IntensityMeasure], paths: &Paths, names: &mut Vec<String>) -> Option<Site> {
    let mut section = item.section();
    if !section.is_present() {
        return None;
    }
    let name = name::read(&mut section, "site", "Athens", names);
    let mut curves = Some(Vec::new());
    let mut named = measures::named(&section);
    named.extend(studied.iter().filter(|measure| !named.contains(measure)).copied().collect::<Vec<_>>());
    for measure in named {
        let key = measure.key();
        let Some(field) = section.field(key) else {
            if studied.contains(&measure) {
                section.mistake(
                    key,
                    format!(
                        "{} has no {} curve, and the study has a section [{}]",
                        name.as_deref().unwrap_or("the site"),
                        measure.label(),
                        section_of(measure)
                    ),
                    format!("add {key} = \"path of the curve\" to the site, or remove [{}]", section_of(measure)),
                );
                curves = None;
            }
            continue;
        };
        if !measure.can_be_scaled_to() {
            field.mistake(cannot_be_scaled_to(measure), "leave the curve out");
            curves = None;
            continue;
        }
        match (&mut curves, curve::read(&field, measure, paths)) {
            (Some(curves), Some(curve)) => curves.push(curve),
            _ => curves = None,
        }
    }
    section.finish();
    Some(Site { name: name?, curves: curves? })
}
