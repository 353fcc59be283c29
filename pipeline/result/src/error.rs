//! Why a result cannot be read or written.

use thiserror::Error;
use uplift_job::JobError;
use uplift_labelled::LabelledError;

/// Why a result cannot be read or written.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum ResultError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// A study that TOML cannot hold; one that was loaded is none.
    StudyToml(#[from] toml::ser::Error),
}

uplift_job::through_job_error!(ResultError: LabelledError);
