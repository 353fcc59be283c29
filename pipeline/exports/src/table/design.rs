//! The design tables of a result, ours beside a reference (Tables 2.1 to 2.3 and 3.2 to 3.7).

use std::path::Path;

use serde::Serialize;
use uplift_job::events::Events;
use uplift_job::text::distinct;
use uplift_job::{JobError, ReferenceTable};
use uplift_result::{DesignRow, ResultFile};
use uplift_spectra::Noisy;
use uplift_study::ScaledTo;

use super::options::TableOptions;
use crate::error::ExportsError;

/// The design tables of a result; serialized, the rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct DesignTable {
    /// The values, by set, then rule, quantity, scaling and whose peak is scaled.
    pub rows: Vec<DesignTableRow>,
    /// Where the records come from, in a line.
    #[serde(skip)]
    pub record_set: String,
    /// Factor of safety of the designs.
    #[serde(skip)]
    pub safety_factor: f64,
    /// Points of the sweep that gives the ranges.
    #[serde(skip)]
    pub noise_points: u64,
    /// How far the sweep goes to both sides, relative.
    #[serde(skip)]
    pub noise_relative: f64,
    /// Whether a reference was given.
    #[serde(skip)]
    pub compared: bool,
}

/// A value of a design table with its range.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DesignTableRow {
    /// The value.
    #[serde(flatten)]
    pub row: DesignRow,
    /// What the reference says of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reference: Option<f64>,
    /// Whether the range holds that, as rounded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<bool>,
}

struct Reference {
    record_set: String,
    rule: String,
    scaling: ScaledTo,
    quantity: String,
    value: f64,
    /// Half of the last digit printed.
    rounding: f64,
}

impl Reference {
    fn is_of(&self, row: &DesignRow) -> bool {
        let same = |a: &str, b: &str| a.eq_ignore_ascii_case(b);
        same(&self.record_set, &row.record_set)
            && same(&self.rule, row.rule.unwrap_or_default())
            && same(&self.quantity, &row.quantity)
            && ScaledTo::parse(&row.scaling) == Some(self.scaling)
    }

    /// Whether the range holds the printed number, which stands for all that are rounded to it.
    fn is_within(&self, noisy: &Noisy) -> bool {
        noisy.lowest <= self.value + self.rounding && self.value - self.rounding <= noisy.highest
    }
}

pub(super) fn read(
    options: &TableOptions,
    file: &ResultFile,
    events: &dyn Events,
) -> Result<DesignTable, ExportsError> {
    let Some(design) = file.design()? else {
        return Err(JobError::input(format!(
            "{}: has no design example: add a section [design] to the study, which may be empty, and run it again",
            options.result.display()
        ))
        .into());
    };
    let references = options.reference.as_deref().map_or_else(|| Ok(Vec::new()), read_reference)?;
    let compared = options.reference.is_some();
    let rows: Vec<DesignTableRow> = design
        .rows
        .into_iter()
        .map(|row| {
            let reference = references.iter().find(|reference| reference.is_of(&row));
            DesignTableRow {
                reference: reference.map(|reference| reference.value),
                within: reference.map(|reference| reference.is_within(&row.noisy)),
                row,
            }
        })
        .collect();
    if compared && rows.iter().all(|row| row.reference.is_none()) {
        events.note(&format!(
            "no row of the reference has a record set, scaling and quantity of the result: it has the sets {}, the \
             result {}",
            distinct(references.iter().map(|reference| reference.record_set.as_str())).join(", "),
            distinct(rows.iter().map(|row| row.row.record_set.as_str())).join(", ")
        ));
    }
    Ok(DesignTable {
        rows,
        record_set: file.head()?.record_set,
        safety_factor: design.safety_factor,
        noise_points: design.noise_points,
        noise_relative: design.noise_relative,
        compared,
    })
}

fn read_reference(path: &Path) -> Result<Vec<Reference>, ExportsError> {
    let table = ReferenceTable::read(path)?;
    let missing: Vec<&str> =
        ["record_set", "scaling", "quantity", "value"].into_iter().filter(|name| !table.has(name)).collect();
    if !missing.is_empty() {
        return Err(table.fail(format!("has no column {}", missing.join(", "))).into());
    }
    (0..table.rows())
        .map(|row| {
            let scaling = table.text("scaling", row);
            let digits = table.text("value", row);
            let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            Ok(Reference {
                record_set: table.text("record_set", row),
                rule: table.text("rule", row),
                scaling: ScaledTo::parse(&scaling).ok_or_else(|| {
                    table.fail(format!("row {}, scaling: {scaling:?} is neither unscaled nor as 0.5PGA", row + 1))
                })?,
                quantity: table.text("quantity", row),
                value: table.number("value", row)?,
                rounding: 0.5 * 0.1_f64.powi(i32::try_from(decimals).unwrap_or(i32::MAX)),
            })
        })
        .collect()
}
