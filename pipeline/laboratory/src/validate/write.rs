//! The statistics as a table, a row a group.

use std::path::Path;

use polars::prelude::Column;
use uplift_job::table::write_table;
use uplift_validation::{Bands, Pairs, Quantiles};

use super::group::GroupReport;
use super::run::ValidateReport;
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
    let groups = &report.groups;
    let text = |name: &str, cells: Vec<String>| Column::new(name.into(), cells);
    let number = |name: &str, of: &dyn Fn(&GroupReport) -> Option<f64>| {
        Column::new(name.into(), groups.iter().map(of).collect::<Vec<Option<f64>>>())
    };
    let count = |name: &str, of: &dyn Fn(&GroupReport) -> Option<usize>| {
        Column::new(name.into(), groups.iter().map(|group| of(group).map(|n| n as u64)).collect::<Vec<Option<u64>>>())
    };
    let pair = |name: &str, of: fn(&Pairs) -> Option<f64>| number(name, &|group| group.pairs.as_ref().and_then(of));
    let collapse = |name: &str, of: fn(&Pairs) -> usize| count(name, &|group| group.pairs.as_ref().map(of));
    let with_unit =
        |name: &str| if report.unit.is_empty() { name.to_owned() } else { format!("{name}_{}", report.unit) };
    let mut columns: Vec<Column> = report
        .by
        .iter()
        .enumerate()
        .map(|(place, name)| {
            let cells = groups.iter().map(|group| group.of[place].clone().unwrap_or_else(|| "all".to_owned()));
            text(name, cells.collect())
        })
        .collect();
    columns.extend([
        count("measured", &|group| Some(group.measured)),
        count("computed", &|group| Some(group.computed)),
        number("ks_distance", &|group| Some(group.kolmogorov_smirnov.distance)),
        number("ks_p_exact", &|group| Some(group.kolmogorov_smirnov.p_exact)),
        number("ks_p_kolmogorov", &|group| Some(group.kolmogorov_smirnov.p_kolmogorov)),
        number(COLUMN, &|group| Some(group.kolmogorov_smirnov.p_kstest2)),
        number("p_holm", &|group| Some(group.p_holm)),
        number("p_permutation", &|group| group.p_permutation),
        text("evidence", groups.iter().map(|group| group.evidence.words().to_owned()).collect()),
        number("dispersion", &|group| group.dispersion),
        number("detectable_factor", &|group| group.detectable_factor),
        number("anderson_darling_midrank", &|group| Some(group.anderson_darling.midrank)),
        number("anderson_darling_right", &|group| Some(group.anderson_darling.right)),
        number("cramer_von_mises", &|group| Some(group.cramer_von_mises.statistic)),
        number("cramer_von_mises_p", &|group| Some(group.cramer_von_mises.p)),
        number("mann_whitney_u", &|group| Some(group.mann_whitney.statistic)),
        number("mann_whitney_p", &|group| Some(group.mann_whitney.p)),
        number(&with_unit("wasserstein"), &|group| group.wasserstein),
        number("energy_distance", &|group| group.energy),
        number(&with_unit("median_measured"), &|group| group.median_measured),
        number(&with_unit("median_computed"), &|group| group.median_computed),
        number("e50", &|group| group.e50),
    ]);
    columns.push(number("median_error", &|group| group.median_error));
    columns.extend(band(groups, "median_error", &|group| group.median_error_band));
    columns.push(pair("log_bias", |pairs| pairs.log_bias));
    columns.extend(band(groups, "log_bias", &|group| of_pairs(group, |bands| bands.log_bias)));
    columns.push(pair("log_dispersion", |pairs| pairs.log_dispersion));
    columns.extend(band(groups, "log_dispersion", &|group| of_pairs(group, |bands| bands.log_dispersion)));
    columns.extend([
        collapse("finite_pairs", |pairs| pairs.finite),
        pair("pearson", |pairs| pairs.pearson),
        pair("spearman", |pairs| pairs.spearman),
        pair("within_1_5", |pairs| Some(pairs.within_1_5)),
        pair("within_2", |pairs| Some(pairs.within_2)),
        collapse("collapses_both", |pairs| pairs.collapses.both),
        collapse("collapses_measured_only", |pairs| pairs.collapses.measured_only),
        collapse("collapses_computed_only", |pairs| pairs.collapses.computed_only),
        count("measured_collapses", &|group| Some(group.measured_collapses)),
        count("computed_collapses", &|group| Some(group.computed_collapses)),
        count("measured_above_limit", &|group| Some(group.censored.map_or(0, |censored| censored.measured))),
        count("computed_above_limit", &|group| Some(group.censored.map_or(0, |censored| censored.computed))),
        number("ks_distance_at_limits", &|group| group.censored.map(|censored| censored.ks_distance_at_limits)),
        number(&with_unit("median_measured_above"), &|group| group.median_measured_above),
        number(&with_unit("median_computed_above"), &|group| group.median_computed_above),
    ]);
    columns
}

fn of_pairs(group: &GroupReport, of: fn(&Bands) -> Option<Quantiles>) -> Option<Quantiles> {
    group.pair_bands.as_ref().and_then(of)
}

/// Its name at the end of a column, and its value.
type Quantile = (&'static str, fn(Quantiles) -> f64);

/// 5, 50 and 95 % of a statistic.
fn band(groups: &[GroupReport], name: &str, of: &dyn Fn(&GroupReport) -> Option<Quantiles>) -> Vec<Column> {
    let quantiles: [Quantile; 3] = [("q05", |q| q.q05), ("q50", |q| q.q50), ("q95", |q| q.q95)];
    let columns = quantiles.map(|(which, value)| {
        let cells = groups.iter().map(|group| of(group).map(value)).collect::<Vec<Option<f64>>>();
        Column::new(format!("{name}_{which}").into(), cells)
    });
    columns.to_vec()
}
