//! A library as tidy tables.

use polars::prelude::Column;
use uplift_job::table::ColumnsOf;

use super::compute::{MeasureReport, SystemReport};
use super::fits::SurfaceReport;

/// Name of a table, and a column by which one of its kind is known.
pub(super) const TABLES: [(&str, &str); 3] =
    [("levels.csv", "share_rocking"), ("fits.csv", "dispersion_standard_error"), ("surfaces.csv", "c_standard_error")];

/// The tables in the order of [`TABLES`].
pub(super) fn tables(systems: &[SystemReport]) -> [Vec<Column>; 3] {
    [levels(systems), fits(systems), surfaces(systems)]
}

fn measures(systems: &[SystemReport]) -> impl Iterator<Item = (&SystemReport, &MeasureReport)> {
    systems.iter().flat_map(|system| system.measures.iter().map(move |measure| (system, measure)))
}

/// A table of `rows`, with the columns that say which `system` each is of.
fn with_systems<'a, R: Copy>(rows: impl IntoIterator<Item = R>, system: fn(R) -> &'a SystemReport) -> ColumnsOf<R> {
    ColumnsOf::new(rows)
        .with("kind", |row| system(row).kind)
        .with("size_m", |row| system(row).size_m)
        .with("slenderness_rad", |row| system(row).slenderness_rad)
        .with("strength", |row| system(row).strength)
        .with("uplift_displacement_m", |row| system(row).uplift_displacement_m)
        .with("capacity_m", |row| system(row).capacity_m)
        .with("restitution", |row| system(row).restitution)
        .with("uplift_acceleration_g", |row| system(row).uplift_acceleration_g)
        .with("p_rad_s", |row| system(row).p_rad_s)
}

/// A row each system, intensity and level.
fn levels(systems: &[SystemReport]) -> Vec<Column> {
    let rows = measures(systems)
        .flat_map(|(system, measure)| measure.levels.iter().map(move |level| (system, measure, level)));
    let share = |count: u32, motions: u32| f64::from(count) / f64::from(motions);
    with_systems(rows, |(system, ..)| system)
        .with("im", |(_, measure, _)| measure.measure.key())
        .with("level", |(.., level)| level.level)
        .with("motions", |(.., level)| level.motions)
        .with(TABLES[0].1, |(.., level)| share(level.rocking, level.motions))
        .with("share_overturning", |(.., level)| share(level.overturned, level.motions))
        .with("response", |(system, ..)| system.response)
        .with("response_16", |(.., level)| level.percentiles[0])
        .with("response_50", |(.., level)| level.percentiles[1])
        .with("response_84", |(.., level)| level.percentiles[2])
        .with("dispersion", |(.., level)| level.dispersion)
        .build()
}

/// A row each system, intensity and event.
fn fits(systems: &[SystemReport]) -> Vec<Column> {
    let rows =
        measures(systems).flat_map(|(system, measure)| measure.fits.iter().map(move |fit| (system, measure, fit)));
    with_systems(rows, |(system, ..)| system)
        .with("im", |(_, measure, _)| measure.measure.key())
        .with("of", |(.., fit)| fit.of)
        .with("median", |(.., fit)| fit.median)
        .with("dispersion", |(.., fit)| fit.dispersion)
        .with("log_median_standard_error", |(.., fit)| fit.log_median_standard_error)
        .with(TABLES[1].1, |(.., fit)| fit.dispersion_standard_error)
        .with("largest_error", |(.., fit)| fit.largest_error)
        .with("problem", |(.., fit)| fit.problem.clone())
        .build()
}

/// A row each system that can overturn.
fn surfaces(systems: &[SystemReport]) -> Vec<Column> {
    let rows = systems.iter().filter_map(|system| Some((system, system.surface.as_ref()?)));
    let mut table = with_systems(rows, |(system, _)| system);
    let coefficient = |of: &SurfaceReport, place: usize| of.coefficients.map(|own| own[place]);
    let error = |of: &SurfaceReport, place: usize| of.standard_errors.map(|own| own[place]);
    for (place, name) in ["a", "b", "c"].into_iter().enumerate() {
        table = table.with(name, |(_, of)| coefficient(of, place));
    }
    for (place, name) in ["a_standard_error", "b_standard_error", TABLES[2].1].into_iter().enumerate() {
        table = table.with(name, |(_, of)| error(of, place));
    }
    table.with("largest_error", |(_, of)| of.largest_error).with("problem", |(_, of)| of.problem.clone()).build()
}
