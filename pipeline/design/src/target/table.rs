//! Every value that was tried, as CSV.

use std::path::Path;

use polars::prelude::Column;
use uplift_job::table::write_table;

use super::TargetReport;
use crate::error::DesignError;
use crate::tables::PERCENTILES;

/// The column by which a table of this program is known.
pub(super) const FIRST_COLUMN: &str = "quantity";

/// Writes a row a value.
pub(super) fn write(path: &Path, report: &TargetReport) -> Result<(), DesignError> {
    let line = format!(
        "uplift {} ({}); target of {} ({}): {} at most {} per year at {} by {}; result {}; records: {}",
        uplift_job::VERSION,
        uplift_job::COMMIT,
        report.structure.name,
        report.structure.kind,
        report.event,
        report.target_per_year,
        report.site,
        report.im,
        report.source.result.display(),
        report.source.record_set
    )
    .replace(['\n', '\r'], " ");
    let tried = &report.tried;
    let of = |value: fn(&super::TriedValue) -> f64| tried.iter().map(value).collect::<Vec<f64>>();
    let mut columns = vec![
        Column::new(FIRST_COLUMN.into(), vec![report.quantity; tried.len()]),
        Column::new("unit".into(), vec![report.quantity_unit; tried.len()]),
        Column::new("value".into(), of(|tried| tried.value)),
        Column::new("maf_per_year".into(), of(|tried| tried.risk.per_year)),
        Column::new(
            "at_most_per_year".into(),
            tried.iter().map(|tried| tried.risk.at_most_per_year).collect::<Vec<Option<f64>>>(),
        ),
        Column::new("lower_tail_share".into(), of(|tried| tried.risk.lower_tail_share)),
        Column::new("upper_tail_share".into(), of(|tried| tried.risk.upper_tail_share)),
        Column::new("target_per_year".into(), vec![report.target_per_year; tried.len()]),
        Column::new("is_met".into(), tried.iter().map(|tried| tried.is_met).collect::<Vec<bool>>()),
    ];
    if let Some(uncertain) = &report.uncertainty {
        columns.push(Column::new("uncertainty".into(), vec![uncertain.kind; tried.len()]));
    }
    if tried.iter().any(|tried| tried.structure_percentiles_per_year.is_some()) {
        for (place, name) in PERCENTILES.into_iter().enumerate() {
            let of = |tried: &super::TriedValue| Some(tried.structure_percentiles_per_year?[place]);
            let values: Vec<Option<f64>> = tried.iter().map(of).collect();
            columns.push(Column::new(format!("maf_structure_{name}_per_year").into(), values));
        }
    }
    Ok(write_table(path, &line, columns)?)
}
