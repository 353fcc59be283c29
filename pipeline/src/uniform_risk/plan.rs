//! What a study of uniform risk costs.

use std::path::Path;
use std::time::Duration;

use serde::Serialize;
use uplift_study::UniformRiskStudy;

use super::levels::{LevelCheck, check_levels};
use super::{plan_stripes, site_table, systems};
use crate::analysis::seconds;
use crate::error::UpliftError;
use crate::events::Events;
use crate::frame::PlanHead;
use crate::inputs::{RecordSet, SiteList, read_hazard, read_records};

/// Time spent on a measure to see how fast this machine is.
const CALIBRATION: Duration = Duration::from_secs(1);

/// What a study of uniform risk costs.
#[derive(Debug, Clone, Serialize)]
pub struct Plan {
    /// What every kind tells.
    #[serde(flatten)]
    pub head: PlanHead,
    /// How far down the levels of each measure reach, where sites say what the study is for.
    pub levels: Vec<LevelCheck>,
}

/// Reads and checks all inputs of `study`, and times some of its analyses.
pub(crate) fn plan(study: &UniformRiskStudy, study_file: &Path, events: &dyn Events) -> Result<Plan, UpliftError> {
    let (hazard, mut notes) = read_hazard(study)?;
    let site_list = site_table::read(study, events)?;
    notes.extend(site_list.iter().flat_map(|list| list.notes.iter().cloned()));
    let records = read_records(study)?;
    let systems = systems(study)?;
    notes.splice(0..0, study.warnings.iter().cloned());
    notes.extend(records.notes.iter().cloned());

    let plans = (study.measures.iter())
        .map(|measure| plan_stripes(study, measure, &records, &systems))
        .collect::<Result<Vec<_>, _>>()?;
    let mut levels = Vec::new();
    for (measure, hazard) in study.measures.iter().zip(&hazard) {
        levels.extend(check_levels(study, measure, (&records, &systems), hazard)?);
    }
    let seconds = seconds(&plans, CALIBRATION * u32::try_from(plans.len()).unwrap_or(u32::MAX));
    let Size { memory_bytes, disk_bytes } = Size::of(study, &records, site_list.as_ref());
    let head = PlanHead {
        study: study_file.to_owned(),
        record_set: records.description.clone(),
        synthetic: records.synthetic,
        analyses: plans.iter().map(uplift_ida::Plan::analyses).sum(),
        threads: rayon::current_num_threads(),
        seconds,
        memory_bytes,
        disk_bytes,
        output: study.output.file.clone(),
        notes,
    };
    Ok(Plan { head, levels })
}

/// What a run takes, in bytes.
struct Size {
    memory_bytes: u64,
    disk_bytes: u64,
}

impl Size {
    /// The stripes hold 12 bytes an analysis; the surface 8 bytes a threshold, in memory twice while it is put in
    /// order; records 48 bytes a sample with their integrals and extremes; a site of a table half a kilobyte, and as
    /// text 80 bytes an ordinate and 800 a fit.
    fn of(study: &UniformRiskStudy, set: &RecordSet, list: Option<&SiteList>) -> Self {
        let count = |n: usize| n as u64;
        let (records, strengths) = (count(set.records.len()), count(study.strengths.len()));
        let levels: u64 = study.measures.iter().map(|measure| count(measure.levels.len())).sum();
        let measures = count(study.measures.len());
        let sites = count(study.sites.len());
        let stripes = 12 * records * strengths * levels;
        let thresholds = if study.risk.maf_surface { count(study.risk.thresholds_m.len()) } else { 0 };
        let surface = 8 * measures * sites * strengths * thresholds;
        let spectra = 40 * measures * sites * strengths * count(study.risk.poe.len());
        let samples: u64 = set.records.iter().map(|record| count(record.accelerogram.len())).sum();
        let listed = list.map_or(0, |list| count(list.sites.len()));
        let exports = list.map_or(0, |list| count(list.exports.len()));
        let text = listed * exports * count(study.risk.poe.len()) * (80 * strengths + 800);
        let program = 30_000_000;
        Self {
            memory_bytes: program
                + stripes
                + surface
                + surface / measures.max(1)
                + spectra
                + 64 * samples
                + 500 * listed,
            disk_bytes: stripes + surface + spectra + text + 1_000_000,
        }
    }
}
