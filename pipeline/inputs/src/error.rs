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
#[error("{0}")]
pub enum InputsError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// A record cannot be read or used, or no synthetic one can be made as asked.
    Motion(#[from] MotionError),
    /// A hazard curve cannot be read or used.
    Hazard(#[from] HazardError),
    /// Structures that cannot be drawn.
    Uncertainty(#[from] UncertaintyError),
    /// A frame that cannot be shaken so.
    Frame(#[from] FrameError),
}

uplift_job::through_job_error!(InputsError: FileError);
