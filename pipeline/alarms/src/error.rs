//! Why a result cannot be looked at.

use thiserror::Error;
use uplift_hazard::HazardError;
use uplift_job::JobError;
use uplift_result::ResultError;
use uplift_uniform_risk::UniformRiskError;

/// Why a result cannot be looked at.
#[derive(Debug, Error)]
pub enum AlarmsError {
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
}
