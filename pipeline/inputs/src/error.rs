//! Why records and hazard curves cannot be used.

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_frame::FrameError;
use uplift_hazard::HazardError;
use uplift_job::JobError;
use uplift_labelled::LabelledError;
use uplift_motion::MotionError;
use uplift_oscillator::OscillatorError;
use uplift_statics::StaticsError;
use uplift_structure::StructureError;
use uplift_study::StudyError;
use uplift_uncertainty::UncertaintyError;

/// Why records and hazard curves cannot be used.
#[derive(Debug, Error)]
pub enum InputsError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// The study file has mistakes.
    #[error("{0}")]
    Study(#[from] StudyError),
    /// A record cannot be read or used, or no synthetic one can be made as asked.
    #[error("{0}")]
    Motion(#[from] MotionError),
    /// A hazard curve cannot be read or used.
    #[error("{0}")]
    Hazard(#[from] HazardError),
    /// Structures that cannot be drawn.
    #[error("{0}")]
    Uncertainty(#[from] UncertaintyError),
    /// A structure that cannot be, or to which a rule does not apply.
    #[error("{0}")]
    Structure(#[from] StructureError),
    /// An oscillator or its excitation that cannot be.
    #[error("{0}")]
    Oscillator(#[from] OscillatorError),
    /// A frame that cannot be shaken so.
    #[error("{0}")]
    Frame(#[from] FrameError),
    /// Columns, a restrainer or a protocol that cannot be, or a displacement beyond their reach.
    #[error("{0}")]
    Statics(#[from] StaticsError),
}

impl From<LabelledError> for InputsError {
    fn from(error: LabelledError) -> Self {
        JobError::from(error).into()
    }
}

impl From<FileError> for InputsError {
    fn from(error: FileError) -> Self {
        JobError::from(error).into()
    }
}
