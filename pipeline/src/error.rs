//! What can go wrong in a job, and how it is said.

use std::path::{Path, PathBuf};

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_block::BlockError;
use uplift_bootstrap::BootstrapError;
use uplift_consistency::ConsistencyError;
use uplift_fragility::FragilityError;
use uplift_frame::FrameError;
use uplift_hazard::HazardError;
use uplift_ida::IdaError;
use uplift_labelled::LabelledError;
use uplift_motion::MotionError;
use uplift_oscillator::OscillatorError;
use uplift_plausible::Implausible;
use uplift_risk::RiskError;
use uplift_spectra::SpectraError;
use uplift_statics::StaticsError;
use uplift_structure::StructureError;
use uplift_study::StudyError;
use uplift_uncertainty::UncertaintyError;

use crate::text::one_line;

use crate::checkpoint::CheckpointError;

/// Why a job did not do what it was asked.
#[derive(Debug, Error)]
pub enum UpliftError {
    /// The study file has mistakes.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// A study that TOML cannot hold; one that was loaded is none.
    #[error(transparent)]
    StudyToml(#[from] toml::ser::Error),
    /// What a job is asked for does not fit together.
    #[error("{0}")]
    Usage(String),
    /// A choice among what a result has, that it does not have or that was not made.
    #[error("{}: the result has {}", choice(option, wanted.as_deref()), known.join(", "))]
    Choice {
        /// What is chosen, as the command line calls it: `--site`.
        option: &'static str,
        /// The choice made; none where there is none, and there are several.
        wanted: Option<String>,
        /// What the result has.
        known: Vec<String>,
    },
    /// Records or hazard curves cannot be used; all that was found.
    #[error("{}", list(" in the input data", .0))]
    Inputs(Vec<String>),
    /// Numbers that no system, record or person means; all that was found.
    #[error("{}", list("", .0))]
    Implausible(Vec<Implausible>),
    /// A job cannot fit on this machine; why.
    #[error(
        "{}\n(what is needed is estimated: UPLIFT_LIMITS=warn in the environment goes on nonetheless)",
        list(" before it fits on this machine", .0)
    )]
    Room(Vec<String>),
    /// A file cannot be opened or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file of labelled arrays, a result above all, cannot be read or written.
    #[error(transparent)]
    Labelled(#[from] LabelledError),
    /// One of the files that a job reads is at fault.
    #[error("{}: {source}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: Box<UpliftError>,
    },
    /// A structure that cannot be, or to which a rule does not apply.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// Columns, a restrainer or a protocol that cannot be, or a displacement beyond their reach.
    #[error(transparent)]
    Statics(#[from] StaticsError),
    /// An analysis that cannot be planned or finished; one that was told to stop is [`Interrupted`](Self::Interrupted).
    #[error(transparent)]
    Analysis(Box<IdaError>),
    /// Demands of which no fragility can be made.
    #[error(transparent)]
    Fragility(#[from] FragilityError),
    /// Demands and hazard that do not fit together.
    #[error(transparent)]
    Risk(#[from] RiskError),
    /// Records and hazard that cannot be held against each other.
    #[error(transparent)]
    Consistency(Box<ConsistencyError>),
    /// Resamples that cannot be drawn.
    #[error(transparent)]
    Bootstrap(#[from] BootstrapError),
    /// Structures that cannot be drawn.
    #[error(transparent)]
    Uncertainty(#[from] UncertaintyError),
    /// A displacement spectrum that cannot be computed; one that was told to stop is
    /// [`Interrupted`](Self::Interrupted).
    #[error(transparent)]
    Spectra(Box<SpectraError>),
    /// A record cannot be read or used, or no synthetic one can be made as asked.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A hazard curve cannot be read or used.
    #[error(transparent)]
    Hazard(#[from] HazardError),
    /// A frame that cannot be shaken so.
    #[error(transparent)]
    Frame(#[from] FrameError),
    /// An oscillator or its excitation that cannot be.
    #[error(transparent)]
    Oscillator(#[from] OscillatorError),
    /// Blocks or pulses that cannot be; all that was found.
    #[error("{}", list("", .0))]
    Blocks(Vec<BlockError>),
    /// A file of finished analysis rows cannot be used.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// The user stopped the run.
    #[error(
        "interrupted: nothing was written, and an earlier result file is as it was. Run the same command to start again"
    )]
    Interrupted,
    /// The user stopped a computation that goes on where it stopped.
    #[error(
        "interrupted: {done} of {total} {what} are in the checkpoint {}. Run the same command to go on from there",
        path.display()
    )]
    Paused {
        /// What is counted, in the plural.
        what: &'static str,
        /// Finished, over all measures.
        done: u64,
        /// In all.
        total: u64,
        /// The checkpoint that holds them.
        path: PathBuf,
    },
}

/// An option, with the value given to it.
fn choice(option: &str, wanted: Option<&str>) -> String {
    wanted.map_or_else(|| option.to_owned(), |wanted| format!("{option} {wanted}"))
}

fn list(place: &str, mistakes: &[impl ToString]) -> String {
    match mistakes {
        [one] => one_line(&one.to_string()).into_owned(),
        many => {
            let lines: Vec<String> =
                many.iter().map(|mistake| format!("  - {}", one_line(&mistake.to_string()))).collect();
            format!("{} things to mend{place}:\n{}", many.len(), lines.join("\n"))
        }
    }
}

impl UpliftError {
    /// One mistake in the input data.
    pub fn input(message: impl Into<String>) -> Self {
        Self::Inputs(vec![message.into()])
    }

    /// The same, said of the file at `path`; one that was stopped was not stopped by the file.
    #[must_use]
    pub fn in_file(self, path: &Path) -> Self {
        match self {
            Self::Interrupted | Self::Paused { .. } => self,
            source => Self::InFile { path: path.to_owned(), source: Box::new(source) },
        }
    }
}

impl From<IdaError> for UpliftError {
    fn from(error: IdaError) -> Self {
        match error {
            IdaError::Cancelled => Self::Interrupted,
            other => Self::Analysis(Box::new(other)),
        }
    }
}

impl From<BlockError> for UpliftError {
    fn from(error: BlockError) -> Self {
        Self::Blocks(vec![error])
    }
}

impl From<ConsistencyError> for UpliftError {
    fn from(error: ConsistencyError) -> Self {
        match error {
            ConsistencyError::Risk(error) => error.into(),
            other => Self::Consistency(Box::new(other)),
        }
    }
}

impl From<SpectraError> for UpliftError {
    fn from(error: SpectraError) -> Self {
        match error {
            SpectraError::Analysis(error) => error.into(),
            other => Self::Spectra(Box::new(other)),
        }
    }
}
