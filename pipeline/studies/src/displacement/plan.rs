//! What a study of displacement spectra costs.

use std::path::Path;
use std::time::Duration;

use serde::Serialize;
use uplift_alarms::{ranked, study_alarms};
use uplift_engine::analysis::seconds;
use uplift_inputs::RecordSets;
use uplift_job::events::Events;
use uplift_job::machine::{Needs, PROGRAM_BYTES};
use uplift_job::study_run::PlanHead;
use uplift_spectra::{MotionSet, NUDGES};
use uplift_study::{DisplacementStudy, Kind};

use super::report::SetReport;
use super::spectra::with_free_vibration;
use super::{Inputs, design_analyses, printed};
use crate::error::StudiesError;

/// Time spent to see how fast this machine is.
const CALIBRATION: Duration = Duration::from_secs(2);

/// What a study of displacement spectra costs.
#[derive(Debug, Clone, Serialize)]
pub struct Plan {
    /// What every kind reports.
    #[serde(flatten)]
    pub head: PlanHead,
    /// `displacement spectra`.
    pub kind: &'static str,
    /// The record sets.
    pub sets: Vec<SetReport>,
    /// Nonlinear time histories that show what rounding does to the printed ordinates.
    pub rounding_analyses: u64,
    /// Nonlinear time histories of the design examples, at most.
    pub design_analyses: u64,
    /// Whether there are any.
    #[serde(skip)]
    pub has_design: bool,
}

/// Reads and checks all inputs of `study`, and times some of its analyses.
///
/// # Errors
/// Inputs that cannot be used.
pub fn plan(study: &DisplacementStudy, study_file: &Path, events: &dyn Events) -> Result<Plan, StudiesError> {
    let inputs = Inputs::read(study, events)?;
    let records = &inputs.records;
    let sets = records.motions(study.gravity_m_s2)?;

    let ways = study.scaling.ways().0;
    let plans = (sets.iter())
        .map(|set| set.plan(&ways, &inputs.structures, with_free_vibration(study)))
        .collect::<Result<Vec<_>, _>>()?;
    let of_spectra: u64 = plans.iter().map(uplift_ida::Plan::analyses).sum();
    let of_rounding = of_spectra / inputs.structures.len() as u64 * (inputs.printed.len() * NUDGES) as u64;
    let of_design: u64 =
        study.design.iter().flat_map(|plan| sets.iter().map(|set| design_analyses(study, plan, set))).sum();
    // design examples are carried out one way of scaling at a time, and so lack what the ways share
    let alone = (sets.iter())
        .map(|set| set.plan(&ways[..1], &inputs.structures, with_free_vibration(study)))
        .collect::<Result<Vec<_>, _>>()?;
    let of_one_way: u64 = alone.iter().map(uplift_ida::Plan::analyses).sum();
    let designs =
        if of_design == 0 { 0.0 } else { seconds(&alone, CALIBRATION / 2) * of_design as f64 / of_one_way as f64 };
    let of_all = (of_spectra + of_rounding) as f64 / of_spectra as f64;
    let seconds = seconds(&plans, CALIBRATION) * of_all + designs;
    let needs = needs(study, records, &sets);
    let reports = records.sets.iter().zip(&sets).map(|(set, motions)| SetReport::from_motions(set, motions)).collect();
    let head = PlanHead {
        study: study_file.to_owned(),
        record_set: records.description.clone(),
        synthetic: records.synthetic,
        analyses: of_spectra,
        threads: rayon::current_num_threads(),
        seconds,
        memory_bytes: needs.memory_bytes,
        disk_bytes: needs.disk_bytes,
        room: needs.room(&study.output.file),
        output: study.output.file.clone(),
        alarms: ranked(study_alarms(&study.warnings, records.synthetic).collect()),
        notes: records.notes.clone(),
        would_replace: None,
    };
    Ok(Plan {
        head,
        kind: Kind::Displacement.key(),
        sets: reports,
        rounding_analyses: of_rounding,
        design_analyses: of_design,
        has_design: study.design.is_some(),
    })
}

/// What a run of `study` takes.
///
/// A displacement is held twice while its set is being computed, and once later, again when its file is written, and
/// lies in a checkpoint with its impacts; records take 48 bytes a sample with their integrals and extremes; a row of
/// the table 100 bytes.
pub fn needs(study: &DisplacementStudy, records: &RecordSets, sets: &[MotionSet<'_>]) -> Needs {
    let structures = (study.structures.lines() * study.structures.abscissa().len()) as u64;
    let ways = (study.scaling.to.len() * study.scaling.by.len()) as u64;
    let held = |set: &MotionSet<'_>| 8 * structures * ways * set.motions().len() as u64;
    let displacements: u64 = sets.iter().map(held).sum();
    let largest = sets.iter().map(held).max().unwrap_or_default();
    let spectra = 8 * structures * ways * (study.percentiles.len() as u64 + 1) * sets.len() as u64;
    let samples: u64 = records.records.iter().map(|record| (record.pair.h1.len() + record.pair.h2.len()) as u64).sum();
    let printed = (study.structures.lines() * printed(study.structures.abscissa()).len()) as u64;
    let repeated = displacements / structures * printed * NUDGES as u64;
    let table = if study.output.csv { 100 * structures * ways * sets.len() as u64 } else { 0 };
    let checkpoint = 12 * (displacements + repeated) / 8;
    Needs {
        memory_bytes: PROGRAM_BYTES + displacements + 2 * largest.max(repeated) + 3 * spectra + 64 * samples,
        disk_bytes: checkpoint + displacements + spectra + table + 1_000_000,
        disk_least_bytes: checkpoint,
    }
}
