//! Efficiency and sufficiency of the measures of a result.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use clap::Args;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_motion::{IntensityMeasure, Period};
use uplift_result::{LockedResult, ResultFile};
use uplift_uniform_risk::{StoredStripes, StudyOfResult};

use super::factors_to_reach::FactorsToReach;
use super::measure_efficiency::{covariates, efficiency_by, efficiency_restated};
use super::report::EfficiencyReport;
use super::restated::{Measured, restated};
use super::write::{efficiency_path, write_efficiency};
use crate::error::QuestionsError;

/// Which measures are compared, and how the answer is written.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub struct EfficiencyOptions {
    /// Measure to compare; repeat for several [default: ten usual ones]
    #[arg(long = "measure", value_name = "MEASURE")]
    pub measures: Vec<IntensityMeasure>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

/// The measures that researchers of rocking compare, ten with PGV and PGA.
fn usual_measures() -> Vec<IntensityMeasure> {
    let period = |period_s| Period::from_s(period_s).into_iter();
    let ordinates = [0.5, 1.0, 2.0].into_iter().flat_map(period).map(IntensityMeasure::Sa);
    let average = period(0.2).zip(period(2.0)).map(|(from, to)| IntensityMeasure::AvgSa { from, to });
    let others =
        [IntensityMeasure::Pgd, IntensityMeasure::Cav, IntensityMeasure::Arias, IntensityMeasure::SpectrumIntensity];
    IntensityMeasure::OF_CHAPTER_4.into_iter().chain(ordinates).chain(average).chain(others).collect()
}

/// How well each intensity measure of the result at `result` predicts the demand (efficiency), and what it leaves out
/// (sufficiency): written into the file and into a table beside it. Measures that the records were not scaled to are
/// told of the stripes of the first one; where the records cannot be read again, only those that the result knows.
///
/// # Errors
/// A file that is missing, damaged, no result, or without sites; a file that cannot be written;
/// [`JobError::Interrupted`] where `events` say so.
pub fn efficiency(
    result: &Path,
    options: &EfficiencyOptions,
    events: &dyn Events,
) -> Result<EfficiencyReport, QuestionsError> {
    let (locked, file) = LockedResult::open(result, events)?;
    file.refuse_records_at_level("measures are ranked by records scaled through all levels")?;
    if file.stored_study()?.structures_of_a_motion() > 1 {
        return Err(JobError::input(format!(
            "{}: its oscillators are uncertain ([uncertainty]), but measures are ranked for one structure: use a \
             study without it",
            file.path().display()
        ))
        .into());
    }
    let stored = StoredStripes::read(&file)?;
    let table = Output::new(efficiency_path(&stored.path), OutputKind::Table("dispersion_rocking"));
    outputs::check(&[table], &[result], options.force)?;
    let covariates = covariates(&file.records()?);
    let mut measures = Vec::new();
    for measure in &stored.measures {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        measures.push(efficiency_by(&stored, measure, &covariates)?);
    }
    let asked = if options.measures.is_empty() { usual_measures() } else { options.measures.clone() };
    let mut up_to_m = vec![None; stored.strengths.len()];
    if let Some(own) = stored.measures.first() {
        let studied: BTreeSet<IntensityMeasure> = stored.measures.iter().map(|own| own.measure).collect();
        for measure in asked.iter().filter(|measure| !measure.can_be_scaled_to()) {
            events.note(&format!(
                "{measure} is not ranked: no factor changes it; durations are among what the residuals are held against"
            ));
        }
        let wanted = asked.iter().copied().filter(|measure| measure.can_be_scaled_to());
        let wanted: BTreeSet<IntensityMeasure> = wanted.chain(studied.iter().copied()).collect();
        let known = intensities(&file, &wanted, events)?;
        let measured = |measure| Some(Measured { measure, of_records: known.get(&measure)? });
        for measure in wanted.difference(&studied).copied() {
            if events.cancelled() {
                return Err(JobError::Interrupted.into());
            }
            let Some((from, to)) = measured(own.measure).zip(measured(measure)) else { continue };
            match restated(&stored, own, (from, to))? {
                Some(restated) => measures.push(efficiency_restated(&stored, own, &restated, &covariates)?),
                None => events.note(&format!(
                    "{measure} is left out: the records reach no two common levels of it at the levels of {}",
                    own.measure
                )),
            }
        }
        if let Some(from) = measured(own.measure) {
            let reaching = FactorsToReach::new(&stored, own, from)?;
            for found in &mut measures {
                if let Some(to) = measured(found.own.measure) {
                    found.own.reaching = reaching.scatter(to);
                }
            }
            up_to_m = reaching.up_to_m;
        }
    }
    write_efficiency(&locked, (&stored, &file.efficiency()?), &covariates, &measures)?;
    Ok(EfficiencyReport::new(stored, &covariates, &measures, up_to_m, &file.consistency()?))
}

/// Those of the measures `wanted` that can be had, of each record.
fn intensities(
    file: &ResultFile,
    wanted: &BTreeSet<IntensityMeasure>,
    events: &dyn Events,
) -> Result<BTreeMap<IntensityMeasure, Vec<f64>>, QuestionsError> {
    let stored = file.records()?;
    let mut known = BTreeMap::new();
    let mut missing = Vec::new();
    for &measure in wanted {
        match stored.intensities(measure) {
            Some(values) => drop(known.insert(measure, values.to_vec())),
            None => missing.push(measure),
        }
    }
    if missing.is_empty() {
        return Ok(known);
    }
    match StudyOfResult::read(file, None)?.records_measured(&missing) {
        Ok(set) => {
            for measure in missing {
                known.insert(measure, set.records.iter().map(|record| record.intensity(measure)).collect());
            }
        }
        Err(reason) => {
            let left_out: Vec<&str> = missing.iter().map(|measure| measure.label()).collect();
            events.note(&format!("{} left out, which need the records: {reason}", left_out.join(", ")));
        }
    }
    Ok(known)
}
