//! What a study costs, of whichever kind, once everything that can be wrong with it has been looked at.

use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_study::AnyStudy;

use crate::error::UpliftError;
use crate::events::Events;
use crate::{displacement, uniform_risk};

/// What a study of any kind costs.
#[derive(Debug, Clone, Serialize)]
pub struct PlanHead {
    /// The study file as it was given.
    pub study: PathBuf,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// Nonlinear time histories of the spectra.
    pub analyses: u64,
    /// Threads that would compute them.
    pub threads: usize,
    /// Wall time on these, s, extrapolated from a sample that was run.
    pub seconds: f64,
    /// Memory, bytes.
    pub memory_bytes: u64,
    /// Disk, bytes, at most.
    pub disk_bytes: u64,
    /// The result file.
    pub output: PathBuf,
    /// What to know before running it.
    pub notes: Vec<String>,
}

/// What a study costs, by its kind.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Plan {
    /// A study of uniform risk.
    UniformRisk(uniform_risk::Plan),
    /// A study of displacement spectra.
    Displacement(displacement::Plan),
}

impl Plan {
    /// What both kinds tell.
    pub fn head(&self) -> &PlanHead {
        match self {
            Self::UniformRisk(plan) => &plan.head,
            Self::Displacement(plan) => &plan.head,
        }
    }
}

/// Reads and checks all inputs of a study and measures what it would cost; nothing is written.
///
/// * `study_file` — as it was given, for the report
///
/// # Errors
/// Everything that would keep the study from being run, as far as it can be known before.
pub fn plan(study: &AnyStudy, study_file: &Path, events: &dyn Events) -> Result<Plan, UpliftError> {
    match study {
        AnyStudy::UniformRisk(study) => uniform_risk::plan(study, study_file, events).map(Plan::UniformRisk),
        AnyStudy::Displacement(study) => displacement::plan(study, study_file).map(Plan::Displacement),
    }
}
