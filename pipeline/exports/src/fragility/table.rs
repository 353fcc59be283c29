//! Fragilities as tidy tables: the counts level by level, and the fits.

use polars::prelude::Column;
use uplift_fragility::FragilityError;
use uplift_job::table::ColumnsOf;

use super::curves::{Fragility, StateFragility};

/// The columns by which the tables are known.
pub(super) const COLUMN: &str = "limit_state";
pub(super) const COLUMN_OF_FITS: &str = "beta_standard_error";

type Row<'a> = (&'a Fragility, &'a StateFragility);

fn states(fragilities: &[Fragility]) -> impl Iterator<Item = Row<'_>> {
    fragilities.iter().flat_map(|of| of.states.iter().map(move |state| (of, state)))
}

/// A row each system, measure, limit state and level.
pub(super) fn columns(fragilities: &[Fragility]) -> Vec<Column> {
    let rows = states(fragilities).flat_map(|row| (0..row.0.levels.len()).map(move |level| (row, level)));
    ColumnsOf::new(rows)
        .with("id", |((of, _), _)| of.id())
        .with("system", |((of, _), _)| of.system.clone())
        .with("im", |((of, _), _)| of.measure.label())
        .with("unit", |((of, _), _)| of.measure.unit())
        .with(COLUMN, |((_, state), _)| state.name.clone())
        .with("displacement_m", |((_, state), _)| state.displacement_m)
        .with("level", |((of, _), level)| of.levels[level])
        .with("exceeding", |((_, state), level)| state.counts[level].exceedances)
        .with("records", |((_, state), level)| state.counts[level].trials)
        .with("share", |((_, state), level)| state.shares[level])
        .with("lognormal", |((of, state), level)| {
            state.lognormal.as_ref().ok().map(|(fit, _)| fit.probability(of.levels[level]))
        })
        .with("zero_inflated", |((of, state), level)| {
            state.zero_inflated.as_ref().ok().map(|(fit, _)| fit.probability(of.levels[level]))
        })
        .build()
}

/// A row each system, measure and limit state.
pub(super) fn columns_of_fits(fragilities: &[Fragility]) -> Vec<Column> {
    let lognormal = |row: Row<'_>| row.1.lognormal.clone().ok();
    let zero_inflated = |row: Row<'_>| row.1.zero_inflated.clone().ok();
    let mut table = ColumnsOf::new(states(fragilities))
        .with("id", |(of, _)| of.id())
        .with("im", |(of, _)| of.measure.label())
        .with("unit", |(of, _)| of.measure.unit())
        .with(COLUMN, |(_, state)| state.name.clone())
        .with("displacement_m", |(_, state)| state.displacement_m)
        .with("theta", |row| lognormal(row).map(|(fit, _)| fit.median()))
        .with("beta", |row| lognormal(row).map(|(fit, _)| fit.dispersion()))
        .with("log_theta_standard_error", |(_, state)| state.spread.map(|spread| spread.log_median))
        .with(COLUMN_OF_FITS, |(_, state)| state.spread.map(|spread| spread.dispersion))
        .with("log_likelihood", |row| lognormal(row).map(|(_, goodness)| goodness.log_likelihood))
        .with("deviance", |row| lognormal(row).map(|(_, goodness)| goodness.deviance))
        .with("largest_error", |row| lognormal(row).map(|(_, goodness)| goodness.largest_error));
    table = table
        .with("theta_uplift", |row| zero_inflated(row).map(|(fit, _)| fit.uplift.median()))
        .with("beta_uplift", |row| zero_inflated(row).map(|(fit, _)| fit.uplift.dispersion()))
        .with("theta_beyond", |row| zero_inflated(row).map(|(fit, _)| fit.beyond.median()))
        .with("beta_beyond", |row| zero_inflated(row).map(|(fit, _)| fit.beyond.dispersion()))
        .with("zero_inflated_log_likelihood", |row| zero_inflated(row).map(|(_, goodness)| goodness.log_likelihood))
        .with("zero_inflated_deviance", |row| zero_inflated(row).map(|(_, goodness)| goodness.deviance))
        .with("zero_inflated_largest_error", |row| zero_inflated(row).map(|(_, goodness)| goodness.largest_error));
    let problem = |(_, state): Row<'_>| {
        let of_fits = [state.lognormal.as_ref().err(), state.zero_inflated.as_ref().err()];
        // of uplift itself nothing is missing
        let is_missing = |error: &&FragilityError| !matches!(error, FragilityError::NotBeyondUplift { .. });
        let mut problems: Vec<String> =
            of_fits.into_iter().flatten().filter(is_missing).map(ToString::to_string).collect();
        problems.dedup();
        problems.join("; ")
    };
    table.with("problem", problem).build()
}
