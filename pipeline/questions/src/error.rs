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
pub enum QuestionsError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// A result that cannot be read or written.
    #[error("{0}")]
    Result(#[from] ResultError),
    /// Spectra that cannot be computed.
    #[error("{0}")]
    UniformRisk(#[from] UniformRiskError),
    /// Demands and hazard that do not fit together.
    #[error("{0}")]
    Risk(#[from] RiskError),
    /// Resamples that cannot be drawn.
    #[error("{0}")]
    Bootstrap(#[from] BootstrapError),
}

impl From<LabelledError> for QuestionsError {
    fn from(error: LabelledError) -> Self {
        JobError::from(error).into()
    }
}
