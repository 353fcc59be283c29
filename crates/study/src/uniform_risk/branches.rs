//! Several weighted hazard curves of one site and measure: epistemic uncertainty.

use std::path::PathBuf;

use serde::{Serialize, Serializer};
use serde_json::json;
use uplift_hazard::CurveUnit;

use super::curve::{read_unit, write_unit};
use crate::keys::{Declared, File, Key, Number, Special, Text, file, number, special, text};
use crate::reading::{Field, Paths, Rule, optional};

pub(super) const KEYS: &[&dyn Declared] = &[&FILE, &WEIGHT, &NAME, &UNIT];
const FILE: Key<File> = file("file").meaning("the curve").note("existing file");
const WEIGHT: Key<Number> = number("weight", "", ABOVE_0_BELOW_1).meaning("its weight").note("they add up to 1");
const NAME: Key<Text> = text("name").without_default("`branch 1` and so on").meaning("name").note("each once");

const UNIT: Key<Special> = special("unit", || json!({ "type": "string", "minLength": 1 }))
    .without_default("the curve's `unit` if given, else as the file says")
    .meaning("unit of its levels");

/// Most branches of one curve; each is carried through the risk of every resample.
pub(super) const MOST_BRANCHES: usize = 1000;
/// How far from 1 the sum of the weights may be, for weights given with a few digits.
const SUM_TOLERANCE: f64 = 1e-6;

const ABOVE_0_BELOW_1: Rule = Rule::Between(0.0, 1.0, "above 0 and below 1");

/// One of several weighted hazard curves of a site, a realization of a logic tree for instance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// Its name, of no other branch of the curve.
    pub name: String,
    /// Its weight \[-\].
    pub weight: f64,
    /// The file, absolute.
    pub file: PathBuf,
    /// Unit of its levels, where it is another than that of the curve.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "write_own_unit")]
    pub unit: Option<CurveUnit>,
}

#[allow(clippy::ref_option, clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_own_unit<S: Serializer>(unit: &Option<CurveUnit>, serializer: S) -> Result<S::Ok, S::Error> {
    match unit {
        Some(unit) => write_unit(unit, serializer),
        None => serializer.serialize_none(),
    }
}

/// Reads the list of branches, whose levels are in one of these `units`; none of exports, which say it themselves.
pub(super) fn read(field: &Field<'_>, units: &[CurveUnit], paths: &Paths) -> Option<Vec<Branch>> {
    let items = field.items();
    if items.len() < 2 || items.len() > MOST_BRANCHES {
        return field.refuse(
            format!("the list has {} branches", items.len()),
            format!(
                "give 2 to {MOST_BRANCHES}, each as {{ file = \"path\", weight = 0.5 }}; a single curve needs no \
                 branches"
            ),
        );
    }
    let mut branches: Vec<Branch> = Vec::new();
    for (index, item) in items.iter().enumerate() {
        branches.extend(branch(item, units, (index, &branches), paths));
    }
    if branches.len() < items.len() {
        return None;
    }
    let sum: f64 = branches.iter().map(|branch| branch.weight).sum();
    if (sum - 1.0).abs() > SUM_TOLERANCE {
        return field.refuse(format!("the weights add up to {sum}"), "they must add up to 1");
    }
    Some(branches)
}

fn branch(item: &Field<'_>, units: &[CurveUnit], (index, others): (usize, &[Branch]), paths: &Paths) -> Option<Branch> {
    let mut section = item.section();
    if !section.is_present() {
        return None;
    }
    let file = section.needed(&FILE, "the branch has no file", "add file = \"path\"");
    let file = file.and_then(|field| paths.input(&field));
    let weight = section.read_needed(&WEIGHT, "the branch has no weight", "add weight = 0.5");
    let name = match section.given(&NAME) {
        None => Some(format!("branch {}", index + 1)),
        Some(field) => {
            let name = field.filled_text().map(|name| name.trim().to_owned());
            if name.as_ref().is_some_and(|name| others.iter().any(|other| other.name == *name)) {
                field.refuse("another branch has this name", "give each branch a name of its own")
            } else {
                name
            }
        }
    };
    let unit_field = if units.is_empty() { None } else { section.given(&UNIT) };
    let unit = optional(unit_field.as_ref(), |field| read_unit(field, units));
    section.finish();
    Some(Branch { name: name?, weight: weight?, file: file?, unit: unit? })
}
