//! Why a command did not do what was typed, and what the shell sees of it.

use std::error::Error;
use std::io;

use thiserror::Error;
use uplift::errors::{
    AlarmsError, DesignError, ExportsError, InputsError, LaboratoryError, QuestionsError, ResultError, StudiesError,
    UniformRiskError,
};
use uplift::study::StudyError;
use uplift::{JobError, UpliftError, cause};
use uplift_frame::FrameError;
use uplift_labelled::LabelledError;
use uplift_motion::MotionError;
use uplift_oscillator::OscillatorError;
use uplift_statics::StaticsError;

/// Why a command did not do what was typed.
#[derive(Debug, Error)]
pub(crate) enum CommandError {
    /// The job that was asked for failed.
    #[error(transparent)]
    Uplift(#[from] UpliftError),
    /// What was typed does not fit together.
    #[error("{0}")]
    Usage(String),
    /// The user stopped what leaves nothing behind.
    #[error("interrupted: {0}")]
    Interrupted(&'static str),
    /// The reader of the output went away, as `uplift … | head` does.
    #[error("the output was closed")]
    OutputClosed,
    /// Standard output cannot be written.
    #[error("standard output cannot be written: {0}")]
    Output(io::Error),
}

impl CommandError {
    /// The exit code of what the user stopped.
    pub(crate) const STOPPED: u8 = 5;

    /// What the shell sees: 2 usage, 3 study file, 4 input data or disk, 5 interrupted.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::OutputClosed => 0,
            Self::Usage(_) => 2,
            Self::Uplift(error) if is_typed(error) => 2,
            Self::Uplift(UpliftError::Variants(_)) => 3,
            Self::Uplift(error) if error.root().is::<StudyError>() || is_of_structure(error) => 3,
            Self::Interrupted(_) => Self::STOPPED,
            Self::Uplift(error) if is_stopped(error) => Self::STOPPED,
            // whatever else a job meets is in the input data or on the disk
            Self::Output(_) | Self::Uplift(_) => 4,
        }
    }

    /// One mistake in the input data.
    pub(crate) fn input(message: impl Into<String>) -> Self {
        Self::Uplift(JobError::input(message).into())
    }
}

/// Whether what was typed is at fault. Oscillators, blocks, pulses and what a synthetic record is asked to be are
/// typed, too; those of a file are said to be of it.
fn is_typed(error: &UpliftError) -> bool {
    let root = error.root();
    let job =
        matches!(root.downcast_ref(), Some(JobError::Usage(_) | JobError::Choice { .. } | JobError::Implausible(_)));
    let motion = matches!(
        root.downcast_ref(),
        Some(MotionError::SyntheticOption { .. } | MotionError::SyntheticCandidates { .. })
    );
    let system = root.is::<OscillatorError>() || root.is::<StaticsError>() || root.is::<FrameError>();
    job || motion || system || !error.blocks().is_empty()
}

/// Whether a structure file describes what cannot be; a result, which is the other file that a model may fail in, is
/// input data.
fn is_of_structure(error: &UpliftError) -> bool {
    let Some(JobError::InFile { source, path }) = error.root().downcast_ref() else { return false };
    if path.extension().is_some_and(|extension| extension == "h5") {
        return false;
    }
    let source: &(dyn Error + 'static) = source.as_ref();
    cause::<FrameError>(source).is_some()
        || cause::<OscillatorError>(source).is_some()
        || cause::<StaticsError>(source).is_some()
        || cause::<DesignError>(source).is_some_and(|error| matches!(error, DesignError::Blocks(_)))
}

/// Whether the user stopped the job.
pub(crate) fn is_stopped(error: &UpliftError) -> bool {
    matches!(error.root().downcast_ref(), Some(JobError::Interrupted | JobError::Paused { .. }))
}

/// Whatever a job or what it is given may fail with.
macro_rules! from_errors {
    ($($error:ty),+ $(,)?) => {
        $(impl From<$error> for CommandError {
            fn from(error: $error) -> Self {
                Self::Uplift(error.into())
            }
        })+
    };
}

from_errors!(
    JobError,
    InputsError,
    ResultError,
    UniformRiskError,
    AlarmsError,
    StudiesError,
    QuestionsError,
    DesignError,
    LaboratoryError,
    ExportsError,
    StudyError,
    LabelledError,
);

impl From<io::Error> for CommandError {
    /// Only standard output is written through plain `io`; files have their own errors.
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe { Self::OutputClosed } else { Self::Output(error) }
    }
}

#[cfg(test)]
mod tests {
    use uplift_block::BlockError;

    use super::*;

    #[test]
    fn only_a_structure_that_cannot_be_is_a_mistake_of_its_file() {
        let block = || BlockError::Empty { axis: "sizes" };
        let frame = || FrameError::RectangleWobbles;
        let code = |path: &str, error: DesignError| {
            let in_file = JobError::InFile { path: path.into(), source: Box::new(error) };
            CommandError::from(DesignError::from(in_file)).exit_code()
        };
        for file in ["pier.toml", "pier"] {
            assert_eq!([code(file, block().into()), code(file, frame().into())], [3, 3]);
            assert_eq!(code(file, JobError::input("the records differ").into()), 4);
        }
        assert_eq!([code("r.h5", block().into()), code("r.h5", frame().into())], [4, 4]);
    }
}
