//! What a study of uniform risk costs.

use std::collections::BTreeSet;
use std::error::Error;
use std::path::Path;
use std::time::Duration;

use serde::Serialize;
use uplift_alarms::{
    BELOW_FIRST_LEVEL, BEYOND_LAST_LEVEL, CurvesAtSite, far_factors_alarm, few, few_earthquakes, hazard_alarms,
    noticed_alarm, ranked, study_alarms,
};
use uplift_engine::analysis::seconds;
use uplift_inputs::{
    OtherHazard, Record, RecordSet, SiteHazard, SiteList, read_hazard, read_other_hazard, read_records,
};
use uplift_job::alarm::{Alarm, Severity};
use uplift_job::events::Events;
use uplift_job::machine::{Needs, PROGRAM_BYTES};
use uplift_job::study_run::PlanHead;
use uplift_job::{JobError, cause};
use uplift_study::{ExportFiles, MeasurePlan, Repair, UniformRiskStudy};
use uplift_uniform_risk::consistency::{Answer, ConsistencyReport};
use uplift_uniform_risk::{plan_own_stripes, systems, systems_under};

use super::levels::{LevelCheck, LevelEnds, check_levels};
use super::site_table;
use crate::error::StudiesError;

/// Time spent on a measure to see how fast this machine is.
const CALIBRATION: Duration = Duration::from_secs(1);

/// Time of a core for an ordinate of a table of sites, read, computed and written, s.
const ORDINATE_S: f64 = 8.5e-6;
/// The same for a run that the band of a table's ordinates goes through, s.
const RUN_OF_BAND_S: f64 = 25e-9;

/// What a study of uniform risk costs.
#[derive(Debug, Clone, Serialize)]
pub struct Plan {
    /// What every kind reports.
    #[serde(flatten)]
    pub head: PlanHead,
    /// How far down and up the levels of each measure reach, where sites say what the study is for.
    pub levels: Vec<LevelCheck>,
    /// Whether the records bring the hazard of the other measure.
    pub consistency: ConsistencyReport,
}

/// Reads and checks all inputs of `study`, and times some of its analyses.
///
/// # Errors
/// Inputs that cannot be used.
pub fn plan(study: &UniformRiskStudy, study_file: &Path, events: &dyn Events) -> Result<Plan, StudiesError> {
    let (hazard, mut notes) = hazard_of(study, events)?;
    let (other_hazard, other_notes) = read_other_hazard(study)?;
    notes.extend(other_notes);
    let site_list = site_table::read(study, events)?;
    notes.extend(site_list.iter().flat_map(|list| list.notes.iter().cloned()));
    let records = read_records(study, events)?;
    let own_systems = systems_under(study, &records)?;
    notes.extend(records.notes.iter().cloned());

    let plans = (study.measures.iter())
        .map(|measure| plan_own_stripes(study, measure, &records, &own_systems))
        .collect::<Result<Vec<_>, _>>()?;
    let (motions, systems) = (records.clone().without_structures(), systems(study)?);
    let (mut levels, mut of_ends) = (Vec::new(), LevelEnds::default());
    for (measure, hazard) in study.measures.iter().zip(&hazard) {
        let (tried, cases) = check_levels(study, measure, (&motions, &systems), hazard)?;
        levels.extend(tried);
        of_ends.lower.extend(cases.lower);
        of_ends.upper.extend(cases.upper);
    }
    let seconds = seconds(&plans, CALIBRATION * u32::try_from(plans.len()).unwrap_or(u32::MAX));
    let needs = needs(study, &records, site_list.as_ref());
    let ends = [(BEYOND_LAST_LEVEL, of_ends.upper), (BELOW_FIRST_LEVEL, of_ends.lower)];
    let of_ends = ends.into_iter().filter_map(|(kind, cases)| Alarm::from_cases(kind, cases));
    let is_repaired = study.consistency.repair == Repair::Weights;
    let answer = Answer::from_plan(study, &records, (&hazard, &other_hazard), is_repaired)?;
    let (of_earthquakes, consistency) = (few_earthquakes(answer.question()), answer.report(&[]));
    let curve_alarms = curve_alarms(study, (&hazard, &other_hazard), &consistency);
    let (doubted, notes): (Vec<Alarm>, Vec<Alarm>) =
        notes.iter().map(|line| noticed_alarm(line)).partition(|alarm| alarm.severity == Severity::Mistake);
    let head = PlanHead {
        study: study_file.to_owned(),
        record_set: records.description.clone(),
        synthetic: records.synthetic,
        analyses: plans.iter().map(uplift_ida::Plan::analyses).sum(),
        threads: rayon::current_num_threads(),
        seconds: seconds + seconds_of_sites(study, &records, site_list.as_ref()),
        memory_bytes: needs.memory_bytes,
        disk_bytes: needs.disk_bytes,
        room: needs.room(&study.output.file),
        output: study.output.file.clone(),
        alarms: ranked(
            input_alarms(study, &records)
                .chain(of_earthquakes)
                .chain(curve_alarms)
                .chain(of_ends)
                .chain(doubted)
                .collect(),
        ),
        notes: notes.into_iter().map(|alarm| alarm.what).collect(),
        would_replace: None,
    };
    Ok(Plan { head, levels, consistency })
}

/// About how long the table of sites takes after the analyses, s.
fn seconds_of_sites(study: &UniformRiskStudy, set: &RecordSet, list: Option<&SiteList>) -> f64 {
    let (Some(list), Some(table)) = (list, &study.site_table) else { return 0.0 };
    let (strengths, poes) = (study.strengths.len() as f64, study.risk.poe.len() as f64);
    let written = table.strengths.as_ref().map_or(strengths, |own| own.len() as f64);
    let of_export = |export: &ExportFiles| {
        let of_measure = |plan: &&MeasurePlan| plan.measure == export.measure;
        let levels = study.measures.iter().find(of_measure).map_or(0, |plan| plan.levels.len());
        let runs = if table.bands { (set.records.len() * levels) as f64 } else { 0.0 };
        let curves = 1.0 + export.branches.len() as f64;
        curves * strengths * poes * ORDINATE_S + written * runs * RUN_OF_BAND_S
    };
    let of_site: f64 = table.exports.iter().map(of_export).sum();
    list.range.len() as f64 * of_site / rayon::current_num_threads() as f64
}

/// The alarms of the study and its records.
fn input_alarms(study: &UniformRiskStudy, set: &RecordSet) -> impl Iterator<Item = Alarm> {
    let of_records = if let Some(at_level) = &set.at_level {
        let first = study.measures.first();
        first.and_then(|plan| at_level.far_factors(&set.records, plan)).map(far_factors_alarm)
    } else {
        let pairs: BTreeSet<&str> = set.records.iter().map(|record| study.pair_of_record(&record.id)).collect();
        few(set.records.len(), pairs.len())
    };
    study_alarms(&study.warnings, set.synthetic).chain(of_records)
}

/// Curves that are probably mistaken: by themselves, among each other, or by what the records bring.
fn curve_alarms(
    study: &UniformRiskStudy,
    (hazard, other_hazard): (&[Vec<SiteHazard>], &[OtherHazard]),
    consistency: &ConsistencyReport,
) -> Vec<Alarm> {
    let analysed = hazard.iter().flatten().map(|site| CurvesAtSite {
        site: &site.site,
        measure: site.measure,
        curve: &site.curve.curve,
        branches: site.branches.iter().map(|branch| (branch.name.as_str(), &branch.input.curve)).collect(),
    });
    let compared = other_hazard.iter().map(|other| CurvesAtSite {
        site: &other.site,
        measure: other.measure,
        curve: &other.curve,
        branches: Vec::new(),
    });
    let curves: Vec<CurvesAtSite<'_>> = analysed.chain(compared).collect();
    let mut alarms = hazard_alarms(study, &curves);
    alarms.extend(uplift_alarms::curves_alarm(study, consistency));
    alarms
}

/// Says which curves are probably mistaken, before hours are spent on them.
pub(super) fn tell_mistaken_curves(
    study: &UniformRiskStudy,
    records: &RecordSet,
    (hazard, other_hazard): (&[Vec<SiteHazard>], &[OtherHazard]),
    events: &dyn Events,
) -> Result<(), StudiesError> {
    let consistency = Answer::from_plan(study, records, (hazard, other_hazard), false)?.report(&[]);
    for alarm in curve_alarms(study, (hazard, other_hazard), &consistency) {
        events.note(&format!("{} {alarm}: {}", alarm.severity.word(), alarm.what_to_do));
    }
    Ok(())
}

/// The hazard of a study. Where it cannot be read, mistakes of the records are reported with it, all at once.
///
/// # Errors
/// Hazard curves that cannot be used; an interruption while the records are read.
pub(super) fn hazard_of(
    study: &UniformRiskStudy,
    events: &dyn Events,
) -> Result<(Vec<Vec<SiteHazard>>, Vec<String>), StudiesError> {
    read_hazard(study).map_err(|hazard| {
        let mistakes = |error: &(dyn Error + 'static)| match cause(error) {
            Some(JobError::Inputs(mistakes)) => mistakes.clone(),
            _ => Vec::new(),
        };
        let of_hazard = mistakes(&hazard);
        let of_records = read_records(study, events).err().map(|error| mistakes(&error)).unwrap_or_default();
        if events.cancelled() {
            return JobError::Interrupted.into();
        }
        if of_hazard.is_empty() || of_records.is_empty() {
            return hazard.into();
        }
        JobError::Inputs([of_hazard, of_records].concat()).into()
    })
}

/// What a run of `study` takes.
///
/// The stripes hold 12 bytes an analysis, once more in a checkpoint and once more for a list of sites; the surface 8
/// bytes a threshold, in memory twice while it is put in order; records 48 bytes a sample with their integrals and
/// extremes; a site of a table half a kilobyte, and in its files 100 bytes an ordinate and 900 a fit.
pub fn needs(study: &UniformRiskStudy, set: &RecordSet, list: Option<&SiteList>) -> Needs {
    let count = |n: usize| n as u64;
    let product = |factors: &[u64]| factors.iter().fold(1_u64, |product, factor| product.saturating_mul(*factor));
    let sum = |terms: &[u64]| terms.iter().fold(0_u64, |sum, term| sum.saturating_add(*term));
    let (records, strengths) = (count(set.records.len()), count(study.strengths.len()));
    let all_levels = study.measures.iter().map(|plan| count(plan.levels.len())).sum();
    let (measures, sites) = (count(study.measures.len()), count(study.sites.len()));
    let stripes = product(&[12, records, strengths, all_levels]);
    let thresholds = if study.risk.maf_surface { count(study.risk.thresholds_m.len()) } else { 0 };
    let surface = product(&[8, measures, sites, strengths, thresholds]);
    let spectra = product(&[40, measures, sites, strengths, count(study.risk.poe.len())]);
    let samples = |record: &Record| -> u64 {
        std::iter::once(&record.accelerogram).chain(&record.other_azimuths).map(|motion| count(motion.len())).sum()
    };
    // structures of a motion share its samples
    let is_first = |record: &&Record| record.structure.as_ref().is_none_or(|structure| structure.number == 1);
    let samples: u64 = set.records.iter().filter(is_first).map(samples).sum();
    let listed = list.map_or(0, |list| count(list.sites.len()));
    let exports = list.map_or(&[][..], |list| &list.exports[..]);
    let is_listed = |plan: &&MeasurePlan| exports.iter().any(|export| export.measure == plan.measure);
    let listed_levels = study.measures.iter().filter(is_listed).map(|plan| count(plan.levels.len())).sum();
    let demands = product(&[12, records, strengths, listed_levels]);
    let written = list.map_or(0, |list| count(list.range.len()));
    let text = product(&[written, count(exports.len()), count(study.risk.poe.len()), 100 * strengths + 900]);
    Needs {
        memory_bytes: sum(&[
            PROGRAM_BYTES,
            stripes,
            surface,
            surface / measures.max(1),
            spectra,
            demands,
            product(&[64, samples]),
            500 * listed,
        ]),
        disk_bytes: sum(&[2 * stripes.min(u64::MAX / 2), surface, spectra, text, 1_000_000]),
        disk_least_bytes: stripes,
    }
}
