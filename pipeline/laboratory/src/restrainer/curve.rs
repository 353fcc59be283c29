//! The force of a restrainer over its elongation (Figures 5.9 and 6.8).

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{ColumnsOf, write_table};
use uplift_job::typed::number;
use uplift_plausible::ELONGATION;
use uplift_statics::{Restrainer, Spring, Threshold};
use uplift_study::RestrainerFile;

use crate::error::LaboratoryError;
use crate::pushover::{anchorage_word, check_rows};

/// A column of every curve, and of no other table.
const CURVE_COLUMN: &str = "spring_secant_n_m";

/// What is asked of a curve.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct RestrainerCurveOptions {
    /// Largest elongation, m [default: flat springs or yield]
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub to_m: Option<f64>,
    /// Number of rows
    #[arg(long, value_name = "N", default_value_t = RestrainerCurveOptions::default().rows)]
    pub rows: u32,
    /// Write the rows
    #[arg(short = 'o', long = "output", value_name = "FILE.csv")]
    pub table: Option<PathBuf>,
    /// Whether an existing file there is overwritten.
    #[arg(skip)]
    pub force: bool,
}

impl Default for RestrainerCurveOptions {
    fn default() -> Self {
        Self { to_m: None, rows: 21, table: None, force: false }
    }
}

/// A restrainer at an elongation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CurveRow {
    /// Elongation, m.
    pub elongation_m: f64,
    /// Force, N.
    pub force_n: f64,
    /// Secant stiffness from rest, N/m; none at rest.
    pub secant_n_m: Option<f64>,
    /// Tangent stiffness, N/m.
    pub stiffness_n_m: f64,
    /// Deformation of the springs, m.
    pub spring_m: Option<f64>,
    /// Secant stiffness of the springs alone, N/m.
    pub spring_secant_n_m: Option<f64>,
    /// Energy, J.
    pub energy_j: f64,
}

/// Where the law changes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ThresholdRow {
    /// What happens.
    pub event: &'static str,
    /// Elongation, m.
    pub elongation_m: f64,
    /// Force, N.
    pub force_n: f64,
    /// Deformation of the springs, m.
    pub spring_m: Option<f64>,
}

/// A stack in numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StackReport {
    /// Packets in alternate sense.
    pub springs: u32,
    /// Discs in the same sense in each.
    pub parallel: u32,
    /// Deformation when flat, m.
    pub flat_deformation_m: f64,
    /// Force when flat, N.
    pub flat_force_n: f64,
    /// Height of the unloaded stack, m.
    pub free_height_m: f64,
    /// `K4` of contact flats; 1 without.
    pub flats_factor: f64,
    /// `h0/t`, with contact flats `K4 h0'/t'`: below 1.414 the force rises throughout.
    pub snap_ratio: f64,
}

/// A restrainer in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestrainerCurve {
    /// Name for people.
    #[serde(skip)]
    pub name: String,
    /// The file.
    pub file: PathBuf,
    /// Its kind, as written.
    pub kind: &'static str,
    /// Where the tendon is anchored.
    pub anchorage: &'static str,
    /// Stiffness of the tendon, N/m.
    pub tendon_stiffness_n_m: Option<f64>,
    /// The stack, if it has one.
    pub stack: Option<StackReport>,
    /// Where the law changes.
    pub events: Vec<ThresholdRow>,
    /// Force and more over the elongation.
    pub rows: Vec<CurveRow>,
    /// The files written.
    pub files: Vec<PathBuf>,
    /// The restrainer.
    #[serde(skip)]
    pub restrainer: Restrainer,
}

/// Computes the force of a restrainer over its elongation.
///
/// # Errors
/// An elongation that is not positive, or at which flat springs stop the restrainer; a table that would replace
/// something else or cannot be written.
pub fn curve(
    of: &RestrainerFile,
    options: &RestrainerCurveOptions,
    events: &dyn Events,
) -> Result<RestrainerCurve, LaboratoryError> {
    if let Some(table) = &options.table {
        let output = Output::new(table, OutputKind::Table(CURVE_COLUMN)).with_result(&of.file);
        outputs::check(&[output], &[&of.file], options.force)?;
    }
    check_rows(options.rows)?;
    let restrainer = &of.restrainer;
    let to_m = options.to_m.unwrap_or_else(|| reach_m(restrainer));
    ELONGATION.check("the elongation", to_m).map_err(|error| JobError::Usage(error.to_string()))?;
    let rows = (0..options.rows)
        .map(|row| row_at(restrainer, to_m * f64::from(row) / f64::from(options.rows - 1)))
        .collect::<Result<Vec<_>, _>>()?;
    let stack = match restrainer.parts().spring {
        Spring::Discs(stack) => Some(StackReport {
            springs: stack.series(),
            parallel: stack.parallel(),
            flat_deformation_m: stack.flat_deformation_m(),
            flat_force_n: stack.flat_force_n(),
            free_height_m: stack.free_height_m(),
            flats_factor: stack.disc().flats_factor(),
            snap_ratio: stack.disc().snap_ratio(),
        }),
        Spring::Rigid | Spring::Linear { .. } => None,
    };
    let mut report = RestrainerCurve {
        name: of.name(),
        file: of.file.clone(),
        kind: of.description.kind.name(),
        anchorage: anchorage_word(of.path),
        tendon_stiffness_n_m: restrainer.parts().tendon.map(|tendon| tendon.stiffness_n_m),
        stack,
        events: thresholds(restrainer)?,
        rows,
        files: Vec::new(),
        restrainer: restrainer.clone(),
    };
    if let Some(table) = &options.table {
        events.writing_into(table.parent().unwrap_or(Path::new("")));
        write(&report, table)?;
        report.files.push(table.clone());
    }
    Ok(report)
}

fn row_at(restrainer: &Restrainer, elongation_m: f64) -> Result<CurveRow, LaboratoryError> {
    let state = restrainer.at(elongation_m)?;
    let from_rest_n = state.force_n - restrainer.parts().prestress_n;
    let spring_m = state.deformation_m;
    Ok(CurveRow {
        elongation_m,
        force_n: state.force_n,
        secant_n_m: (elongation_m > 0.0).then(|| from_rest_n / elongation_m),
        stiffness_n_m: state.stiffness_n_m,
        spring_m,
        spring_secant_n_m: spring_m.filter(|spring_m| *spring_m > 0.0).map(|spring_m| state.force_n / spring_m),
        energy_j: state.energy_j,
    })
}

/// To the first that ends it; a linear spring by itself has no end.
fn reach_m(restrainer: &Restrainer) -> f64 {
    let yields_m =
        restrainer.parts().tendon.and_then(|tendon| tendon.yield_n).and_then(|n| restrainer.elongation_at_force_m(n));
    let ends = [restrainer.elongation_at_m(Threshold::SpringsFlat), yields_m];
    ends.into_iter().flatten().reduce(f64::min).unwrap_or(0.05)
}

fn thresholds(restrainer: &Restrainer) -> Result<Vec<ThresholdRow>, LaboratoryError> {
    let tendon = restrainer.parts().tendon;
    let by_force = |force_n: Option<f64>| force_n.and_then(|force_n| restrainer.elongation_at_force_m(force_n));
    let mut rows = Vec::new();
    for (event, elongation_m) in [
        ("tendon is taut", restrainer.elongation_at_m(Threshold::Taut).filter(|m| *m > 0.0)),
        ("stopper engages", restrainer.elongation_at_m(Threshold::StopperEngages)),
        ("stopper yields", restrainer.elongation_at_m(Threshold::StopperYields)),
        ("springs are flat", restrainer.elongation_at_m(Threshold::SpringsFlat)),
        ("tendon yields", by_force(tendon.and_then(|tendon| tendon.yield_n))),
        ("tendon fails", by_force(tendon.and_then(|tendon| tendon.failure_n))),
    ] {
        if let Some(elongation_m) = elongation_m {
            let state = restrainer.at(elongation_m)?;
            rows.push(ThresholdRow { event, elongation_m, force_n: state.force_n, spring_m: state.deformation_m });
        }
    }
    rows.sort_by(|left, right| left.elongation_m.total_cmp(&right.elongation_m));
    Ok(rows)
}

fn write(report: &RestrainerCurve, file: &Path) -> Result<(), LaboratoryError> {
    let columns = ColumnsOf::new(&report.rows)
        .with("elongation_m", |row| row.elongation_m)
        .with("force_n", |row| row.force_n)
        .with("secant_n_m", |row| row.secant_n_m)
        .with("stiffness_n_m", |row| row.stiffness_n_m)
        .with("spring_m", |row| row.spring_m)
        .with(CURVE_COLUMN, |row| row.spring_secant_n_m)
        .with("energy_j", |row| row.energy_j);
    let line = format!("{}; restrainer, structure {}", outputs::mark(), report.file.display());
    Ok(write_table(file, &line, columns.build())?)
}
