//! Every value that was tried, as CSV.

use std::path::Path;

use uplift_job::outputs;
use uplift_job::table::{ColumnsOf, write_table};

use super::TargetReport;
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
    let mut columns = ColumnsOf::new(&report.tried)
        .with(FIRST_COLUMN, |_| report.quantity)
        .with("unit", |_| report.quantity_unit)
        .with("value", |tried| tried.value)
        .each(FREQUENCIES.into_iter().chain(TAIL_SHARES), |columns, (name, of)| {
            columns.with(name, |tried| of(&tried.risk))
        })
        .with("target_per_year", |_| report.target_per_year)
        .with("is_met", |tried| tried.is_met);
    if let Some(uncertain) = &report.uncertainty {
        columns = columns.with("uncertainty", |_| uncertain.kind);
    }
    if report.tried.iter().any(|tried| tried.structure_percentiles_per_year.is_some()) {
        columns = columns.each(PERCENTILES.into_iter().enumerate(), |columns, (place, name)| {
            let of = |tried: &super::TriedValue| Some(tried.structure_percentiles_per_year?[place]);
            columns.with(format!("maf_structure_{name}_per_year"), of)
        });
    }
    Ok(write_table(path, &line, columns.build())?)
}
