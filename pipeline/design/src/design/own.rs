//! The structure itself, and those that it may be, under the records and the hazard of a spectrum.

use uplift_engine::analysis::{Beside, LabelledPlan, Work};
use uplift_engine::checkpoint::Checkpoint;
use uplift_ida::System;
use uplift_inputs::{RecordSet, motion_keys};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_result::ResultFile;
use uplift_study::Structure;
use uplift_uniform_risk::{SpectraOfResult, Stripes, StudyOfResult, plan_stripes};

use super::{DesignOptions, name};
use crate::certainty::Scatter;
use crate::demand::{ExactDemand, exact_demand};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::sweep::Sweep;
use crate::uncertain::{AskedSite, Event, Uncertain, UncertaintyReport};
use crate::weights::SiteWeights;

/// Where and by what a structure is designed.
pub(super) struct Question<'a> {
    /// Position of the site.
    pub(super) site: usize,
    pub(super) measure: &'a SpectraOfResult,
    pub(super) weights: &'a SiteWeights<'a>,
    /// Rate of the demand, 1/yr.
    pub(super) target_per_year: f64,
}

/// What the structure's own stripes say.
pub(super) struct Own {
    pub(super) exact: ExactDemand,
    /// None where all of it is known, and with repaired weights.
    pub(super) uncertainty: Option<UncertaintyReport>,
    /// To be removed when the answer is given.
    pub(super) checkpoint: Checkpoint,
}

impl Own {
    /// Of `structure`, whose impacts keep `restitution` of the velocity.
    ///
    /// # Errors
    /// As [`design`](super::design).
    pub(super) fn of(
        structure: &Structure,
        (file, source): (&ResultFile, &StudyOfResult),
        (question, restitution): (&Question<'_>, f64),
        (options, set): (&DesignOptions, RecordSet),
        events: &dyn Events,
    ) -> Result<Self, DesignError> {
        let Question { site, measure, weights, target_per_year } = *question;
        let shaken = Shaken::of(structure, source, set, (restitution, options))?;
        let asked = name(structure);
        let beside = Beside { result: &source.path, name: &asked };
        let (analysed, checkpoint) = beside.results(shaken.work(source, measure, &asked)?, &options.shards, events)?;
        let mut stripes = analysed.into_iter().map(|analysed| Stripes::of(&measure.plan, &shaken.set, analysed));
        let (own, of_uncertain) = (stripes.next().ok_or(JobError::Interrupted)?, stripes.next());
        let scatter = Scatter::of(file)?;
        let rate = (target_per_year, source.study.risk.years);
        let place = (source.sites[site].as_str(), site);
        let hazard = Hazard::of(file, place, (measure, &source.study))?;
        let exact = exact_demand((&own, weights, &hazard), (&structure.system, &shaken.sweep), rate, &scatter)?;
        let uncertainty = match (&shaken.uncertain, of_uncertain) {
            (Some(uncertain), Some(stripes)) => {
                let asked = asked_of_uncertain(&exact, target_per_year);
                let asked = AskedSite { name: place.0, hazard: &hazard, asked };
                let results = uncertain.results(&stripes, &[asked], &scatter)?;
                Some(uncertain.report(stripes.analyses, results))
            }
            _ => None,
        };
        Ok(Self { exact, uncertainty, checkpoint })
    }
}

/// The oscillators of a structure, and the records that shake them.
pub(super) struct Shaken<'a> {
    set: RecordSet,
    /// Keys of the records' motions.
    motions: Vec<String>,
    sweep: Sweep,
    systems: Vec<System>,
    /// The structures that it may be; none where all of it is known, and with repaired weights.
    uncertain: Option<Uncertain<'a>>,
}

impl<'a> Shaken<'a> {
    pub(super) fn of(
        structure: &'a Structure,
        source: &StudyOfResult,
        set: RecordSet,
        (restitution, options): (f64, &DesignOptions),
    ) -> Result<Self, DesignError> {
        let sweep = Sweep::of(&source.study, &structure.system, restitution)
            .map_err(|error| uplift_job::in_file(error, &structure.file))?;
        let is_asked = !options.repaired && source.study.records.at_level.is_none();
        let uncertain = if is_asked { Uncertain::of(structure, restitution, set.records.len())? } else { None };
        Ok(Self { motions: motion_keys(&set.records), systems: sweep.systems(), sweep, uncertain, set })
    }

    /// Their stripes of one measure, then those of the structures that it may be.
    pub(super) fn work(
        &self,
        source: &StudyOfResult,
        measure: &SpectraOfResult,
        title: &str,
    ) -> Result<Work<'_>, DesignError> {
        let plan = plan_stripes(&source.study, &measure.plan, &self.set, &self.systems)?;
        let label = measure.measure().label().to_owned();
        let mut plans = vec![LabelledPlan { label, remark: None, plan, motions: &self.motions, known: None }];
        if let Some(uncertain) = &self.uncertain {
            let study = (measure.measure().label(), &source.study);
            plans.push(uncertain.plan(study, &measure.plan, (&self.set, &self.motions))?);
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
