//! What can go wrong in the program, and how it is said.

use thiserror::Error;

use uplift_atomic_file::FileError;
use uplift_labelled::LabelledError;
use uplift_study::StudyError;

/// Why a command did not do what it was asked.
#[derive(Debug, Error)]
pub enum UpliftError {
    /// The study file has mistakes.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// The command line asks for something that does not fit together.
    #[error("{0}")]
    Usage(String),
    /// Records or hazard curves cannot be used; all that was found.
    #[error("{}", list(.0))]
    Inputs(Vec<String>),
    /// A file cannot be opened or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file of labelled arrays, a result above all, cannot be read or written.
    #[error(transparent)]
    Labelled(#[from] LabelledError),
    /// The user stopped the run.
    #[error(
        "interrupted: nothing was written, and an earlier result file is as it was. Run the same command to start again"
    )]
    Interrupted,
    /// The user stopped a computation that goes on where it stopped.
    #[error("interrupted: {done} of {total} {what} are kept in {}. Run the same command to go on from there", path.display())]
    Paused {
        /// What is counted, in the plural.
        what: &'static str,
        /// Finished, over all measures.
        done: u64,
        /// In all.
        total: u64,
        /// The file that keeps them.
        path: std::path::PathBuf,
    },
    /// The reader of the output went away, as `uplift … | head` does.
    #[error("the output was closed")]
    OutputClosed,
}

fn list(mistakes: &[String]) -> String {
    match mistakes {
        [one] => one.clone(),
        many => {
            let lines: Vec<String> = many.iter().map(|mistake| format!("  - {mistake}")).collect();
            format!("{} things to mend in the input data:\n{}", many.len(), lines.join("\n"))
        }
    }
}

impl UpliftError {
    /// One mistake in the input data.
    pub fn input(message: impl Into<String>) -> Self {
        Self::Inputs(vec![message.into()])
    }

    /// What the shell sees: 2 usage, 3 study file, 4 input data or disk, 5 interrupted.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::OutputClosed => 0,
            Self::Usage(_) => 2,
            Self::Study(_) => 3,
            Self::Inputs(_) | Self::File(_) | Self::Labelled(_) => 4,
            Self::Interrupted | Self::Paused { .. } => 5,
        }
    }
}

impl From<std::io::Error> for UpliftError {
    /// Only standard output is written through plain `io`; files have their own errors.
    fn from(error: std::io::Error) -> Self {
        if error.kind() == std::io::ErrorKind::BrokenPipe {
            Self::OutputClosed
        } else {
            Self::input(format!("standard output cannot be written: {error}"))
        }
    }
}
