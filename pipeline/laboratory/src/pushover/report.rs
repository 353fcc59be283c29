//! The report of a pushover.

use std::path::PathBuf;

use serde::Serialize;
use uplift_statics::{Capacity, CyclicState, Event, LinearState, PushoverState, RestrainedColumns};

use super::measured::MeasuredCurve;

/// Columns under a protocol.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CyclicReport {
    /// Amplitudes of the sets, as drift ratios.
    pub amplitudes: Vec<f64>,
    /// Duration, s.
    pub duration_s: f64,
    /// Largest force on the deck, N.
    pub largest_force_n: f64,
    /// Largest force of a restrainer, N.
    pub largest_tendon_n: f64,
    /// Energy that yielding stoppers dissipate, all cycles together, J; 0 where none yields.
    pub dissipated_j: f64,
    /// The history.
    #[serde(skip)]
    pub states: Vec<CyclicState>,
}

/// How far the columns can go.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CapacityReport {
    /// By the exact law; none where the force does not vanish before the springs are flat.
    pub exact: Option<Capacity>,
    /// The same without stoppers; none where the columns have none.
    pub exact_without_stoppers: Option<Capacity>,
    /// By the linear law, with the secant stiffness at the exact capacity, m; none where its force does not fall.
    pub linear_m: Option<f64>,
    /// That stiffness, N/m: the restrainer's own where it is linear.
    pub linear_stiffness_n_m: f64,
    /// Stiffness of a restrainer at which the linear force neither falls nor rises, N/m.
    pub critical_stiffness_n_m: f64,
    /// Stiffness of the equivalent oscillator, that with which the linear law has the exact capacity, N/m.
    pub equivalent_stiffness_n_m: f64,
}

/// The linearised law with a restrainer of constant stiffness.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LinearCurve {
    /// Stiffness of the restrainer, N/m.
    pub stiffness_n_m: f64,
    /// The same over the critical one.
    pub share_of_critical: f64,
    /// Displacement capacity, m; none where the force does not fall.
    pub capacity_m: Option<f64>,
    /// Everything over the displacement.
    pub rows: Vec<LinearState>,
}

/// The report of a pushover.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PushoverReport {
    /// Name for people.
    #[serde(skip)]
    pub name: String,
    /// The structure file.
    pub file: PathBuf,
    /// Number of columns.
    pub columns: u32,
    /// Columns with a restrainer.
    pub restrained: u32,
    /// Width of a column, m.
    pub width_m: f64,
    /// Height of a column, m.
    pub height_m: f64,
    /// Slenderness, rad.
    pub slenderness_rad: f64,
    /// Load on the top of a column, N.
    pub top_load_n: f64,
    /// Weight of a column, N.
    pub column_weight_n: f64,
    /// Where the tendons are anchored: `column`, `foundation` or `shifted`; none without restrainers.
    pub anchorage: Option<&'static str>,
    /// Load on a column over the strength of its section, `P/(A_c f_cd)`; none where the strength is not given.
    pub axial_load_ratio: Option<f64>,
    /// Force at uplift, N.
    pub uplift_force_n: f64,
    /// How far the columns can go.
    pub capacity: CapacityReport,
    /// What happens on the way.
    pub events: Vec<Event>,
    /// Force, restrainer and sections over the displacement.
    pub rows: Vec<PushoverState>,
    /// The linearised law; none unless it or stiffnesses were asked for.
    pub linear: Vec<LinearCurve>,
    /// The columns under a protocol.
    pub cyclic: Option<CyclicReport>,
    /// A measured curve.
    pub measured: Option<MeasuredCurve>,
    /// What to know before using the numbers.
    pub warnings: Vec<String>,
    /// The files written.
    pub files: Vec<PathBuf>,
    /// What was pushed.
    #[serde(skip)]
    pub pushed: RestrainedColumns,
}
