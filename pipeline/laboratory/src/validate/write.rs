//! The statistics as a table, a row a group.

use std::path::Path;

use polars::prelude::Column;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_validation::{Bands, Quantiles};

use super::group::GroupReport;
use super::report::ValidateReport;
use crate::error::LaboratoryError;

/// A column of every such table, and of no other.
pub(super) const COLUMN: &str = "ks_p_kstest2";

pub(super) fn write(report: &ValidateReport, file: &Path) -> Result<(), LaboratoryError> {
    let line = format!(
        "{}; statistics of {} of {} beside {}; {} replicates, seed {}",
        uplift_job::outputs::mark(),
        report.value,
        report.computed.display(),
        report.measured.display(),
        report.replicates,
        report.seed
    );
    Ok(write_table(file, &line, columns(report))?)
}

fn columns(report: &ValidateReport) -> Vec<Column> {
    let with_unit =
        |name: &str| if report.unit.is_empty() { name.to_owned() } else { format!("{name}_{}", report.unit) };
    ColumnsOf::new(&report.groups)
        .each(report.by.iter().enumerate(), |columns, (place, name)| {
            columns.with(name.as_str(), |group| group.of[place].as_deref().unwrap_or("all"))
        })
        .with("measured", |group| group.measured as u64)
        .with("computed", |group| group.computed as u64)
        .with("ks_distance", |group| group.kolmogorov_smirnov.distance)
        .with("ks_p_exact", |group| group.kolmogorov_smirnov.p_exact)
        .with("ks_p_kolmogorov", |group| group.kolmogorov_smirnov.p_kolmogorov)
        .with(COLUMN, |group| group.kolmogorov_smirnov.p_kstest2)
        .with("p_holm", |group| group.p_holm)
        .with("p_permutation", |group| group.p_permutation)
        .with("evidence", |group| group.evidence.words())
        .with("dispersion", |group| group.dispersion)
        .with("detectable_factor", |group| group.detectable_factor)
        .with("anderson_darling_midrank", |group| group.anderson_darling.midrank)
        .with("anderson_darling_right", |group| group.anderson_darling.right)
        .with("cramer_von_mises", |group| group.cramer_von_mises.statistic)
        .with("cramer_von_mises_p", |group| group.cramer_von_mises.p)
        .with("mann_whitney_u", |group| group.mann_whitney.statistic)
        .with("mann_whitney_p", |group| group.mann_whitney.p)
        .with(with_unit("wasserstein"), |group| group.wasserstein)
        .with("energy_distance", |group| group.energy)
        .with(with_unit("median_measured"), |group| group.median_measured)
        .with(with_unit("median_computed"), |group| group.median_computed)
        .with("e50", |group| group.e50)
        .with("median_error", |group| group.median_error)
        .each(QUANTILES, |columns, (at, of)| {
            columns.with(format!("median_error_{at}"), |group| group.median_error_band.map(of))
        })
        .with("log_bias", |group| group.pairs.as_ref().and_then(|pairs| pairs.log_bias))
        .each(QUANTILES, |columns, (at, of)| {
            columns.with(format!("log_bias_{at}"), |group| pair_band(group, |bands| bands.log_bias).map(of))
        })
        .with("log_dispersion", |group| group.pairs.as_ref().and_then(|pairs| pairs.log_dispersion))
        .each(QUANTILES, |columns, (at, of)| {
            columns.with(format!("log_dispersion_{at}"), |group| pair_band(group, |bands| bands.log_dispersion).map(of))
        })
        .with("finite_pairs", |group| group.pairs.as_ref().map(|pairs| pairs.finite as u64))
        .with("pearson", |group| group.pairs.as_ref().and_then(|pairs| pairs.pearson))
        .with("spearman", |group| group.pairs.as_ref().and_then(|pairs| pairs.spearman))
        .with("within_1_5", |group| group.pairs.as_ref().map(|pairs| pairs.within_1_5))
        .with("within_2", |group| group.pairs.as_ref().map(|pairs| pairs.within_2))
        .with("collapses_both", |group| group.pairs.as_ref().map(|pairs| pairs.collapses.both as u64))
        .with("collapses_measured_only", |group| group.pairs.as_ref().map(|pairs| pairs.collapses.measured_only as u64))
        .with("collapses_computed_only", |group| group.pairs.as_ref().map(|pairs| pairs.collapses.computed_only as u64))
        .with("measured_collapses", |group| group.measured_collapses as u64)
        .with("computed_collapses", |group| group.computed_collapses as u64)
        .with("measured_above_limit", |group| group.censored.map_or(0, |censored| censored.measured) as u64)
        .with("computed_above_limit", |group| group.censored.map_or(0, |censored| censored.computed) as u64)
        .with("ks_distance_at_limits", |group| group.censored.map(|censored| censored.ks_distance_at_limits))
        .with(with_unit("median_measured_above"), |group| group.median_measured_above)
        .with(with_unit("median_computed_above"), |group| group.median_computed_above)
        .build()
}

fn pair_band(group: &GroupReport, of: fn(&Bands) -> Option<Quantiles>) -> Option<Quantiles> {
    group.pair_bands.as_ref().and_then(of)
}

/// Its name at the end of a column, and its value.
type Quantile = (&'static str, fn(Quantiles) -> f64);

/// 5, 50 and 95 % of a statistic.
const QUANTILES: [Quantile; 3] = [("q05", |q| q.q05), ("q50", |q| q.q50), ("q95", |q| q.q95)];
