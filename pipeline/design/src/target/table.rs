//! Every value that was tried, as CSV.

use std::path::Path;

use uplift_ida::OSCILLATOR;
use uplift_job::outputs;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_uniform_risk::EventRisk;

use super::{TargetReport, TriedOwn};
use crate::error::DesignError;
use crate::risk_columns::{FREQUENCIES, TAIL_SHARES};
use crate::uncertain::PERCENTILES;

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "quantity";

/// Writes a row a value.
pub(super) fn write(path: &Path, report: &TargetReport) -> Result<(), DesignError> {
    let line = outputs::marked(format_args!(
        "target of {} ({}): {} at most {} per year at {} by {}; result {}; records: {}",
        report.structure.name,
        report.structure.kind,
        report.event,
        report.target_per_year,
        report.site,
        report.im,
        report.source.result.display(),
        report.source.record_set
    ));
    let rows = rows(report);
    let mut columns = ColumnsOf::new(&rows)
        .with(FIRST_COLUMN, |_| report.quantity)
        .with("unit", |_| report.quantity_unit)
        .with("model", |tried| tried.model)
        .with("value", |tried| tried.value)
        .each(FREQUENCIES.into_iter().chain(TAIL_SHARES), |columns, (name, of)| {
            columns.with(name, |tried| of(&tried.risk))
        })
        .with("target_per_year", |_| report.target_per_year)
        .with("is_met", |tried| tried.risk.per_year <= report.target_per_year);
    if let Some(uncertain) = &report.uncertainty {
        columns = columns.with("uncertainty", |_| uncertain.kind);
    }
    if rows.iter().any(|tried| tried.structure_percentiles_per_year.is_some()) {
        columns = columns.each(PERCENTILES.into_iter().enumerate(), |columns, (place, name)| {
            let of = |tried: &Row| Some(tried.structure_percentiles_per_year?[place]);
            columns.with(format!("maf_structure_{name}_per_year"), of)
        });
    }
    Ok(write_table(path, &line, columns.build())?)
}

/// One value of the search, or of the structure itself.
struct Row {
    model: &'static str,
    value: f64,
    risk: EventRisk,
    structure_percentiles_per_year: Option<[f64; 5]>,
}

/// The values of the search, then those at which the structure itself was shaken.
fn rows(report: &TargetReport) -> Vec<Row> {
    let of_oscillator = report.tried.iter().map(|tried| Row {
        model: OSCILLATOR,
        value: tried.value,
        risk: tried.risk,
        structure_percentiles_per_year: tried.structure_percentiles_per_year,
    });
    let of_own = report.own.iter().flat_map(|own| {
        let model = own.decisive().model;
        let row = move |tried: &TriedOwn| Row {
            model,
            value: tried.value,
            risk: tried.risk,
            structure_percentiles_per_year: None,
        };
        own.tried.iter().map(row)
    });
    of_oscillator.chain(of_own).collect()
}
