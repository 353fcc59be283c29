//! Pushovers and protocols as tables.

use std::path::Path;

use polars::prelude::Column;
use uplift_job::JobError;
use uplift_job::table::{ColumnsOf, write_table};
use uplift_statics::{CyclicState, LoadingProtocol, ProtocolPoint};

use super::report::PushoverReport;
use crate::error::LaboratoryError;

/// A column of every pushover, and of no other table.
pub(super) const PUSHOVER_COLUMN: &str = "top_moment_n_m";
/// A column of every protocol, and of no other table.
pub(super) const PROTOCOL_COLUMN: &str = "amplitude_drift";
/// A column of every pushover through a protocol, and of no other table.
pub(super) const CYCLIC_COLUMN: &str = "dissipated_j";

/// Most rows of a table; more is a slip.
const MOST_ROWS: u32 = 100_000;

/// Refuses a number of rows that makes no curve.
///
/// # Errors
/// That number.
pub(crate) fn check_rows(rows: u32) -> Result<(), LaboratoryError> {
    if (2..=MOST_ROWS).contains(&rows) {
        return Ok(());
    }
    Err(JobError::Usage(format!("{rows} rows: give from 2 to {MOST_ROWS}")).into())
}

/// Writes the rows, or the history of the protocol where there is one.
pub(super) fn write(report: &PushoverReport, file: &Path) -> Result<(), LaboratoryError> {
    let columns = match &report.cyclic {
        Some(cyclic) => cyclic_columns(&cyclic.states),
        None => pushover_columns(report),
    };
    let what = if report.cyclic.is_some() { "pushover through a protocol" } else { "pushover" };
    Ok(write_table(file, &provenance(&format!("{what}, structure {}", report.file.display())), columns)?)
}

pub(super) fn write_protocol(
    protocol: &LoadingProtocol,
    history: &[ProtocolPoint],
    file: &Path,
) -> Result<(), LaboratoryError> {
    let columns =
        protocol_columns(history, |point| *point).with(PROTOCOL_COLUMN, |point| protocol.amplitude(point.set));
    Ok(write_table(file, &provenance("loading protocol"), columns.build())?)
}

fn provenance(what: &str) -> String {
    format!("{}; {what}", uplift_job::outputs::mark())
}

fn pushover_columns(report: &PushoverReport) -> Vec<Column> {
    let mut columns = ColumnsOf::new(&report.rows)
        .with("displacement_m", |row| row.displacement_m)
        .with("drift", |row| row.drift)
        .with("rotation_rad", |row| row.rotation_rad)
        .with("force_n", |row| row.force_n)
        .with("elongation_m", |row| row.elongation_m)
        .with("tendon_n", |row| row.tendon_n)
        .with("spring_m", |row| row.spring_m)
        .with("top_axial_n", |row| row.sections.top_axial_n)
        .with("top_shear_n", |row| row.sections.top_shear_n)
        .with(PUSHOVER_COLUMN, |row| row.sections.top_moment_n_m)
        .with("base_axial_n", |row| row.sections.base_axial_n)
        .with("base_moment_n_m", |row| row.sections.base_moment_n_m)
        .with("energy_j", |row| row.energy_j)
        .build();
    for curve in &report.linear {
        let forces: Vec<f64> = curve.rows.iter().map(|row| row.force_n).collect();
        columns.push(Column::new(format!("linear_force_n_of_{:.0}_n_m", curve.stiffness_n_m).into(), forces));
    }
    columns
}

fn cyclic_columns(states: &[CyclicState]) -> Vec<Column> {
    protocol_columns(states, |state| state.point)
        .with("displacement_m", |state| state.displacement_m)
        .with("force_n", |state| state.force_n)
        .with("tendon_n", |state| state.tendon_n)
        .with("spring_m", |state| state.spring_m)
        .with(CYCLIC_COLUMN, |state| state.dissipated_j)
        .build()
}

/// The columns of the `point` of each of `rows`.
fn protocol_columns<R>(rows: &[R], point: fn(&R) -> ProtocolPoint) -> ColumnsOf<&R> {
    ColumnsOf::new(rows)
        .with("time_s", |row| point(row).time_s)
        .with("drift", |row| point(row).drift)
        .with("set", |row| point(row).set)
        .with("cycle", |row| point(row).cycle)
}
