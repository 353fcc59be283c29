//! The pushover of a structure.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::typed::number;
use uplift_statics::{EventKind, LoadingProtocol, RestrainedColumns, TendonPath, tilt};
use uplift_study::{ColumnShape, Structure};

use super::measured::MeasuredCurve;
use super::report::{CapacityReport, CyclicReport, LinearCurve, PushoverReport};
use super::tables;
use crate::error::LaboratoryError;

/// What is asked of a pushover.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct PushoverOptions {
    /// Largest displacement, m [default: a little beyond the capacity]
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub to_m: Option<f64>,
    /// Number of rows
    #[arg(long, value_name = "N", default_value_t = PushoverOptions::default().rows)]
    pub rows: u32,
    /// Add the linearised law (Eq. 5.2 to 5.7, 6.1, 6.2)
    #[arg(long)]
    pub linear: bool,
    /// Add linear restrainers of these stiffnesses, N/m
    #[arg(
        long = "stiffness-n-m", value_name = "K[,K…]", value_delimiter = ',', allow_negative_numbers = true,
        value_parser = number
    )]
    pub stiffnesses_n_m: Vec<f64>,
    /// Number of lost tendons
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub lost: u32,
    /// A loading protocol that the columns are put through.
    #[arg(skip)]
    pub protocol: Option<LoadingProtocol>,
    /// A measured curve, CSV, that is laid over.
    #[arg(skip)]
    pub measured: Option<PathBuf>,
    /// Where the rows are written, CSV; those of the protocol where there is one.
    #[arg(skip)]
    pub table: Option<PathBuf>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

impl Default for PushoverOptions {
    fn default() -> Self {
        Self {
            to_m: None,
            rows: 21,
            linear: false,
            stiffnesses_n_m: Vec::new(),
            lost: 0,
            protocol: None,
            measured: None,
            table: None,
            force: false,
        }
    }
}

/// Pushes the columns of a structure.
///
/// # Errors
/// A structure that has no columns; a displacement beyond their reach, or at which the springs stop them; more tendons
/// lost than there are; a measured curve that cannot be read; a table that would replace something else or cannot be
/// written.
pub fn pushover(
    structure: &Structure,
    options: &PushoverOptions,
    events: &dyn Events,
) -> Result<PushoverReport, LaboratoryError> {
    if let Some(table) = &options.table {
        let column = if options.protocol.is_some() { tables::CYCLIC_COLUMN } else { tables::PUSHOVER_COLUMN };
        let inputs: Vec<&Path> =
            [Some(&structure.file), options.measured.as_ref()].into_iter().flatten().map(PathBuf::as_path).collect();
        outputs::check(
            &[Output::new(table, OutputKind::Table(column)).with_result(&structure.file)],
            &inputs,
            options.force,
        )?;
    }
    tables::check_rows(options.rows)?;
    let columns = pushed(structure, options.lost)?;
    let capacity = capacity(&columns)?;
    let to_m = match options.to_m {
        Some(to_m) => to_m,
        None => reach_m(&columns, &capacity),
    };
    columns.at_displacement(to_m)?; // a refusal names what was asked for, not the first row beyond the reach
    let place_m = |row: u32| to_m * f64::from(row) / f64::from(options.rows - 1);
    let rows = (0..options.rows).map(|row| columns.at_displacement(place_m(row))).collect::<Result<Vec<_>, _>>()?;
    let own = options.linear.then_some(capacity.linear_stiffness_n_m);
    let linear = own
        .into_iter()
        .chain(options.stiffnesses_n_m.iter().copied())
        .map(|stiffness_n_m| linear_curve(&columns, stiffness_n_m, (0..options.rows).map(place_m)))
        .collect::<Result<Vec<_>, _>>()?;
    let cyclic = options.protocol.map(|protocol| CyclicReport::new(&columns, protocol)).transpose()?;
    let measured = options.measured.as_deref().map(|file| MeasuredCurve::read(file, &columns)).transpose()?;
    let geometry = columns.geometry();
    let mut report = PushoverReport {
        name: structure.name(),
        file: structure.file.clone(),
        columns: columns.columns(),
        restrained: columns.restrainer().map_or(0, |_| columns.restrained()),
        width_m: geometry.width_m(),
        height_m: geometry.height_m(),
        slenderness_rad: geometry.slenderness_rad(),
        top_load_n: columns.top_load_n(),
        column_weight_n: columns.column_weight_n(),
        anchorage: columns.restrainer().map(|_| anchorage_word(columns.path())),
        axial_load_ratio: axial_load_ratio(structure, &columns),
        uplift_force_n: columns.uplift_force_n(),
        warnings: warnings(&columns, to_m),
        capacity,
        events: columns.events(),
        rows,
        linear,
        cyclic,
        measured,
        files: Vec::new(),
        pushed: columns,
    };
    if let Some(table) = &options.table {
        events.writing_into(table.parent().unwrap_or(Path::new("")));
        tables::write(&report, table)?;
        report.files.push(table.clone());
    }
    Ok(report)
}

/// The columns of a structure, some of whose tendons are lost.
///
/// # Errors
/// A structure that has none, or fewer tendons.
pub fn pushed(structure: &Structure, lost: u32) -> Result<RestrainedColumns, LaboratoryError> {
    let Some(columns) = structure.columns.clone() else {
        return Err(JobError::Usage(format!(
            "{}: a pushover needs columns with flat ends, and kind \"{}\" has none: use block, frame or \
             restrained-frame",
            structure.file.display(),
            structure.description.kind.name()
        ))
        .into());
    };
    if lost == 0 {
        return Ok(columns);
    }
    let tendons = columns.restrainer().map_or(0, |_| columns.restrained());
    match tendons.checked_sub(lost) {
        Some(left) => Ok(columns.with_restrained(left)?),
        None => Err(JobError::Usage(format!("{lost} lost tendons: give at most {tendons}")).into()),
    }
}

/// How far columns can go.
///
/// # Errors
/// None that the columns themselves did not have.
pub fn capacity(columns: &RestrainedColumns) -> Result<CapacityReport, LaboratoryError> {
    let exact = columns.capacity();
    let stoppers = columns.restrainer().is_some_and(|held| held.parts().stopper.is_some());
    let exact_without_stoppers = if stoppers { columns.without_stoppers()?.capacity() } else { None };
    let equivalent_stiffness_n_m = columns.equivalent_stiffness_n_m()?;
    let secant_n_m = exact_without_stoppers.or(exact).and_then(|capacity| capacity.secant_n_m);
    let linear_stiffness_n_m = match columns.restrainer().map(|held| held.parts().spring) {
        Some(uplift_statics::Spring::Linear { stiffness_n_m }) => stiffness_n_m,
        Some(_) => secant_n_m.unwrap_or(equivalent_stiffness_n_m),
        None => 0.0,
    };
    let linear = columns.linear(linear_stiffness_n_m)?;
    Ok(CapacityReport {
        exact,
        exact_without_stoppers,
        linear_m: linear.capacity_m(),
        linear_stiffness_n_m,
        critical_stiffness_n_m: linear.critical_stiffness_n_m(),
        equivalent_stiffness_n_m,
    })
}

/// How far to look where nobody says: a little beyond the capacity, else to four times the slenderness or to where the
/// springs are flat.
fn reach_m(columns: &RestrainedColumns, capacity: &CapacityReport) -> f64 {
    let last_m = tilt::travel_m(columns.geometry(), columns.last_rotation_rad());
    let flat = columns.first(EventKind::SpringsFlat).map(|event| event.state.displacement_m);
    let four = tilt::travel_m(columns.geometry(), 4.0 * columns.geometry().slenderness_rad());
    let wanted_m = match &capacity.exact {
        Some(exact) => 1.05 * exact.displacement_m,
        None => flat.unwrap_or(f64::INFINITY).min(four),
    };
    wanted_m.min(last_m)
}

fn linear_curve(
    columns: &RestrainedColumns,
    stiffness_n_m: f64,
    displacements_m: impl Iterator<Item = f64>,
) -> Result<LinearCurve, LaboratoryError> {
    let law = columns.linear(stiffness_n_m)?;
    Ok(LinearCurve {
        stiffness_n_m,
        share_of_critical: stiffness_n_m / law.critical_stiffness_n_m(),
        capacity_m: law.capacity_m(),
        rows: displacements_m.map(|displacement_m| law.at(displacement_m)).collect(),
    })
}

/// What an anchorage is called in a file.
pub(crate) fn anchorage_word(path: TendonPath) -> &'static str {
    match path {
        TendonPath::Column => "column",
        TendonPath::Foundation => "foundation",
        TendonPath::Shifted { .. } => "shifted",
    }
}

/// Load on a column over the strength of its section; none where the structure does not give its strength.
pub fn axial_load_ratio(structure: &Structure, columns: &RestrainedColumns) -> Option<f64> {
    structure.f_cd_pa.map(|f_cd_pa| columns.top_load_n() / (area_m2(structure) * f_cd_pa))
}

/// Area of a column's section, m².
fn area_m2(structure: &Structure) -> f64 {
    let width_m = structure.description.geometry().map_or(f64::NAN, |geometry| geometry.width_m());
    match structure.column_shape {
        ColumnShape::Cylinder => 0.25 * std::f64::consts::PI * width_m * width_m,
        ColumnShape::Rectangle => width_m * width_m,
    }
}

/// What happens before `to_m` (m) that the law does not follow, and what it leaves out.
fn warnings(columns: &RestrainedColumns, to_m: f64) -> Vec<String> {
    let beyond = |kind, words: &str| {
        let event = columns.first(kind).filter(|event| event.state.displacement_m < to_m)?;
        Some(format!("{words} at {:.4} m, T = {:.0} N", event.state.displacement_m, event.state.tendon_n))
    };
    let mut warnings: Vec<String> = [
        beyond(EventKind::TendonYields, "the tendon yields; beyond that the curve is that of an elastic tendon:"),
        beyond(EventKind::TendonFails, "the tendon fails; beyond that there is no restrainer:"),
        beyond(EventKind::SpringsFlat, "the springs are flat; beyond that only the tendon stretches:"),
    ]
    .into_iter()
    .flatten()
    .collect();
    let lost = columns.columns() - columns.restrained();
    if columns.restrainer().is_some() && lost > 0 {
        let left = columns.restrained();
        warnings.push(format!(
            "{left} of {} columns are restrained: the twist of the deck is ignored; sections are those of a \
             restrained column",
            columns.columns()
        ));
    }
    warnings
}
