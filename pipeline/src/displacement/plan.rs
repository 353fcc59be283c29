//! What a study of displacement spectra costs.

use std::path::Path;
use std::time::Duration;

use serde::Serialize;
use uplift_spectra::MotionSet;
use uplift_study::{DisplacementStudy, Kind};

use super::report::SetReport;
use super::spectra::with_free_vibration;
use super::{Inputs, design_analyses};
use crate::analysis::seconds;
use crate::error::UpliftError;
use crate::frame::PlanHead;
use crate::inputs::RecordSets;

/// Time spent to see how fast this machine is.
const CALIBRATION: Duration = Duration::from_secs(2);

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
    let inputs = Inputs::read(study)?;
    let records = &inputs.records;
    let sets = records.motions(study.gravity_m_s2)?;
    let notes = study.warnings.iter().chain(&records.notes).cloned().collect();

    let ways = study.scaling.ways().0;
    let plans = (sets.iter())
        .map(|set| set.plan(&ways, &inputs.structures, with_free_vibration(study)))
        .collect::<Result<Vec<_>, _>>()?;
    let of_spectra: u64 = plans.iter().map(uplift_ida::Plan::analyses).sum();
    let of_design: u64 =
        study.design.iter().flat_map(|plan| sets.iter().map(|set| design_analyses(study, plan, set))).sum();
    // an analysis of a design example costs about as much as one of the spectra
    let seconds = seconds(&plans, CALIBRATION) * (of_spectra + of_design) as f64 / of_spectra as f64;
    let Size { memory_bytes, disk_bytes } = Size::of(study, records, &sets);
    let reports = records.sets.iter().zip(&sets).map(|(set, motions)| SetReport::of(set, motions)).collect();
    let head = PlanHead {
        study: study_file.to_owned(),
        record_set: records.description.clone(),
        synthetic: records.synthetic,
        analyses: of_spectra,
        threads: rayon::current_num_threads(),
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

/// What a run takes, in bytes.
struct Size {
    memory_bytes: u64,
    disk_bytes: u64,
}

impl Size {
    /// A displacement is held twice while its set is being computed, and once later, again when its file is written;
    /// records take 48 bytes a sample with their integrals and extremes; a row of the table 100 bytes.
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
