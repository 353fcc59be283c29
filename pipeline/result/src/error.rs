//! Why a result cannot be read or written.

use thiserror::Error;
use uplift_job::JobError;
use uplift_labelled::LabelledError;

/// Why a result cannot be read or written.
#[derive(Debug, Error)]
pub enum ResultError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// A study that TOML cannot hold; one that was loaded is none.
    #[error("{0}")]
    StudyToml(#[from] toml::ser::Error),
}

impl From<LabelledError> for ResultError {
    fn from(error: LabelledError) -> Self {
        JobError::from(error).into()
    }
}
