//! Why analyses were not carried out.

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_ida::IdaError;
use uplift_job::JobError;

use crate::checkpoint::CheckpointError;

/// Why analyses were not carried out.
#[derive(Debug, Error)]
pub enum EngineError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// A file of finished analysis rows cannot be used.
    #[error("{0}")]
    Checkpoint(#[from] CheckpointError),
}

impl From<IdaError> for EngineError {
    fn from(error: IdaError) -> Self {
        JobError::from(error).into()
    }
}

impl From<FileError> for EngineError {
    fn from(error: FileError) -> Self {
        JobError::from(error).into()
    }
}
