//! What all kinds of study share: the options of a run, and the heads of what plans and runs tell.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use crate::alarm::Alarm;
use crate::machine::Room;

/// What belongs to one run of a study and not to the study.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// The study file as it was given; kept in the result.
    pub study_file: PathBuf,
    /// The result file, in place of the study's `output.file`.
    pub output: Option<PathBuf>,
    /// What the caller typed or called; kept in the result.
    pub command: String,
    /// What was changed of the study file for this run, `records.first=20`; kept in the result.
    pub overrides: Vec<String>,
    /// Whether existing files are overwritten.
    pub force: bool,
    /// Whether the study is run although its result is there and whole.
    pub again: bool,
    /// Further results of which stripes are taken, where they are of the same motion, intensity, oscillator, strength
    /// and level.
    pub earlier: Vec<PathBuf>,
    /// Results of the slices of a table of sites, in order, of which the numbers of the sites are taken.
    pub slices: Vec<PathBuf>,
}

impl RunOptions {
    /// Where the result goes.
    pub fn result_file<'a>(&'a self, study_output: &'a Path) -> &'a Path {
        self.output.as_deref().unwrap_or(study_output)
    }
}

/// What a study of any kind costs.
#[derive(Debug, Clone, Serialize)]
pub struct PlanHead {
    /// The study file as it was given.
    pub study: PathBuf,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// Nonlinear time histories of the spectra.
    pub analyses: u64,
    /// Threads that would compute them.
    pub threads: usize,
    /// Wall time on these, s, extrapolated from a sample that was run.
    pub seconds: f64,
    /// Memory, bytes.
    pub memory_bytes: u64,
    /// Disk, bytes, at most.
    pub disk_bytes: u64,
    /// What there is of both, and whether the study fits.
    pub room: Room,
    /// The result file.
    pub output: PathBuf,
    /// What a run would raise, as far as it can be known before, the worst first.
    pub alarms: Vec<Alarm>,
    /// What else to know before running it.
    pub notes: Vec<String>,
    /// Why a run is refused, where it would replace the result of another.
    pub would_replace: Option<String>,
}

/// The report of a run of any kind.
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
    /// What to know before using the numbers, the worst first.
    pub alarms: Vec<Alarm>,
    /// Wall time, s.
    pub seconds: f64,
    /// Whether the result was there, whole and of this study, so that nothing was computed.
    pub done_already: bool,
}

/// Where a run writes, and since when it runs.
pub struct Place<'a> {
    /// The result file.
    pub path: &'a Path,
    /// The options of the run.
    pub options: &'a RunOptions,
    /// When the run began.
    pub start: Instant,
}
