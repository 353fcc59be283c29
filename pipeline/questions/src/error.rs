//! Why a result has no answer.

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_bootstrap::BootstrapError;
use uplift_consistency::ConsistencyError;
use uplift_fragility::FragilityError;
use uplift_hazard::HazardError;
use uplift_ida::IdaError;
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
    /// A hazard curve cannot be read or used.
    #[error("{0}")]
    Hazard(#[from] HazardError),
    /// Demands and hazard that do not fit together.
    #[error("{0}")]
    Risk(#[from] RiskError),
    /// Demands of which no fragility can be made.
    #[error("{0}")]
    Fragility(#[from] FragilityError),
    /// Records and hazard that cannot be held against each other.
    #[error("{0}")]
    Consistency(#[source] Box<ConsistencyError>),
    /// Resamples that cannot be drawn.
    #[error("{0}")]
    Bootstrap(#[from] BootstrapError),
}

impl From<LabelledError> for QuestionsError {
    fn from(error: LabelledError) -> Self {
        JobError::from(error).into()
    }
}

impl From<FileError> for QuestionsError {
    fn from(error: FileError) -> Self {
        JobError::from(error).into()
    }
}

impl From<ConsistencyError> for QuestionsError {
    fn from(error: ConsistencyError) -> Self {
        match error {
            ConsistencyError::Risk(error) => error.into(),
            other => Self::Consistency(Box::new(other)),
        }
    }
}

impl From<IdaError> for QuestionsError {
    fn from(error: IdaError) -> Self {
        JobError::from(error).into()
    }
}
