//! What can go wrong in a job, and how it is said.

use std::path::PathBuf;

use thiserror::Error;

use uplift_block::BlockError;
use uplift_hazard::HazardError;
use uplift_labelled::LabelledError;
use uplift_motion::MotionError;
use uplift_oscillator::OscillatorError;
use uplift_study::StudyError;

/// Why a job did not do what it was asked.
#[derive(Debug, Error)]
pub enum UpliftError {
    /// The study file has mistakes.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// What a job is asked for does not fit together.
    #[error("{0}")]
    Usage(String),
    /// Records or hazard curves cannot be used; all that was found.
    #[error("{}", list(" in the input data", .0))]
    Inputs(Vec<String>),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] LabelledError),
    /// A record cannot be read or used, or no synthetic one can be made as asked.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A hazard curve cannot be read or used.
    #[error(transparent)]
    Hazard(#[from] HazardError),
    /// An oscillator or its excitation that cannot be.
    #[error(transparent)]
    Oscillator(#[from] OscillatorError),
    /// Blocks or pulses that cannot be; all that was found.
    #[error("{}", list("", .0))]
    Blocks(Vec<BlockError>),
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
        path: PathBuf,
    },
}

fn list(place: &str, mistakes: &[impl ToString]) -> String {
    match mistakes {
        [one] => one.to_string(),
        many => {
            let lines: Vec<String> = many.iter().map(|mistake| format!("  - {}", mistake.to_string())).collect();
            format!("{} things to mend{place}:\n{}", many.len(), lines.join("\n"))
        }
    }
}

impl UpliftError {
    /// One mistake in the input data.
    pub fn input(message: impl Into<String>) -> Self {
        Self::Inputs(vec![message.into()])
    }
}
