//! The structure itself, and those that it may be, under the records and the hazard of a spectrum.

use uplift_engine::analysis::{LabelledPlan, Work};
use uplift_engine::checkpoint::Checkpoint;
use uplift_ida::System;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_result::ResultFile;
use uplift_risk::SiteWeights;
use uplift_study::Structure;
use uplift_uniform_risk::{SpectraOfResult, Stripes, StudyOfResult, plan_stripes};

use super::options::DesignOptions;
use crate::certainty::Scatter;
use crate::demand::{ExactDemand, exact_demand};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::opening::{Place, ShakenRecords, job_name, restitution};
use crate::own_structure::{OwnLevels, OwnMotion, OwnQuestion, OwnReport, OwnStructure};
use crate::pairs::Pairs;
use crate::shaken::Shaken;
use crate::sweep::Sweep;
use crate::uncertain::{Event, SiteQuestions, Uncertain, UncertaintyReport};

/// Where and by what a structure is designed.
pub(super) struct Question<'a> {
    pub(super) place: Place<'a>,
    pub(super) weights: &'a SiteWeights<'a>,
    /// Rate of the demand, 1/yr.
    pub(super) target_per_year: f64,
}

/// What the structure's own stripes say.
pub(super) struct OwnAnalysis {
    pub(super) exact: ExactDemand,
    /// None where all of it is known, and with repaired weights.
    pub(super) uncertainty: Option<UncertaintyReport>,
    /// The structure itself; none of one that is judged by its oscillator alone.
    pub(super) itself: Option<OwnReport>,
    /// Why a frame or a block is left out.
    pub(super) without_own: Option<String>,
    /// To be removed when the answer is given.
    pub(super) checkpoint: Checkpoint,
}

impl OwnAnalysis {
    /// Of `structure` under `records`.
    pub(super) fn from_structure(
        (structure, motion): (&Structure, Result<Option<OwnMotion>, String>),
        (file, source): (&ResultFile, &StudyOfResult),
        question: &Question<'_>,
        (options, records): (&DesignOptions, (ShakenRecords, Option<Pairs>)),
        events: &dyn Events,
    ) -> Result<Self, DesignError> {
        let Question { place, weights, target_per_year } = *question;
        let measure = place.measure;
        let analysis = DesignAnalysis::from_structure((structure, motion), (source, measure), (records, options))?;
        let work = analysis.work(source, &job_name("design", structure))?;
        let (analysed, checkpoint) = work.asked_of(&source.path, &options.shards, events)?;
        let set = &analysis.records.set;
        let mut analysed = analysed.into_iter();
        let own = Stripes::new(&measure.plan, set, analysed.next().ok_or(JobError::Interrupted)?);
        let of_own = analysis.itself.as_ref().map_or(0, |(itself, _)| itself.models().count());
        let of_own: Vec<_> = analysed.by_ref().take(of_own).collect();
        let of_uncertain = analysed.next().map(|analysed| Stripes::new(&measure.plan, set, analysed));
        let scatter = Scatter::from_file(file)?;
        let years = source.study.risk.years;
        let hazard = Hazard::from_file(file, source, (measure, place.site))?;
        let oscillators = (&own, analysis.sweep.oscillators.len());
        let shaken = Shaken::new(oscillators, (weights, &structure.system), (target_per_year, years))?;
        let exact = exact_demand(&shaken, own.analyses, &analysis.sweep, (&hazard, &scatter))?;
        let uncertainty = match (&analysis.uncertain, of_uncertain) {
            (Some(uncertain), Some(stripes)) => {
                let asked = asked_of_uncertain(&exact, target_per_year);
                let asked = SiteQuestions { name: place.name, hazard: &hazard, asked };
                let results = uncertain.results(&stripes, &[asked], &scatter)?;
                Some(uncertain.report(stripes.analyses, results))
            }
            _ => None,
        };
        let answer = |(itself, levels): &(OwnStructure, OwnLevels)| {
            let of_proxy = |limit| shaken.beyond_limit(limit, (&hazard, &scatter));
            let question = OwnQuestion {
                levels,
                place,
                weights,
                hazard: &hazard,
                scatter: &scatter,
                target_per_year,
                years,
                capacity_m: structure.system.capacity_m(),
                safety_factor: options.safety_factor,
                limit: itself.limit,
                proxy_beyond_limit: itself.limit.map(of_proxy).transpose()?,
            };
            question.answer(&itself.peaks(&of_own))
        };
        let itself = analysis.itself.as_ref().map(answer).transpose()?;
        Ok(Self { exact, uncertainty, itself, without_own: analysis.without_own, checkpoint })
    }
}

/// The oscillators of a structure, and the records that shake them.
pub(super) struct DesignAnalysis<'a> {
    measure: &'a SpectraOfResult,
    records: ShakenRecords,
    /// The structure itself, with its levels; none of one that is judged by its oscillator alone.
    itself: Option<(OwnStructure, OwnLevels)>,
    /// Why a frame or a block is left out.
    without_own: Option<String>,
    sweep: Sweep,
    systems: Vec<System>,
    /// The structures that it may be; none where all of it is known, and with repaired weights.
    uncertain: Option<Uncertain<'a>>,
}

impl<'a> DesignAnalysis<'a> {
    pub(super) fn from_structure(
        (structure, motion): (&'a Structure, Result<Option<OwnMotion>, String>),
        (source, measure): (&StudyOfResult, &'a SpectraOfResult),
        ((records, pairs), options): ((ShakenRecords, Option<Pairs>), &DesignOptions),
    ) -> Result<Self, DesignError> {
        let sweep = Sweep::from_structure(structure, &source.study, options.sensitivity)?;
        let is_asked = !options.repaired && source.study.records.at_level.is_none();
        let restitution = restitution(structure, &source.study);
        let uncertain =
            if is_asked { Uncertain::from_structure(structure, restitution, records.count())? } else { None };
        let (itself, without_own) = OwnStructure::or_reason(structure, (motion, pairs), None)?;
        let itself = itself.map(|itself| {
            let levels = itself.levels(&records.set, measure);
            (itself, levels)
        });
        let falls = match &itself {
            Some((itself, levels)) => itself.leaves_the_ground(&records.set, (measure.measure(), levels))?,
            None => None,
        };
        let itself = itself.filter(|_| falls.is_none());
        let without_own = without_own.or(falls);
        Ok(Self { systems: sweep.systems(), sweep, uncertain, itself, without_own, measure, records })
    }

    /// Their stripes by the measure, then those of the structure itself, then those of the structures that it may be.
    pub(super) fn work(&self, source: &StudyOfResult, title: &str) -> Result<Work<'_>, DesignError> {
        let measure = self.measure;
        let plan = plan_stripes(&source.study, &measure.plan, &self.records.set, &self.systems)?;
        let label = measure.measure().label().to_owned();
        let mut plans = vec![LabelledPlan { label, remark: None, plan, motions: &self.records.motions, known: None }];
        if let Some((itself, levels)) = &self.itself {
            plans.extend(itself.plans(&self.records, (measure.measure(), levels))?);
        }
        if let Some(uncertain) = &self.uncertain {
            let study = (measure.measure().label(), &source.study);
            plans.push(uncertain.plan(study, &measure.plan, &self.records)?);
        }
        Ok(Work::new(title, plans))
    }
}

/// What is asked of the structures that it may be, each with the answer for the structure as described.
fn asked_of_uncertain(exact: &ExactDemand, target_per_year: f64) -> Vec<(Event, f64)> {
    let mut asked = vec![(Event::Demand(target_per_year), exact.demand_m)];
    if let Some(beyond) = &exact.beyond_capacity {
        asked.extend([(Event::BeyondCapacity, beyond.per_year), (Event::Overturning, exact.overturning.per_year)]);
    }
    asked
}
