//! Why spectra were not computed.

use thiserror::Error;
use uplift_consistency::ConsistencyError;
use uplift_fragility::FragilityError;
use uplift_hazard::HazardError;
use uplift_ida::IdaError;
use uplift_inputs::InputsError;
use uplift_job::JobError;
use uplift_result::ResultError;
use uplift_risk::RiskError;

/// Why spectra were not computed.
#[derive(Debug, Error)]
pub enum UniformRiskError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// Records or hazard curves that cannot be used.
    #[error("{0}")]
    Inputs(#[from] InputsError),
    /// A result that cannot be read or written.
    #[error("{0}")]
    Result(#[from] ResultError),
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
}

impl From<IdaError> for UniformRiskError {
    fn from(error: IdaError) -> Self {
        JobError::from(error).into()
    }
}

impl From<ConsistencyError> for UniformRiskError {
    fn from(error: ConsistencyError) -> Self {
        match error {
            ConsistencyError::Risk(error) => error.into(),
            other => Self::Consistency(Box::new(other)),
        }
    }
}
