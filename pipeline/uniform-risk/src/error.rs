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
#[error("{0}")]
pub enum UniformRiskError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// Records or hazard curves that cannot be used.
    Inputs(#[from] InputsError),
    /// A result that cannot be read or written.
    Result(#[from] ResultError),
    /// A hazard curve cannot be read or used.
    Hazard(#[from] HazardError),
    /// Demands and hazard that do not fit together.
    Risk(#[from] RiskError),
    /// Demands of which no fragility can be made.
    Fragility(#[from] FragilityError),
    /// Records and hazard that cannot be held against each other.
    Consistency(#[source] Box<ConsistencyError>),
}

uplift_job::through_job_error!(UniformRiskError: IdaError);

impl From<ConsistencyError> for UniformRiskError {
    fn from(error: ConsistencyError) -> Self {
        match error {
            ConsistencyError::Risk(error) => error.into(),
            other => Self::Consistency(Box::new(other)),
        }
    }
}
