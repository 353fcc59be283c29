//! Why analyses were not carried out.

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_ida::IdaError;
use uplift_job::JobError;

use crate::checkpoint::CheckpointError;

/// Why analyses were not carried out.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum EngineError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// A file of finished analysis rows cannot be used.
    Checkpoint(#[from] CheckpointError),
}

uplift_job::through_job_error!(EngineError: IdaError, FileError);
