//! A measured curve that is laid over the computed one.

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_job::ReferenceTable;
use uplift_statics::{LoopCycle, MeasuredLoop, RestrainedColumns};

use crate::error::LaboratoryError;

/// Drift ratios between which Table 5.1 takes the slope after uplift.
const SLOPE_DRIFTS: (f64, f64) = (0.03, 0.15);

/// Columns that give the displacement, with what makes metres of them; those of drift take the height.
const DISPLACEMENTS: [(&str, f64, bool); 4] = [
    ("displacement_m", 1.0, false),
    ("displacement_mm", 1e-3, false),
    ("drift", 1.0, true),
    ("drift_percent", 1e-2, true),
];
/// Columns that give the force, with what makes newtons of them.
const FORCES: [(&str, f64); 2] = [("force_n", 1.0), ("force_kn", 1e3)];

/// Drift ratio beyond which a displacement is taken for one in another unit: columns that lean so far lie.
const LARGEST_DRIFT: f64 = 2.0;

/// A measured curve beside the computed one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredCurve {
    /// The file.
    pub file: PathBuf,
    /// Points.
    pub points: usize,
    /// The largest force, and how it falls.
    pub positive: SideOfLoop,
    /// The least force, and how it falls.
    pub negative: SideOfLoop,
    /// Whole cycles, with the energy that they dissipate.
    pub cycles: Vec<LoopCycle>,
    /// Displacement and force, m and N.
    #[serde(skip)]
    pub curve: Vec<(f64, f64)>,
}

/// One side of a measured loop, as Table 5.1 tells it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SideOfLoop {
    /// The extreme force, N.
    pub peak_n: f64,
    /// The drift ratio where it was measured.
    pub drift_at_peak: f64,
    /// Slope of the loading branch of the largest cycle between drifts of 3 and 15 %, N/m; none where it does not reach
    /// them.
    pub slope_n_m: Option<f64>,
    /// The same of the computed curve, N/m.
    pub computed_slope_n_m: Option<f64>,
}

impl MeasuredCurve {
    /// Reads a table with a column of the displacement and one of the force.
    ///
    /// # Errors
    /// A file that is no such table, or has two columns of one quantity; cells that are no numbers; fewer than three
    /// rows; displacements in another unit than their column says.
    pub(super) fn read(file: &Path, columns: &RestrainedColumns) -> Result<Self, LaboratoryError> {
        let table = ReferenceTable::read_as("measured", file)?;
        let all = |names: &[&'static str]| names.iter().copied().filter(|name| table.has(name)).collect::<Vec<_>>();
        for names in [all(&DISPLACEMENTS.map(|(name, ..)| name)), all(&FORCES.map(|(name, _)| name))] {
            if names.len() > 1 {
                return Err(table.fail(format!("it has the columns {}: leave one", names.join(" and "))).into());
            }
        }
        let (x, to_m, by_height) = *DISPLACEMENTS.iter().find(|(name, ..)| table.has(name)).ok_or_else(|| {
            let names = DISPLACEMENTS.map(|(name, ..)| name).join(", ");
            table.fail(format!("it has no column of displacement: name one of its columns {names}"))
        })?;
        let (y, to_n) = *FORCES.iter().find(|(name, _)| table.has(name)).ok_or_else(|| {
            let names = FORCES.map(|(name, _)| name).join(", ");
            table.fail(format!("it has no column of force: name one of its columns {names}"))
        })?;
        let height_m = columns.geometry().height_m();
        let to_m = if by_height { to_m * height_m } else { to_m };
        let points = (0..table.rows())
            .map(|row| Ok((to_m * table.number::<f64>(x, row)?, to_n * table.number::<f64>(y, row)?)))
            .collect::<Result<Vec<_>, LaboratoryError>>()?;
        if let Some((row, (at_m, _))) =
            points.iter().enumerate().find(|(_, (at_m, _))| at_m.abs() > LARGEST_DRIFT * height_m)
        {
            return Err(table.fail(format!(
                "row {}, {x}: {} is {:.0} times the height of the columns: is it in the unit of its column? Lengths \
                 are displacement_m or displacement_mm, ratios drift or drift_percent",
                row + 1,
                table.text(x, row),
                at_m.abs() / height_m
            )).into());
        }
        let measured = MeasuredLoop::new(points).map_err(|error| table.fail(error))?;
        let (from, to) = SLOPE_DRIFTS;
        let computed_slope_n_m = columns.slope_between_drifts_n_m(from, to).ok();
        let side = |sign: f64, (peak_n, at_m): (f64, f64)| SideOfLoop {
            peak_n,
            drift_at_peak: at_m / height_m,
            slope_n_m: measured.loading_slope_n_m(sign * from * height_m, sign * to * height_m),
            computed_slope_n_m,
        };
        Ok(Self {
            file: file.to_owned(),
            points: measured.points.len(),
            positive: side(1.0, measured.peak),
            negative: side(-1.0, measured.trough),
            cycles: measured.cycles,
            curve: measured.points,
        })
    }
}
