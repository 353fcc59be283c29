//! What a search for stacks reports.

use std::path::PathBuf;

use serde::Serialize;
use uplift_design::OwnReport;
use uplift_job::alarm::Alarm;
use uplift_statics::{Candidate, Tolerance};

/// The target in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StackTarget {
    /// In words.
    pub words: String,
    /// Stiffness of a restrainer, N/m: asked for, or by the linear law for the capacity.
    pub stiffness_n_m: f64,
    /// Displacement capacity asked for, m.
    pub capacity_m: Option<f64>,
    /// Displacement that the spectrum demands, m; none where the target is no spectrum's.
    pub demand_m: Option<f64>,
    /// Travel at which the stiffness counts, m.
    pub at_m: f64,
    /// Displacement capacity of the columns without restrainers, m.
    pub free_capacity_m: f64,
    /// Stiffness at which the linear force neither falls nor rises, N/m.
    pub critical_stiffness_n_m: f64,
}

/// A stack at the demand of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AtDemand {
    /// Force of the tendon, N.
    pub tendon_n: f64,
    /// Deformation of the springs, m.
    pub spring_m: f64,
}

/// A stopper for a stack.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StopperReport {
    /// Force of the springs when it engages, N.
    pub engages_at_n: f64,
    /// Travel of the deck there, m; none where the columns do not come so far.
    pub engages_at_m: Option<f64>,
    /// The most at which its rods may yield, N; none where the springs alone are too much for the tendon, or are flat
    /// before the gap closes.
    pub most_yield_n: Option<f64>,
}

/// The report of a design.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestrainerDesign {
    /// Name for people.
    #[serde(skip)]
    pub name: String,
    /// The structure file.
    pub file: PathBuf,
    /// The catalogue.
    pub catalogue: PathBuf,
    /// Discs in it.
    pub discs: usize,
    /// The target.
    pub target: StackTarget,
    /// How many stacks meet it; 0 where a spectrum asks for no more than the columns have without.
    pub found: usize,
    /// The first of them.
    pub stacks: Vec<Candidate>,
    /// Each of these at the demand; none where the target is no spectrum's.
    pub at_demand: Vec<AtDemand>,
    /// The structure with the first of these, or without tendons where none is needed, itself; none by its proxy, and
    /// where the target is no spectrum's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame: Option<OwnReport>,
    /// Whether the verdict is that of the proxy alone.
    pub proxy: bool,
    /// Why, where it was not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub without_frame: Option<String>,
    /// A stopper for each of these; none was asked for where there is none.
    pub stoppers: Vec<StopperReport>,
    /// The stack that the tolerances are of, as [`stack_name`](super::stack_name) calls it; empty where none is needed.
    pub tolerances_of: String,
    /// What imperfections do to it.
    pub tolerances: Vec<Tolerance>,
    /// What to know before the demand of a spectrum is used, the worst first; none where the target is no spectrum's.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub alarms: Vec<Alarm>,
    /// The files written.
    pub files: Vec<PathBuf>,
}
