//! Why a result has no answer.

use thiserror::Error;
use uplift_bootstrap::BootstrapError;
use uplift_job::JobError;
use uplift_labelled::LabelledError;
use uplift_result::ResultError;
use uplift_risk::RiskError;
use uplift_uniform_risk::UniformRiskError;

/// Why a result has no answer.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum QuestionsError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// A result that cannot be read or written.
    Result(#[from] ResultError),
    /// Spectra that cannot be computed.
    UniformRisk(#[from] UniformRiskError),
    /// Demands and hazard that do not fit together.
    Risk(#[from] RiskError),
    /// Resamples that cannot be drawn.
    Bootstrap(#[from] BootstrapError),
}

uplift_job::through_job_error!(QuestionsError: LabelledError);
