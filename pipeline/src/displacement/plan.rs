//! What a study of displacement spectra costs.

use std::path::Path;
use std::time::{Duration, Instant};

use serde::Serialize;
use uplift_ida::Unwatched;
use uplift_spectra::{MotionSet, System};
use uplift_study::{DisplacementStudy, Kind};

use super::report::SetReport;
use super::{analyses, design_analyses, shake, structures};
use crate::error::UpliftError;
use crate::inputs::{RecordSets, read_record_sets};
use crate::plan::PlanHead;
use crate::result::check_target;

/// Time spent to see how fast this machine is.
const CALIBRATION: Duration = Duration::from_secs(2);
/// Structures timed at a time.
const AT_A_TIME: usize = 4;

/// What a study of displacement spectra costs.
#[derive(Debug, Clone, Serialize)]
pub struct Plan {
    /// What every kind tells.
    #[serde(flatten)]
    pub head: PlanHead,
    /// `displacement spectra`.
    pub kind: &'static str,
    /// The record sets.
    pub sets: Vec<SetReport>,
    /// Nonlinear time histories of the design examples, at most.
    pub design_analyses: u64,
    /// Whether there are any.
    #[serde(skip)]
    pub has_design: bool,
}

/// Reads and checks all inputs of `study`, and times some of its analyses.
pub(crate) fn plan(study: &DisplacementStudy, study_file: &Path) -> Result<Plan, UpliftError> {
    check_target(&study.output.file)?;
    let records = read_record_sets(study)?;
    let sets = records.motions(study.gravity_m_s2)?;
    let structures = structures(study)?;
    let notes = study.warnings.iter().chain(&records.notes).cloned().collect();

    let of_spectra: u64 = sets.iter().map(|set| analyses(study, set)).sum();
    let of_design: u64 =
        study.design.iter().flat_map(|plan| sets.iter().map(|set| design_analyses(study, plan, set))).sum();
    let threads = rayon::current_num_threads();
    let seconds = (of_spectra + of_design) as f64 * seconds_per_analysis(study, &structures, &sets)?;
    let Size { memory_bytes, disk_bytes } = Size::of(study, &records, &sets);
    let reports = records.sets.iter().zip(&sets).map(|(set, motions)| SetReport::of(set, motions)).collect();
    let head = PlanHead {
        study: study_file.to_owned(),
        record_set: records.description.clone(),
        synthetic: records.synthetic,
        analyses: of_spectra,
        threads,
        seconds,
        memory_bytes,
        disk_bytes,
        output: study.output.file.clone(),
        notes,
    };
    Ok(Plan {
        head,
        kind: Kind::Displacement.key(),
        sets: reports,
        design_analyses: of_design,
        has_design: study.design.is_some(),
    })
}

/// Wall time of an analysis on all threads: some structures, spread over all, under every motion of every set in turn.
fn seconds_per_analysis(
    study: &DisplacementStudy,
    structures: &[System],
    sets: &[MotionSet<'_>],
) -> Result<f64, UpliftError> {
    let begin = Instant::now();
    let (mut timed, mut visited) = (0, 0);
    while visited == 0 || begin.elapsed() < CALIBRATION {
        let some: Vec<System> = (visited..visited + AT_A_TIME).map(|visit| spread(structures, visit).clone()).collect();
        for set in sets {
            timed += shake(study, &some, set, &Unwatched)?.all_m().len();
        }
        visited += AT_A_TIME;
    }
    Ok(begin.elapsed().as_secs_f64() / timed.max(1) as f64)
}

/// The structure that is visited at this turn: in steps of the golden ratio, which leave no region out.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a fraction of a count")]
fn spread(structures: &[System], visit: usize) -> &System {
    let golden = 0.618_033_988_749_894_9;
    &structures[(((visit as f64 + 0.5) * golden).fract() * structures.len() as f64) as usize]
}

/// What a run takes, in bytes.
struct Size {
    memory_bytes: u64,
    disk_bytes: u64,
}

impl Size {
    /// A displacement is held twice while its set is being computed, and once later, again when its file is written; records take 48
    /// bytes a sample with their integrals and extremes; a row of the table 100 bytes.
    fn of(study: &DisplacementStudy, records: &RecordSets, sets: &[MotionSet<'_>]) -> Self {
        let structures = (study.structures.lines() * study.structures.abscissa().len()) as u64;
        let ways = (study.scaling.to.len() * study.scaling.by.len()) as u64;
        let held = |set: &MotionSet<'_>| 8 * structures * ways * set.motions().len() as u64;
        let displacements: u64 = sets.iter().map(held).sum();
        let largest = sets.iter().map(held).max().unwrap_or_default();
        let spectra = 8 * structures * ways * (study.percentiles.len() as u64 + 1) * sets.len() as u64;
        let samples: u64 =
            records.records.iter().map(|record| (record.pair.h1.len() + record.pair.h2.len()) as u64).sum();
        let table = if study.output.csv { 100 * structures * ways * sets.len() as u64 } else { 0 };
        Self {
            memory_bytes: 30_000_000 + displacements + 2 * largest + 3 * spectra + 64 * samples,
            disk_bytes: displacements + spectra + table + 1_000_000,
        }
    }
}
