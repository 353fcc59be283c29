//! Why a result cannot be read or written.

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_bootstrap::BootstrapError;
use uplift_fragility::FragilityError;
use uplift_hazard::HazardError;
use uplift_job::JobError;
use uplift_labelled::LabelledError;
use uplift_risk::RiskError;
use uplift_study::StudyError;

/// Why a result cannot be read or written.
#[derive(Debug, Error)]
pub enum ResultError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// The study file has mistakes.
    #[error("{0}")]
    Study(#[from] StudyError),
    /// A study that TOML cannot hold; one that was loaded is none.
    #[error("{0}")]
    StudyToml(#[from] toml::ser::Error),
    /// A hazard curve cannot be read or used.
    #[error("{0}")]
    Hazard(#[from] HazardError),
    /// Resamples that cannot be drawn.
    #[error("{0}")]
    Bootstrap(#[from] BootstrapError),
    /// Demands and hazard that do not fit together.
    #[error("{0}")]
    Risk(#[from] RiskError),
    /// Demands of which no fragility can be made.
    #[error("{0}")]
    Fragility(#[from] FragilityError),
}

impl From<LabelledError> for ResultError {
    fn from(error: LabelledError) -> Self {
        JobError::from(error).into()
    }
}

impl From<FileError> for ResultError {
    fn from(error: FileError) -> Self {
        JobError::from(error).into()
    }
}
