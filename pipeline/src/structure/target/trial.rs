//! Values tried on exact stripes: the structure's oscillator at each of them, under the records of a result.

use std::path::Path;

use uplift_hazard::HazardCurve;
use uplift_ida::{Plan, System};
use uplift_oscillator::PostUplift;
use uplift_structure::EquivalentSystem;
use uplift_study::{Structure, UniformRiskStudy};

use super::{Attempt, LevelShare, TargetEvent, TargetOptions};
use crate::analysis::{Analysed, Beside, LabelledPlan, Work};
use crate::checkpoint::Checkpoint;
use crate::error::UpliftError;
use crate::events::Events;
use crate::inputs::RecordSet;
use crate::result::{SpectraOfResult, StudyOfResult};
use crate::structure::certainty::Scatter;
use crate::structure::choice::records;
use crate::structure::risk::{EventRisk, OVERTURNING_M, demand_of, risk_of_exceeding};
use crate::structure::weights::SiteWeights;
use crate::text::records_in_words;
use crate::uniform_risk::{Stripes, motion_keys, plan_levels};

/// What values are tried on. The rows of every round stay in the checkpoint until the answer is given.
pub(super) struct Trials<'a> {
    structure: &'a Structure,
    result: &'a Path,
    /// The study of the result, with what happens after the end of a record.
    study: UniformRiskStudy,
    measure: &'a SpectraOfResult,
    weights: SiteWeights<'a>,
    scatter: &'a Scatter,
    options: &'a TargetOptions,
    years: f64,
    set: RecordSet,
    /// Keys of the records' motions.
    motions: Vec<String>,
    restitution: f64,
    events: &'a dyn Events,
    name: String,
    checkpoint: Option<Checkpoint>,
    analyses: u64,
}

impl<'a> Trials<'a> {
    /// Of `structure`, by the stripes of `measure` with their weights at a site, under records that scatter so.
    ///
    /// # Errors
    /// Records that cannot be read.
    pub(super) fn of(
        structure: &'a Structure,
        source: &'a StudyOfResult,
        (measure, weights, scatter): (&'a SpectraOfResult, SiteWeights<'a>, &'a Scatter),
        (options, years): (&'a TargetOptions, f64),
        events: &'a dyn Events,
    ) -> Result<Self, UpliftError> {
        let set = records(source, options.manifest.as_deref())?.map_err(|reason| {
            UpliftError::input(format!(
                "{reason}; a target needs the records that the result was made from (--manifest says where they are)"
            ))
        })?;
        let mut study = source.study.clone();
        // what is lost when a record ends has overturned, whoever looks
        study.oscillator.free_vibration |= options.event == TargetEvent::Overturning;
        Ok(Self {
            structure,
            result: &source.path,
            measure,
            weights,
            scatter,
            options,
            years,
            motions: motion_keys(&set),
            set,
            restitution: structure.description.restitution.unwrap_or(study.oscillator.restitution),
            study,
            events,
            name: format!("target {}", structure.file.file_stem().unwrap_or_default().to_string_lossy()),
            checkpoint: None,
            analyses: 0,
        })
    }

    /// Coefficient of restitution of the oscillators.
    pub(super) fn restitution(&self) -> f64 {
        self.restitution
    }

    /// Records that shake them.
    pub(super) fn record_count(&self) -> usize {
        self.set.records.len()
    }

    /// The positions of the records of each of their pairs.
    pub(super) fn pairs(&self) -> &[Vec<usize>] {
        &self.scatter.pairs
    }

    /// Nonlinear time histories so far.
    pub(super) fn analyses(&self) -> u64 {
        self.analyses
    }

    /// Refuses a target rarer than what a structure may do of which no run shows it: whatever is found, the stripes
    /// could not tell it from that.
    ///
    /// # Errors
    /// Such a target, at `site`.
    pub(super) fn refuse_untellable(&self, site: &str, target_per_year: f64) -> Result<(), UpliftError> {
        let unseen = EventRisk::new(0.0, [0.0; 2], self.years)?.bounded(&self.weights, self.pairs());
        let Some(bound) = unseen.at_most_per_year.filter(|bound| *bound > target_per_year) else { return Ok(()) };
        let levels = &self.measure.plan.levels;
        let measure = self.measure.measure();
        Err(UpliftError::Usage(format!(
            "the target of {target_per_year:.3e} per year is below what these stripes can tell at {site}: motions \
             above their last level, {} {}, come {:.1e} times a year, and what none of {} does there may still \
             happen up to {bound:.1e} times a year: let {} of the study reach further up and run it again, take more \
             records, or give a target above that",
            levels[levels.len() - 1],
            measure.unit(),
            self.weights.stripes().upper_tail_per_year(),
            records_in_words(self.record_count(), self.pairs().len()),
            uplift_study::levels_key(measure)
        )))
    }

    /// The risks of `values`, in one work.
    ///
    /// # Errors
    /// A value that no such structure has; [`UpliftError::Paused`] where the events say so.
    pub(super) fn attempt(&mut self, values: &[f64]) -> Result<Vec<Attempt>, UpliftError> {
        let quantity = self.options.quantity;
        let system = |&value: &f64| {
            let refused = |mistake: String| {
                let key = quantity.key();
                UpliftError::Usage(format!(
                    "--vary {key}, {value} {}: {mistake}: give --from and --to",
                    quantity.unit()
                ))
            };
            let system = quantity
                .varied(&self.structure.description, value)
                .map_err(|mistakes| refused(mistakes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")))?;
            let oscillator =
                system.spectral_oscillator(self.restitution).map_err(|error| refused(error.to_string()))?;
            Ok((system, System::Oscillator(oscillator)))
        };
        let found: Vec<(EquivalentSystem, System)> = values.iter().map(system).collect::<Result<_, UpliftError>>()?;
        let (systems, oscillators): (Vec<_>, Vec<_>) = found.into_iter().unzip();
        let label = format!("{}, {} values", self.measure.measure().label(), values.len());
        let levels = self.measure.plan.levels.to_vec();
        let analysed = self.analyse(&label, &levels, &oscillators)?;
        let stripes = Stripes::of(&self.measure.plan, &self.set, analysed);
        let weigh = |(place, (system, oscillator)): (usize, (EquivalentSystem, System))| {
            let threshold_m = threshold_m(self.options.event, &system, &oscillator);
            let demand = demand_of(&stripes, place)?;
            let risk = risk_of_exceeding(&demand, &self.weights, threshold_m, self.years)?;
            // what has no capacity cannot overturn
            let may_happen = threshold_m < OVERTURNING_M || oscillator.can_overturn();
            let risk = if may_happen { risk.bounded(&self.weights, self.pairs()) } else { risk };
            let per_year = self.weights.stripes().per_year();
            let contributed = |record: usize| -> f64 {
                let peaks_m = stripes.peaks.row_m(record, place).iter();
                peaks_m.zip(&per_year).filter(|(peak_m, _)| **peak_m > threshold_m).map(|(_, weight)| weight).sum()
            };
            let record_per_year = (0..self.set.records.len()).map(contributed).collect();
            Ok(Attempt { system, oscillator, risk, record_per_year })
        };
        systems.into_iter().zip(oscillators.iter().cloned()).enumerate().map(weigh).collect()
    }

    /// Which share of the records lets it happen to the structure of `attempt` at the levels that `curve` has for the
    /// return periods asked for; one outside the curve is a note.
    ///
    /// # Errors
    /// As [`attempt`](Self::attempt).
    pub(super) fn at_return_periods(
        &mut self,
        attempt: &Attempt,
        curve: Option<&HazardCurve>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<LevelShare>, UpliftError> {
        let Some(curve) = curve else { return Ok(Vec::new()) };
        let mut periods = self.options.return_periods.clone();
        periods.sort_by(f64::total_cmp);
        periods.dedup();
        let mut asked: Vec<(f64, f64)> = Vec::new();
        for years in periods {
            match curve.im_at_rate(1.0 / years) {
                // a curve that is level has one level for several
                Ok(level) if asked.last().is_none_or(|(_, before)| level > *before) => asked.push((years, level)),
                Ok(_) => {}
                Err(error) => notes.push(format!("nothing is told of a return period of {years} years: {error}")),
            }
        }
        if asked.is_empty() {
            return Ok(Vec::new());
        }
        let levels: Vec<f64> = asked.iter().map(|(_, level)| *level).collect();
        let label = format!("{}, {} return periods", self.measure.measure().label(), levels.len());
        let analysed = self.analyse(&label, &levels, std::slice::from_ref(&attempt.oscillator))?;
        let threshold_m = threshold_m(self.options.event, &attempt.system, &attempt.oscillator);
        let share = |(place, &(return_period_years, level)): (usize, &(f64, f64))| {
            let peaks_m = analysed.peaks.over_motions_m(0, place);
            let count = peaks_m.iter().filter(|peak_m| **peak_m > threshold_m).count();
            LevelShare {
                return_period_years,
                level,
                records: peaks_m.len(),
                count,
                probability: count as f64 / peaks_m.len() as f64,
            }
        };
        Ok(asked.iter().enumerate().map(share).collect())
    }

    /// Takes the checkpoint away, once the answer is there.
    pub(super) fn finish(self) {
        if let Some(checkpoint) = self.checkpoint {
            checkpoint.remove();
        }
    }

    /// The peaks of `systems` at `levels`, in the unit of the measure.
    fn analyse(&mut self, label: &str, levels: &[f64], systems: &[System]) -> Result<Analysed, UpliftError> {
        // one job has the file at a time, and this one goes on with it
        drop(self.checkpoint.take());
        let plan: Plan<'_> = plan_levels(&self.study, (self.measure.measure(), levels), &self.set, systems)?;
        self.analyses += plan.analyses();
        let labelled =
            LabelledPlan { label: label.to_owned(), remark: None, plan, motions: &self.motions, known: None };
        let beside = Beside { result: self.result, name: &self.name };
        let (analysed, checkpoint) = beside.results(Work::new(&self.name, vec![labelled]), &[], self.events)?;
        self.checkpoint = Some(checkpoint);
        analysed.into_iter().next().ok_or(UpliftError::Interrupted)
    }
}

/// What must not be exceeded, m, in the displacement of the `oscillator`: Γ times it is the structure's.
fn threshold_m(event: TargetEvent, system: &EquivalentSystem, oscillator: &System) -> f64 {
    match (event, oscillator) {
        (TargetEvent::Beyond(displacement_m), _) => displacement_m / system.participation(),
        (TargetEvent::BeyondCapacity, System::Oscillator(oscillator)) => match oscillator.post_uplift() {
            PostUplift::Negative { capacity_m } => capacity_m,
            PostUplift::Zero | PostUplift::Positive { .. } => OVERTURNING_M,
        },
        (TargetEvent::BeyondCapacity | TargetEvent::Overturning, _) => OVERTURNING_M,
    }
}
