//! Why records and hazard curves cannot be used.

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_frame::FrameError;
use uplift_hazard::HazardError;
use uplift_job::JobError;
use uplift_motion::MotionError;
use uplift_uncertainty::UncertaintyError;

/// Why records and hazard curves cannot be used.
#[derive(Debug, Error)]
pub enum InputsError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// A record cannot be read or used, or no synthetic one can be made as asked.
    #[error("{0}")]
    Motion(#[from] MotionError),
    /// A hazard curve cannot be read or used.
    #[error("{0}")]
    Hazard(#[from] HazardError),
    /// Structures that cannot be drawn.
    #[error("{0}")]
    Uncertainty(#[from] UncertaintyError),
    /// A frame that cannot be shaken so.
    #[error("{0}")]
    Frame(#[from] FrameError),
}

impl From<FileError> for InputsError {
    fn from(error: FileError) -> Self {
        JobError::from(error).into()
    }
}
