//! Pushovers and protocols as tables.

use std::path::Path;

use polars::prelude::Column;
use uplift_job::JobError;
use uplift_job::table::write_table;
use uplift_statics::{CyclicState, LoadingProtocol, ProtocolPoint, PushoverState};

use super::run::PushoverReport;
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
pub fn check_rows(rows: u32) -> Result<(), LaboratoryError> {
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
    let amplitudes: Vec<f64> = history.iter().map(|point| protocol.amplitude(point.set)).collect();
    let mut columns = protocol_columns(history);
    columns.push(Column::new(PROTOCOL_COLUMN.into(), amplitudes));
    Ok(write_table(file, &provenance("loading protocol"), columns)?)
}

fn provenance(what: &str) -> String {
    format!("{}; {what}", uplift_job::outputs::mark())
}

fn pushover_columns(report: &PushoverReport) -> Vec<Column> {
    let column = |name: &str, value: fn(&PushoverState) -> f64| {
        Column::new(name.into(), report.rows.iter().map(value).collect::<Vec<f64>>())
    };
    let spring: Vec<Option<f64>> = report.rows.iter().map(|row| row.spring_m).collect();
    let mut columns = vec![
        column("displacement_m", |row| row.displacement_m),
        column("drift", |row| row.drift),
        column("rotation_rad", |row| row.rotation_rad),
        column("force_n", |row| row.force_n),
        column("elongation_m", |row| row.elongation_m),
        column("tendon_n", |row| row.tendon_n),
        Column::new("spring_m".into(), spring),
        column("top_axial_n", |row| row.sections.top_axial_n),
        column("top_shear_n", |row| row.sections.top_shear_n),
        column(PUSHOVER_COLUMN, |row| row.sections.top_moment_n_m),
        column("base_axial_n", |row| row.sections.base_axial_n),
        column("base_moment_n_m", |row| row.sections.base_moment_n_m),
        column("energy_j", |row| row.energy_j),
    ];
    for curve in &report.linear {
        let forces: Vec<f64> = curve.rows.iter().map(|row| row.force_n).collect();
        columns.push(Column::new(format!("linear_force_n_of_{:.0}_n_m", curve.stiffness_n_m).into(), forces));
    }
    columns
}

fn cyclic_columns(states: &[CyclicState]) -> Vec<Column> {
    let mut columns = protocol_columns(&states.iter().map(|state| state.point).collect::<Vec<_>>());
    let optional = |name: &str, value: fn(&CyclicState) -> Option<f64>| {
        Column::new(name.into(), states.iter().map(value).collect::<Vec<Option<f64>>>())
    };
    columns.extend([
        optional("displacement_m", |state| Some(state.displacement_m)),
        optional("force_n", |state| state.force_n),
        optional("tendon_n", |state| Some(state.tendon_n)),
        optional("spring_m", |state| state.spring_m),
        optional(CYCLIC_COLUMN, |state| Some(state.dissipated_j)),
    ]);
    columns
}

fn protocol_columns(points: &[ProtocolPoint]) -> Vec<Column> {
    let column = |name: &str, value: fn(&ProtocolPoint) -> f64| {
        Column::new(name.into(), points.iter().map(value).collect::<Vec<f64>>())
    };
    let count = |name: &str, value: fn(&ProtocolPoint) -> u32| {
        Column::new(name.into(), points.iter().map(value).collect::<Vec<u32>>())
    };
    vec![
        column("time_s", |point| point.time_s),
        column("drift", |point| point.drift),
        count("set", |point| point.set),
        count("cycle", |point| point.cycle),
    ]
}
