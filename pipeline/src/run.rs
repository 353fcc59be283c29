//! A study carried out, of whichever kind: the frame that all kinds share.
//!
//! A kind has a folder of its own, [`uniform_risk`] or [`displacement`], with
//! the same files in it: `plan` (what it costs), `run` (from the inputs to the result file), `report` (what a run
//! tells).

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;
use uplift_atomic_file::remove_leftovers;
use uplift_study::AnyStudy;

use crate::checkpoint::FinishedRows;
use crate::error::UpliftError;
use crate::events::Events;
use crate::result::{ResultLock, check_target};
use crate::{displacement, uniform_risk};

/// With fewer records than this a spectrum changes with each of them (Section 4.5.1: 40 are a robust lower limit).
pub const FEW_RECORDS: usize = 40;
/// What is said of every result of synthetic records.
pub const SYNTHETIC: &str = "the records are synthetic: for results that matter bring real ones (records/README.md)";

/// What belongs to one run of a study and not to the study.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// The study file as it was given; kept in the result.
    pub study_file: PathBuf,
    /// The result file, in place of the study's `output.file`.
    pub output: Option<PathBuf>,
    /// What the caller typed or called; kept in the result.
    pub command: String,
}

impl RunOptions {
    /// Where the result goes.
    pub fn result_file<'a>(&'a self, study_output: &'a Path) -> &'a Path {
        self.output.as_deref().unwrap_or(study_output)
    }
}

/// What a run of any kind tells.
#[derive(Debug, Clone, Serialize)]
pub struct RunHead {
    /// `uplift`.
    pub program: &'static str,
    /// Its version.
    pub version: &'static str,
    /// The commit it was built from.
    pub commit: &'static str,
    /// The study file as it was given.
    pub study: String,
    /// Title of the study.
    pub title: String,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// What was written, the result file first.
    pub files: Vec<PathBuf>,
    /// What to know before using the numbers.
    pub warnings: Vec<String>,
    /// Wall time, s.
    pub seconds: f64,
}

/// What a run tells, by the kind of its study.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum RunReport {
    /// Of a study of uniform risk.
    UniformRisk(uniform_risk::RunReport),
    /// Of a study of displacement spectra.
    Displacement(displacement::RunReport),
}

impl RunReport {
    /// What both kinds tell.
    pub fn head(&self) -> &RunHead {
        match self {
            Self::UniformRisk(report) => &report.head,
            Self::Displacement(report) => &report.head,
        }
    }
}

/// Carries out a study: records and hazard are read and checked, everything that is not known from before is computed,
/// and the result file and its tables are written.
///
/// Finished rows of the analysis outlive whatever stops the run, in a checkpoint beside the result; an earlier result
/// stays until the new one is complete.
///
/// # Errors
/// Inputs that cannot be used; a result that cannot be written; [`UpliftError::Paused`] or [`UpliftError::Interrupted`]
/// where `events` say so.
pub fn run(study: &AnyStudy, options: &RunOptions, events: &dyn Events) -> Result<RunReport, UpliftError> {
    run_with(study, options, FinishedRows::default(), events)
}

/// As [`run`], with rows of the analysis that are `known` from elsewhere.
///
/// # Errors
/// As [`run`].
pub fn run_with(
    study: &AnyStudy,
    options: &RunOptions,
    known: FinishedRows,
    events: &dyn Events,
) -> Result<RunReport, UpliftError> {
    let start = Instant::now();
    let path = options.result_file(&study.output().file);
    // a place that cannot be written is found now, not after the analyses
    check_target(path)?;
    let _lock = ResultLock::acquire(path)?;
    remove_leftovers(path);
    for warning in study.warnings() {
        events.note(warning);
    }
    let place = Place { path, options, start };
    match study {
        AnyStudy::UniformRisk(study) => uniform_risk::run(study, &place, known, events).map(RunReport::UniformRisk),
        AnyStudy::Displacement(study) => displacement::run(study, &place, known, events).map(RunReport::Displacement),
    }
}

/// Where a run writes, and since when it runs.
pub(crate) struct Place<'a> {
    pub(crate) path: &'a Path,
    pub(crate) options: &'a RunOptions,
    pub(crate) start: Instant,
}
