//! Why a single test was not carried out.

use thiserror::Error;
use uplift_block::BlockError;
use uplift_design::DesignError;
use uplift_fragility::FragilityError;
use uplift_frame::FrameError;
use uplift_ida::IdaError;
use uplift_inputs::InputsError;
use uplift_job::JobError;
use uplift_motion::MotionError;
use uplift_oscillator::OscillatorError;
use uplift_result::ResultError;
use uplift_statics::StaticsError;
use uplift_structure::StructureError;
use uplift_study::StudyError;

/// Why a single test was not carried out.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum LaboratoryError {
    /// What keeps any job from being done.
    Job(#[from] JobError),
    /// Records or hazard curves that cannot be used.
    Inputs(#[from] InputsError),
    /// A result that cannot be read or written.
    Result(#[from] ResultError),
    /// The structure file has mistakes.
    Study(#[from] StudyError),
    /// A structure that cannot be judged.
    Design(#[from] DesignError),
    /// A structure that cannot be, or to which a rule does not apply.
    Structure(#[from] StructureError),
    /// Columns, a restrainer or a protocol that cannot be, or a displacement beyond their reach.
    Statics(#[from] StaticsError),
    /// Responses of which no fragility can be made.
    Fragility(#[from] FragilityError),
    /// A frame that cannot be shaken so.
    Frame(#[from] FrameError),
    /// An oscillator or its excitation that cannot be.
    Oscillator(#[from] OscillatorError),
    /// Blocks or pulses that cannot be; all that was found.
    #[error("{}", uplift_job::list("", .0))]
    Blocks(Vec<BlockError>),
    /// A record cannot be read or used, or no synthetic one can be made as asked.
    Motion(#[from] MotionError),
}

uplift_job::through_job_error!(LaboratoryError: IdaError);

impl From<BlockError> for LaboratoryError {
    fn from(error: BlockError) -> Self {
        Self::Blocks(vec![error])
    }
}
