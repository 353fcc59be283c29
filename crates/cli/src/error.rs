//! Why a command did not do what was typed, and what the shell sees of it.

use std::io;

use thiserror::Error;
use uplift::UpliftError;
use uplift::study::StudyError;
use uplift_labelled::LabelledError;
use uplift_motion::MotionError;

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
    /// What the shell sees: 2 usage, 3 study file, 4 input data or disk, 5 interrupted.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::OutputClosed => 0,
            // oscillators, blocks, pulses and what a synthetic record is asked to be are typed, too; those of a file
            // are said to be of it
            Self::Usage(_)
            | Self::Uplift(
                UpliftError::Usage(_)
                | UpliftError::Choice { .. }
                | UpliftError::Oscillator(_)
                | UpliftError::Blocks(_)
                | UpliftError::Statics(_)
                | UpliftError::Frame(_)
                | UpliftError::Implausible(_)
                | UpliftError::Motion(MotionError::SyntheticOption { .. } | MotionError::SyntheticCandidates { .. }),
            ) => 2,
            Self::Uplift(UpliftError::Study(_)) => 3,
            Self::Interrupted(_) | Self::Uplift(UpliftError::Interrupted | UpliftError::Paused { .. }) => 5,
            // whatever else a job meets is in the input data or on the disk
            Self::Output(_) | Self::Uplift(_) => 4,
        }
    }

    /// One mistake in the input data.
    pub(crate) fn input(message: impl Into<String>) -> Self {
        Self::Uplift(UpliftError::input(message))
    }
}

impl From<StudyError> for CommandError {
    fn from(error: StudyError) -> Self {
        Self::Uplift(error.into())
    }
}

impl From<LabelledError> for CommandError {
    fn from(error: LabelledError) -> Self {
        Self::Uplift(error.into())
    }
}

impl From<io::Error> for CommandError {
    /// Only standard output is written through plain `io`; files have their own errors.
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe { Self::OutputClosed } else { Self::Output(error) }
    }
}
