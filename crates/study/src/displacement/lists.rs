//! Lists of a study of displacement spectra: scalings, and capacities up to infinity.

use uplift_motion::IntensityMeasure::{Pga, Pgv};
use uplift_spectra::ScaledBy;

use super::super::document::{Node, Value};
use super::super::reader::{ABOVE_ZERO, Field, Section, quantity};
use super::{ScaledTo, ScalingPlan};

/// The words of a study file.
const BY: [(&str, ScaledBy); 2] = [("component", ScaledBy::Component), ("record", ScaledBy::Record)];
/// Most items of a list that is no grid.
const MOST_ITEMS: usize = 100;

/// The seven of Figures 2.10 to 2.12; Chapter 3 leaves the first one out.
fn default_targets() -> Vec<ScaledTo> {
    let to = |measure| [0.5, 1.0, 2.0].map(|multiple| ScaledTo::Median { multiple, measure });
    [ScaledTo::Unscaled].into_iter().chain(to(Pga)).chain(to(Pgv)).collect()
}

/// Reads the section `[scaling]`.
pub(super) fn scaling(mut section: Section<'_>) -> Option<ScalingPlan> {
    let to = section.field("to").map_or_else(|| Some(default_targets()), |field| list(&field, target));
    let by =
        section.field("by").map_or_else(|| Some(ScaledBy::ALL.to_vec()), |field| list(&field, |item| item.choice(&BY)));
    section.finish();
    Some(ScalingPlan { to: to?, by: by? })
}

fn target(item: &Field<'_>) -> Option<ScaledTo> {
    const HELP: &str = "write \"unscaled\", or a multiple of the set's median peak: \"0.5 PGA\", \"1 PGV\"";
    let Value::Text(text) = &item.node.value else {
        return item.wrong_type("a scaling", HELP);
    };
    let target = ScaledTo::parse(text);
    if target.is_none() {
        item.mistake(format!("{} is no scaling", item.node.describe()), HELP);
    }
    target
}

/// A list of which no item is given twice.
fn list<T: PartialEq>(field: &Field<'_>, read: impl Fn(&Field<'_>) -> Option<T>) -> Option<Vec<T>> {
    let mut complete = true;
    let mut found: Vec<T> = Vec::new();
    for item in counted(field)? {
        match read(&item) {
            Some(new) if found.contains(&new) => {
                item.mistake(format!("{} is given twice", item.node.describe()), "give each once");
                complete = false;
            }
            Some(new) => found.push(new),
            None => complete = false,
        }
    }
    complete.then_some(found)
}

fn counted<'a>(field: &Field<'a>) -> Option<Vec<Field<'a>>> {
    let items = field.items();
    if items.is_empty() || items.len() > MOST_ITEMS {
        field.mistake(format!("the list has {} items", items.len()), format!("give 1 to {MOST_ITEMS}"));
        return None;
    }
    Some(items)
}

/// Increasing capacities \[m\], each above `above_m`; the last may be infinite.
pub(super) fn capacities(field: &Field<'_>, above_m: Option<f64>) -> Option<Vec<f64>> {
    let mut capacities: Vec<f64> = Vec::new();
    let mut complete = true;
    for item in counted(field)? {
        let endless = matches!(item.node, Node { value: Value::Float(value), .. } if *value == f64::INFINITY);
        let Some(capacity) = (if endless { Some(f64::INFINITY) } else { item.number("m", ABOVE_ZERO) }) else {
            complete = false;
            continue;
        };
        let shown = quantity(capacity, "m");
        if let Some(above) = above_m.filter(|&above| capacity <= above) {
            item.mistake(
                format!("the capacity {shown} is not above the largest uplift displacement {}", quantity(above, "m")),
                "raise it, or leave the larger uplift displacements out",
            );
            complete = false;
        } else if let Some(&last) = capacities.last().filter(|&&last| capacity <= last) {
            item.mistake(
                format!("{shown} follows {}, but the list must increase", quantity(last, "m")),
                "sort the capacities and give each once; inf, which never overturns, comes last",
            );
            complete = false;
        }
        capacities.push(capacity);
    }
    complete.then_some(capacities)
}
