//! Why a single test was not carried out.

use thiserror::Error;
use uplift_block::BlockError;
use uplift_design::DesignError;
use uplift_frame::FrameError;
use uplift_ida::IdaError;
use uplift_inputs::InputsError;
use uplift_job::JobError;
use uplift_motion::MotionError;
use uplift_oscillator::OscillatorError;
use uplift_result::ResultError;
use uplift_statics::StaticsError;
use uplift_structure::StructureError;

/// Why a single test was not carried out.
#[derive(Debug, Error)]
pub enum LaboratoryError {
    /// What keeps any job from being done.
    #[error("{0}")]
    Job(#[from] JobError),
    /// Records or hazard curves that cannot be used.
    #[error("{0}")]
    Inputs(#[from] InputsError),
    /// A result that cannot be read or written.
    #[error("{0}")]
    Result(#[from] ResultError),
    /// A structure that cannot be judged.
    #[error("{0}")]
    Design(#[from] DesignError),
    /// A structure that cannot be, or to which a rule does not apply.
    #[error("{0}")]
    Structure(#[from] StructureError),
    /// Columns, a restrainer or a protocol that cannot be, or a displacement beyond their reach.
    #[error("{0}")]
    Statics(#[from] StaticsError),
    /// A frame that cannot be shaken so.
    #[error("{0}")]
    Frame(#[from] FrameError),
    /// An oscillator or its excitation that cannot be.
    #[error("{0}")]
    Oscillator(#[from] OscillatorError),
    /// Blocks or pulses that cannot be; all that was found.
    #[error("{}", uplift_job::list("", .0))]
    Blocks(Vec<BlockError>),
    /// A record cannot be read or used, or no synthetic one can be made as asked.
    #[error("{0}")]
    Motion(#[from] MotionError),
}

impl From<IdaError> for LaboratoryError {
    fn from(error: IdaError) -> Self {
        JobError::from(error).into()
    }
}

impl From<BlockError> for LaboratoryError {
    fn from(error: BlockError) -> Self {
        Self::Blocks(vec![error])
    }
}
