//! Why a result cannot be looked at.

use thiserror::Error;
use uplift_hazard::HazardError;
use uplift_job::JobError;
use uplift_result::ResultError;
use uplift_uniform_risk::UniformRiskError;

/// Why a result cannot be looked at.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum AlarmsError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// A result that cannot be read or written.
    Result(#[from] ResultError),
    /// Spectra that cannot be computed.
    UniformRisk(#[from] UniformRiskError),
    /// A hazard curve cannot be read or used.
    Hazard(#[from] HazardError),
}
