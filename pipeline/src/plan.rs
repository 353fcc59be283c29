//! What a study costs, of whichever kind, once everything that can be wrong with it has been looked at.

use std::path::Path;

use serde::Serialize;
use uplift_study::AnyStudy;

use crate::error::UpliftError;
use crate::events::Events;
pub use crate::frame::PlanHead;
use crate::frame::RunOptions;
use crate::run::check_outputs;
use crate::{displacement, uniform_risk};

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
    check_outputs(study, &RunOptions { study_file: study_file.to_owned(), ..RunOptions::default() })?;
    match study {
        AnyStudy::UniformRisk(study) => uniform_risk::plan(study, study_file, events).map(Plan::UniformRisk),
        AnyStudy::Displacement(study) => displacement::plan(study, study_file).map(Plan::Displacement),
    }
}
