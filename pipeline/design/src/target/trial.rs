//! Values tried on exact stripes: the structure's oscillator at each of them, under the records of a result.

use std::ops::Range;
use std::path::Path;

use serde::Serialize;
use uplift_engine::analysis::{Analysed, LabelledPlan, Work};
use uplift_engine::checkpoint::Checkpoint;
use uplift_fragility::Stripes as Stripe;
use uplift_hazard::HazardCurve;
use uplift_ida::{Peaks, Plan, System};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::text::{counted, rate, records_in_words, thousands};
use uplift_risk::{PooledDemand, SiteWeights, StripeWeights};
use uplift_structure::Quantity;
use uplift_study::{Structure, UniformRiskStudy};
use uplift_uniform_risk::{EventRisk, SpectraOfResult, StudyOfResult, plan_levels};

use super::candidate::{Attempt, Candidate, StructureRisk};
use super::{TargetEvent, TargetOptions};
use crate::certainty::{Bands, Scatter, rate_bands};
use crate::design::without_uncertainty;
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::limit::FrameLimit;
use crate::opening::{Place, ShakenRecords, job_name, records_and_pairs, required, restitution};
use crate::own_structure::{OwnLevels, OwnPeaks, OwnStructure};
use crate::pairs::Pairs;
use crate::risk::{HAPPENS, OVERTURNING_M, bounded, happenings, risk_of_exceeding};
use crate::uncertain::{Around, Spread};

/// How often it happens given the level of a return period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LevelShare {
    /// The return period, years.
    pub return_period_years: f64,
    /// Its level by the site's hazard curve, in the unit of the measure.
    pub level: f64,
    /// Records, each scaled to the level.
    pub records: usize,
    /// Runs: every record with every structure that it may shake.
    pub runs: usize,
    /// Those of them in which it happens.
    pub count: usize,
    /// Their share, 0 to 1.
    pub probability: f64,
}

/// What values are tried on. The rows of every round stay in the checkpoint until the answer is given.
pub(super) struct Trials<'a> {
    structure: &'a Structure,
    /// The study of the result, with what happens after the end of a record.
    pub(super) study: UniformRiskStudy,
    measure: &'a SpectraOfResult,
    pub(super) weights: SiteWeights<'a>,
    hazard: &'a Hazard<'a>,
    scatter: &'a Scatter,
    options: &'a TargetOptions,
    years: f64,
    pub(super) records: ShakenRecords,
    /// The pairs that they are of, until a frame is shaken by them; none without a frame.
    pub(super) components: Option<Pairs>,
    /// Coefficient of restitution of the oscillators.
    pub(super) restitution: f64,
    /// The structures that every value may be; none where all of it is known, and with repaired weights.
    pub(super) around: Option<Around<'a>>,
    jobs: Jobs<'a>,
    /// Nonlinear time histories so far.
    pub(super) analyses: u64,
}

/// The jobs of a search on a result. One has the checkpoint at a time, and the next goes on with it.
struct Jobs<'a> {
    name: String,
    result: &'a Path,
    events: &'a dyn Events,
    checkpoint: Option<Checkpoint>,
}

impl Jobs<'_> {
    fn run(&mut self, plans: Vec<LabelledPlan<'_>>) -> Result<Vec<Analysed>, DesignError> {
        drop(self.checkpoint.take());
        let (analysed, checkpoint) = Work::new(&self.name, plans).asked_of(self.result, &[], self.events)?;
        self.checkpoint = Some(checkpoint);
        Ok(analysed)
    }
}

impl<'a> Trials<'a> {
    /// Of `structure`, by the stripes of the measure of `place` with its hazard, under records that scatter so, with
    /// their pairs where a frame is to be shaken.
    pub(super) fn from_structure(
        structure: &'a Structure,
        source: &'a StudyOfResult,
        (place, weights): (Place<'a>, SiteWeights<'a>),
        (hazard, scatter): (&'a Hazard<'a>, &'a Scatter),
        (options, years, with_pairs): (&'a TargetOptions, f64, bool),
        events: &'a dyn Events,
    ) -> Result<Self, DesignError> {
        let found = records_and_pairs(source, options.manifest.as_deref(), with_pairs)?;
        let (records, components) = required(found, "a target")?;
        let mut study = source.study.clone();
        // what is lost when a record ends has overturned, whoever looks
        study.oscillator.free_vibration |= options.event() == TargetEvent::Overturning;
        let restitution = restitution(structure, &study);
        let around = match weights {
            SiteWeights::Alike(_) => Around::from_structure(structure, restitution, records.count())?,
            SiteWeights::Repaired(_) => None,
        };
        Ok(Self {
            around,
            structure,
            measure: place.measure,
            weights,
            hazard,
            scatter,
            options,
            years,
            records,
            components,
            restitution,
            study,
            jobs: Jobs { name: job_name("target", structure), result: &source.path, events, checkpoint: None },
            analyses: 0,
        })
    }

    /// The peaks of the structure itself at `levels`, of a frame by its planar model too where it is asked for.
    pub(super) fn shake(
        &mut self,
        itself: &OwnStructure,
        levels: &OwnLevels,
        with_planar: bool,
    ) -> Result<OwnPeaks, DesignError> {
        let mut plans = itself.plans(&self.records, (self.measure.measure(), levels))?;
        plans.truncate(1 + usize::from(with_planar));
        Ok(itself.peaks(&self.jobs.run(plans)?))
    }

    /// Refuses a target rarer than what a structure may do of which no run shows it: whatever is found, the stripes
    /// could not tell it from that.
    ///
    /// # Errors
    /// Such a target, at `site`.
    pub(super) fn refuse_untellable(&self, site: &str, target_per_year: f64) -> Result<(), DesignError> {
        let unseen = bounded(EventRisk::new(0.0, [0.0; 2], self.years)?, &self.weights, &self.scatter.pairs);
        let Some(bound) = unseen.at_most_per_year.filter(|bound| *bound > target_per_year) else { return Ok(()) };
        let levels = &self.measure.plan.levels;
        let measure = self.measure.measure();
        Err(JobError::Usage(format!(
            "the target of {} per year is too rare for these levels at {site}: motions above the last level, {} {}, \
             come {} times a year, so even if none of {} fails there the rate can be up to {} per year. Raise the \
             last of {} and run the study again, use more records, or give a target above that rate",
            rate(target_per_year),
            levels[levels.len() - 1],
            measure.unit(),
            rate(self.weights.stripes().upper_tail_per_year()),
            records_in_words(self.records.count(), self.scatter.pairs.len()),
            rate(bound),
            uplift_study::levels_key(measure)
        ))
        .into())
    }

    /// The risks of `values`, in one work.
    ///
    /// # Errors
    /// A value that no such structure has; [`JobError::Paused`] where the events say so.
    pub(super) fn attempt(&mut self, values: &[f64]) -> Result<Vec<Attempt>, DesignError> {
        let candidates = values.iter().map(|&value| self.candidate(value)).collect::<Result<Vec<_>, _>>()?;
        let label = format!("{}, {}", self.measure.measure().label(), counted(values.len(), "value"));
        let levels = self.measure.plan.levels.to_vec();
        let analysed = self.analyse(&label, &levels, &candidates)?;
        let weigh = |(place, candidate)| self.weigh(&analysed.peaks, place, candidate);
        candidates.into_iter().enumerate().map(weigh).collect()
    }

    /// The risk of `value` by another measure with this hazard, by which runs weigh so much.
    ///
    /// # Errors
    /// As [`attempt`](Self::attempt).
    pub(super) fn attempt_by(
        &mut self,
        value: f64,
        (measure, hazard, weights): (&'a SpectraOfResult, &'a Hazard<'a>, SiteWeights<'a>),
    ) -> Result<Attempt, DesignError> {
        let own = (self.measure, self.hazard, self.weights);
        (self.measure, self.hazard, self.weights) = (measure, hazard, weights);
        let found = self.attempt(&[value]);
        (self.measure, self.hazard, self.weights) = own;
        found?.pop().ok_or(JobError::Interrupted.into())
    }

    /// The structures that may be what `value` makes of the structure.
    ///
    /// # Errors
    /// A value that no such structure has.
    fn candidate(&self, value: f64) -> Result<Candidate, DesignError> {
        let quantity = self.options.quantity;
        let refused = |mistake: String| refused(quantity, value, &mistake);
        let system = quantity
            .varied(&self.structure.description, value)
            .map_err(|mistakes| refused(mistakes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")))?;
        let described = system.spectral_oscillator(self.restitution).map_err(|error| refused(error.to_string()))?;
        let systems = match &self.around {
            None => vec![System::Oscillator(described)],
            Some(around) => around.systems(&system).map_err(|error| refused(error.to_string()))?,
        };
        // without another columns stay as they are
        let varied = self.structure.varied(quantity, value).map_err(refused)?;
        let columns = varied.as_ref().unwrap_or(self.structure).columns.as_ref();
        let tendon_limit_m = columns.and_then(FrameLimit::from_tendons).map(|limit| limit.displacement_m);
        Ok(Candidate { system, tendon_limit_m, systems })
    }

    /// What the `peaks` of the candidate at `place` among others say.
    fn weigh(&self, peaks: &Peaks, place: usize, candidate: Candidate) -> Result<Attempt, DesignError> {
        let all = place * self.per_record()..(place + 1) * self.per_record();
        let mut counts = vec![0_u32; self.records.count() * self.measure.plan.levels.len()];
        let mut of_places = |places| self.risk_of(peaks, places, (&candidate, &mut counts));
        // structures of each record are one fragility together, branches one each
        let structures: Vec<StructureRisk> = if self.is_of_each_record() {
            vec![of_places(all)?]
        } else {
            all.map(|place| of_places(place..place + 1)).collect::<Result<_, _>>()?
        };
        let happens: Vec<f64> = counts.iter().map(|&count| f64::from(count) / self.per_record() as f64).collect();
        let of = |value: &dyn Fn(&StructureRisk) -> f64| mean(structures.iter().map(value).collect());
        let tail = |share: fn(&EventRisk) -> f64| of(&|one: &StructureRisk| share(&one.risk) * one.risk.per_year);
        let mut risk = if let [one] = &structures[..] {
            one.risk
        } else {
            let tails = [tail(|risk| risk.lower_tail_share), tail(|risk| risk.upper_tail_share)];
            EventRisk::new(of(&|one| one.risk.per_year), tails, self.years)?
        };
        // what has no capacity cannot overturn
        let may_happen = |system: &System| {
            candidate.threshold_m(self.options.event(), system) < OVERTURNING_M || system.can_overturn()
        };
        if candidate.systems.iter().any(may_happen) {
            risk = bounded(risk, &self.weights, &self.scatter.pairs);
        }
        let bands = self.bands(peaks, place, &candidate)?;
        let record_per_year: Vec<f64> =
            (0..self.records.count()).map(|record| of(&|one| one.record_per_year[record])).collect();
        let by_curve = |(_, stripes): &(f64, StripeWeights)| -> Vec<f64> {
            let per_year = stripes.per_year();
            let of_record = |shares: &[f64]| shares.iter().zip(&per_year).map(|(share, weight)| share * weight).sum();
            happens.chunks_exact(per_year.len()).map(of_record).collect()
        };
        let by_branch = self.hazard.branches.iter().map(by_curve).collect();
        Ok(Attempt { candidate, risk, bands, happens, record_per_year, by_branch, structures })
    }

    /// The bands of the frequency by the runs of the candidate at `place` alone, as `overturning` and `risk` have them;
    /// none of a structure that is not known exactly, of a single record, and where no run shows it.
    fn bands(&self, peaks: &Peaks, place: usize, candidate: &Candidate) -> Result<Option<Bands>, DesignError> {
        let (None, [oscillator]) = (&self.around, &candidate.systems[..]) else { return Ok(None) };
        let peaks_m: Vec<f64> =
            (0..self.records.count()).flat_map(|record| peaks.row_m(record, place)).copied().collect();
        let pool = PooledDemand::new(&Stripe::new(&self.measure.plan.levels, &peaks_m)?)?;
        let threshold_m = candidate.threshold_m(self.options.event(), oscillator);
        rate_bands(&pool, (self.hazard, self.weights.repaired()), self.scatter, threshold_m)
    }

    /// The risk of the structures at `places` of a `candidate`, each with its own threshold; counts in `counts` to how
    /// many of them it happens, `[record, level]`.
    fn risk_of(
        &self,
        peaks: &Peaks,
        places: Range<usize>,
        (candidate, counts): (&Candidate, &mut [u32]),
    ) -> Result<StructureRisk, DesignError> {
        let (records, draws) = (self.records.count(), places.len());
        let run = |record: usize, place: usize| {
            let own = place % self.per_record() + if self.is_of_each_record() { record * self.per_record() } else { 0 };
            let system = &candidate.systems[own];
            (peaks.row_m(record, place), candidate.threshold_m(self.options.event(), system))
        };
        let of_record = |record: usize| places.clone().map(move |place| run(record, place));
        let told = happenings(&self.measure.plan.levels, (0..records).flat_map(of_record))?;
        let risk = risk_of_exceeding(&told, &self.weights, HAPPENS, self.years)?;
        let contributed = |weights: &StripeWeights| -> Vec<f64> {
            let per_year = weights.per_year();
            let of_run = |(row_m, threshold_m): (&[f64], f64)| -> f64 {
                let peaks_m = row_m.iter().zip(&per_year);
                peaks_m.filter(|(peak_m, _)| **peak_m > threshold_m).map(|(_, weight)| weight).sum()
            };
            (0..records).map(|record| of_record(record).map(of_run).sum::<f64>() / draws as f64).collect()
        };
        for (record, counts) in counts.chunks_exact_mut(self.measure.plan.levels.len()).enumerate() {
            for (row_m, threshold_m) in of_record(record) {
                counts.iter_mut().zip(row_m).for_each(|(count, peak_m)| *count += u32::from(*peak_m > threshold_m));
            }
        }
        let number = self.around.as_ref().and_then(|around| around.hazard_number(places.start % self.per_record()));
        let with_hazard = number.filter(|_| !self.hazard.branches.is_empty());
        Ok(StructureRisk {
            risk,
            record_per_year: contributed(self.weights.stripes()),
            with_hazard: with_hazard.map(|number| contributed(self.hazard.at(number))),
        })
    }

    /// Which share of the runs lets it happen to the structures of `attempt` at the levels that `curve` has for the
    /// return periods asked for; one outside the curve is a note.
    pub(super) fn at_return_periods(
        &mut self,
        attempt: &Attempt,
        curve: Option<&HazardCurve>,
        notes: &mut Vec<String>,
    ) -> Result<Vec<LevelShare>, DesignError> {
        // shares of records tell nothing where these do not count alike
        let Some(curve) = curve.filter(|_| self.weights.repaired().is_none()) else { return Ok(Vec::new()) };
        let mut periods = self.options.return_periods.clone();
        periods.sort_by(f64::total_cmp);
        periods.dedup();
        let mut asked: Vec<(f64, f64)> = Vec::new();
        for years in periods {
            match curve.im_at_rate(1.0 / years) {
                // a curve that is level has one level for several
                Ok(level) if asked.last().is_none_or(|(_, before)| level > *before) => asked.push((years, level)),
                Ok(_) => {}
                Err(error) => notes.push(format!("no fragility at the return period of {years} years: {error}")),
            }
        }
        if asked.is_empty() {
            return Ok(Vec::new());
        }
        let levels: Vec<f64> = asked.iter().map(|(_, level)| *level).collect();
        let label = format!("{}, {} return periods", self.measure.measure().label(), levels.len());
        let analysed = self.analyse(&label, &levels, std::slice::from_ref(&attempt.candidate))?;
        let (candidate, event) = (&attempt.candidate, self.options.event());
        let records = self.records.count();
        let runs = records * self.per_record();
        let share = |(scale, &(return_period_years, level)): (usize, &(f64, f64))| {
            let happens = |run: usize| {
                let (record, place) = (run / self.per_record(), run % self.per_record());
                let own = if self.is_of_each_record() { run } else { place };
                let limit_m = candidate.threshold_m(event, &candidate.systems[own]);
                analysed.peaks.at_m([record, place, scale]) > limit_m
            };
            let count = (0..runs).filter(|run| happens(*run)).count();
            let probability = count as f64 / runs as f64;
            LevelShare { return_period_years, level, records, runs, count, probability }
        };
        Ok(asked.iter().enumerate().map(share).collect())
    }

    /// Why what is not known of the structure is left out, where there is such.
    pub(super) fn without_uncertainty(&self, source: &StudyOfResult) -> Option<String> {
        let is_left_out = self.structure.uncertainty.is_some() && self.weights.repaired().is_some();
        is_left_out.then(|| without_uncertainty(true, source))
    }

    /// Takes the checkpoint away, once the answer is there.
    pub(super) fn finish(self) {
        if let Some(checkpoint) = self.jobs.checkpoint {
            checkpoint.remove();
        }
    }

    /// The peaks of `candidates` at `levels`, in the unit of the measure: those of a candidate lie together.
    fn analyse(&mut self, label: &str, levels: &[f64], candidates: &[Candidate]) -> Result<Analysed, DesignError> {
        let systems: Vec<System> = if self.is_of_each_record() {
            // those of each record, one record after the other
            let of = |record: usize| record * self.per_record()..(record + 1) * self.per_record();
            let of_record = |record| candidates.iter().flat_map(move |one| one.systems[of(record)].iter().cloned());
            (0..self.records.count()).flat_map(of_record).collect()
        } else {
            candidates.iter().flat_map(|one| one.systems.iter().cloned()).collect()
        };
        let plan: Plan<'_> = plan_levels(&self.study, (self.measure.measure(), levels), &self.records.set, &systems)?;
        let plan = if self.is_of_each_record() { plan.with_own_systems()? } else { plan };
        self.analyses += plan.analyses();
        let remark = self.cost(&plan, candidates.len()).map(|cost| ("uncertainty".to_owned(), cost));
        let labelled =
            LabelledPlan { label: label.to_owned(), remark, plan, motions: &self.records.motions, known: None };
        let analysed = self.jobs.run(vec![labelled])?;
        analysed.into_iter().next().ok_or(JobError::Interrupted.into())
    }

    /// What a round costs where every value is many structures, in words.
    fn cost(&self, plan: &Plan<'_>, values: usize) -> Option<String> {
        self.around.as_ref()?;
        let (axes, structures) = (plan.axes(), self.per_record());
        let whose = if self.is_of_each_record() { "structures of each record" } else { "structures" };
        Some(format!(
            "{} x {structures} {whose} x {} x {}, {} analyses",
            counted(values, "value"),
            counted(axes.motions, "record"),
            counted(axes.scales, "level"),
            thousands(plan.analyses())
        ))
    }

    /// Structures that a record shakes at every value.
    pub(super) fn per_record(&self) -> usize {
        self.around.as_ref().map_or(1, |around| around.per_record)
    }

    fn is_of_each_record(&self) -> bool {
        self.around.as_ref().is_some_and(Around::is_of_each_record)
    }
}

/// Why a structure has no such value.
pub(super) fn refused(quantity: Quantity, value: f64, mistake: &str) -> JobError {
    JobError::Usage(format!("--vary {}, {value} {}: {mistake}: give --from and --to", quantity.key(), quantity.unit()))
}

/// The mean of numbers that are not alike; that of those that are, to the bit.
fn mean(values: Vec<f64>) -> f64 {
    Spread::from_values(values).mean
}
