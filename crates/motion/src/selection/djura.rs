//! Selections of Djura in JSON: lists of one entry a record, and all measures of the scaled records.
//!
//! # Source
//! The djura package, `record_selection`, attribute `selected_scaled_best`.

use std::borrow::Cow;
use std::collections::HashMap;

use serde::Deserialize;
use serde_json::Value;

use super::{SelectedComponent, SelectedName, SelectedRecord, SelectedSet, SelectionTool, factor, wrong};
use crate::error::MotionError;
use crate::measure::IntensityMeasure;
use crate::pair::Horizontal;
use crate::read::excerpt;

/// By how much the level may differ from record to record, relative: Djura's database has seven digits.
const SAME_LEVEL: f64 = 1e-4;

#[derive(Deserialize)]
struct Selection {
    selected_scaled_best: Best,
}

#[derive(Deserialize)]
struct Best {
    sf: Vec<Option<f64>>,
    #[serde(default)]
    rec_filenames: Vec<String>,
    #[serde(default)]
    gm_components: Vec<String>,
    #[serde(default)]
    rsn: Vec<Value>,
    #[serde(default, rename = "IMi")]
    measures: HashMap<String, Value>,
    #[serde(default, rename = "im_idxs")]
    columns: HashMap<String, Value>,
    #[serde(default, rename = "Scaled_IMs")]
    scaled: Vec<Vec<Option<f64>>>,
}

pub(super) fn parse(text: &str, name: &str, measure: IntensityMeasure) -> Result<SelectedSet, MotionError> {
    let Selection { selected_scaled_best: best } =
        serde_json::from_str(&without_python_numbers(text)).map_err(|error| {
            let reason = format!("not a selection of Djura that can be read: {}", excerpt(&error.to_string()));
            wrong(name, Some(error.line()), reason)
        })?;
    let count = best.sf.len();
    let named = if best.rec_filenames.is_empty() { best.rsn.len() } else { best.rec_filenames.len() };
    if named != count || best.gm_components.len() != count {
        let reason = format!(
            "{count} factors (sf), {named} names (rec_filenames, or rsn) and {} gm_components: one of each a record \
             is needed",
            best.gm_components.len()
        );
        return Err(wrong(name, None, reason));
    }
    let records = (0..count).map(|index| record(&best, index, name)).collect::<Result<_, _>>()?;
    Ok(SelectedSet { tool: SelectionTool::Djura, level: level(&best, name, measure)?, records })
}

fn record(best: &Best, index: usize, name: &str) -> Result<SelectedRecord, MotionError> {
    let position = index + 1;
    let fail = |reason: String| wrong(name, None, format!("record {position}: {reason}"));
    let horizontal = |component: &str| match component.trim() {
        "H1" => Some(Horizontal::H1),
        "H2" => Some(Horizontal::H2),
        _ => None,
    };
    let components: Vec<Horizontal> = best.gm_components[index].split(',').filter_map(horizontal).collect();
    let (selected, component) = match (best.rec_filenames.get(index), components.as_slice()) {
        (Some(files), [_] | [_, _]) => {
            let files: Vec<String> = files.split(',').take(components.len()).map(|file| file.trim().into()).collect();
            if files.len() < components.len() || files.iter().any(String::is_empty) {
                return Err(fail("rec_filenames and gm_components do not name the same".to_owned()));
            }
            let component = if files.len() == 2 { SelectedComponent::Pair } else { SelectedComponent::OfFile };
            (SelectedName::Files(files), component)
        }
        (None, [first, others @ ..]) => {
            let rsn =
                best.rsn[index].as_u64().ok_or_else(|| fail(format!("rsn is {}", excerpt_of(&best.rsn[index]))))?;
            let component =
                if others.is_empty() { SelectedComponent::Numbered(*first) } else { SelectedComponent::Pair };
            (SelectedName::SequenceNumber(rsn), component)
        }
        _ => {
            let given = excerpt(&best.gm_components[index]);
            return Err(fail(format!("gm_components is {given:?}: H1, H2 or \"H1, H2\" is needed")));
        }
    };
    let written = best.sf[index].map_or_else(|| "null".to_owned(), |value| value.to_string());
    let factor = factor(&written, name, position)?;
    Ok(SelectedRecord { position, name: selected, component, factor })
}

fn excerpt_of(value: &Value) -> String {
    excerpt(&value.to_string())
}

/// The level: the measure of the scaled records, which is that of all; none where Djura does not tell this measure.
fn level(best: &Best, name: &str, measure: IntensityMeasure) -> Result<Option<f64>, MotionError> {
    let Some(column) = column(best, measure) else { return Ok(None) };
    let values: Option<Vec<f64>> = best.scaled.iter().map(|row| row.get(column).copied().flatten()).collect();
    let Some(values) = values.filter(|values| !values.is_empty()) else { return Ok(None) };
    let (least, most) = values.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &value| (a.min(value), b.max(value)));
    if !(least > 0.0 && most.is_finite() && most <= (1.0 + SAME_LEVEL) * least) {
        let (label, unit) = (measure.label(), measure.unit());
        let reason = format!(
            "the {label} of its scaled records goes from {least} to {most} {unit}, so they were not selected for a \
             level of it: name the measure that they were selected for"
        );
        return Err(wrong(name, None, reason));
    }
    // seven digits are meant
    Ok(format!("{:.6e}", values[0]).parse().ok())
}

/// The column of `measure` in the measures of the scaled records.
fn column(best: &Best, measure: IntensityMeasure) -> Option<usize> {
    let (key, period_s) = match measure {
        IntensityMeasure::Pgv => ("PGV", None),
        IntensityMeasure::Pga => ("PGA", None),
        IntensityMeasure::Sa(period) => ("SA", Some(period.s())),
        _ => return None,
    };
    let place = match period_s {
        Some(period_s) => best
            .measures
            .get(key)?
            .as_array()?
            .iter()
            .position(|value| value.as_f64().is_some_and(|found| (found / period_s - 1.0).abs() < 1e-6))?,
        None => 0,
    };
    let columns = best.columns.get(key)?;
    let column = columns.as_array().map_or(Some(columns), |columns| columns.get(place))?;
    usize::try_from(column.as_u64()?).ok()
}

/// `text` with null in the place of Python's NaN and Infinity, which JSON has not.
fn without_python_numbers(text: &str) -> Cow<'_, str> {
    const NUMBERS: [&str; 3] = ["NaN", "-Infinity", "Infinity"];
    if !NUMBERS.iter().any(|number| text.contains(number)) {
        return Cow::Borrowed(text);
    }
    let mut replaced = String::with_capacity(text.len());
    for (index, part) in text.split('"').enumerate() {
        if index > 0 {
            replaced.push('"');
        }
        // between quotation marks every other part is a text; one with a mark in it makes JSON that is refused
        if index % 2 == 0 {
            replaced.push_str(&NUMBERS.iter().fold(part.to_owned(), |part, number| part.replace(number, "null")));
        } else {
            replaced.push_str(part);
        }
    }
    Cow::Owned(replaced)
}
