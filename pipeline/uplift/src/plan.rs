//! What a study costs, of whichever kind, once everything that can be wrong with it has been looked at.

use serde::Serialize;
use uplift_job::events::Events;
use uplift_study::AnyStudy;

use crate::error::UpliftError;
use crate::run::{check_outputs, replaced};
pub use uplift_job::study_run::PlanHead;
use uplift_job::study_run::RunOptions;
use uplift_studies::{displacement, shake_table, uniform_risk};

/// What a study costs, by its kind.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum Plan {
    /// A study of uniform risk.
    UniformRisk(Box<uniform_risk::Plan>),
    /// A study of displacement spectra.
    Displacement(Box<displacement::Plan>),
    /// A study of a shaking table.
    ShakeTable(Box<shake_table::Plan>),
}

impl Plan {
    /// What every kind reports.
    pub fn head(&self) -> &PlanHead {
        match self {
            Self::UniformRisk(plan) => &plan.head,
            Self::Displacement(plan) => &plan.head,
            Self::ShakeTable(plan) => &plan.head,
        }
    }
}

/// Reads and checks all inputs of a study and measures what it would cost; nothing is written.
///
/// * `options` — those of the run that is meant
///
/// # Errors
/// Everything that would keep the study from being run, as far as it can be known before.
pub fn plan(study: &AnyStudy, options: &RunOptions, events: &dyn Events) -> Result<Plan, UpliftError> {
    check_outputs(study, options)?;
    let study_file = &options.study_file;
    let mut plan = match study {
        AnyStudy::UniformRisk(study) => Plan::UniformRisk(Box::new(uniform_risk::plan(study, study_file, events)?)),
        AnyStudy::Displacement(study) => Plan::Displacement(Box::new(displacement::plan(study, study_file, events)?)),
        AnyStudy::ShakeTable(study) => Plan::ShakeTable(Box::new(shake_table::plan(study, study_file, events)?)),
    };
    let head = match &mut plan {
        Plan::UniformRisk(plan) => &mut plan.head,
        Plan::Displacement(plan) => &mut plan.head,
        Plan::ShakeTable(plan) => &mut plan.head,
    };
    head.would_replace = replaced(study, options)?;
    Ok(plan)
}
