//! Demand, verdict and risks of the structure itself.

use serde::Serialize;
use uplift_alarms::OwnRisk;
use uplift_fragility::Stripes as Stripe;
use uplift_ida::WOBBLING_FRAME;
use uplift_risk::{PooledDemand, SiteWeights, StripeWeights};
use uplift_uniform_risk::EventRisk;

use super::shaking::{OwnLevels, OwnPeaks};
use crate::certainty::{DemandBands, Scatter, demand_bands};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::limit::{FrameLimit, LimitEvent, LimitRisk};
use crate::opening::Place;
use crate::risk::{OVERTURNING_M, bounded, own_risk, risk_of_exceeding};
use crate::rules::OwnCheck;

/// The structure itself, as a design shows it: a frame, or a block.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OwnReport {
    /// Levels at which it was shaken, in the unit of the measure.
    pub levels: Vec<f64>,
    /// Levels of the study.
    #[serde(skip)]
    pub levels_of_study: usize,
    /// What it must not pass before it overturns; none where there is nothing.
    pub limit: Option<FrameLimit>,
    /// How often its proxy, the equivalent oscillator, moves as far as that.
    pub proxy_beyond_limit: Option<LimitRisk>,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Wobbling under both components, then in the plane of the study's component; or what moves in a plane alone.
    pub models: Vec<OwnModel>,
}

/// One model of the structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OwnModel {
    /// `wobbling frame`, `planar frame`, `block` or `equivalent block`.
    pub model: &'static str,
    /// Velocity after over before an impact.
    pub restitution: f64,
    /// Travel of the deck, or of the point of a block that its file follows, at the target rate, m; infinite where it
    /// overturns more often.
    pub demand_m: f64,
    /// 90 % bands; none of a single record.
    pub bands: Option<DemandBands>,
    /// The displacement capacity is exceeded; none for a structure without one.
    pub beyond_capacity: Option<EventRisk>,
    /// It passes its limit; none of one without.
    pub beyond_limit: Option<LimitRisk>,
    /// It overturns.
    pub overturning: EventRisk,
    /// The capacity held against the demand; none for a structure without one.
    pub check: Option<OwnCheck>,
}

impl OwnReport {
    /// The model that decides: the wobbling frame, or the only one.
    pub fn decisive(&self) -> &OwnModel {
        &self.models[0]
    }

    /// Whether it is a frame under both components.
    pub fn wobbles(&self) -> bool {
        self.decisive().model == WOBBLING_FRAME
    }

    /// What it is in a word: `frame` where it is by two models, else the model.
    pub fn noun(&self) -> &'static str {
        if self.wobbles() { "frame" } else { self.decisive().model }
    }

    /// The limit, where passing it and not overturning tells how often the structure fails.
    pub fn governing_limit(&self) -> Option<FrameLimit> {
        let own = self.decisive();
        self.limit.filter(|_| own.beyond_limit.is_some_and(|limit| limit.governs(&own.overturning)))
    }

    /// The limit of its tendons, where that comes before the capacity.
    pub fn limit_of_tendons(&self) -> Option<FrameLimit> {
        self.limit.filter(|limit| limit.event != LimitEvent::Capacity)
    }

    /// Risks of it that may come from outside the levels.
    pub(crate) fn own_risks(&self, place: Place<'_>, scatter: &Scatter) -> Vec<OwnRisk> {
        let counts = (scatter.pairs.iter().map(Vec::len).sum(), scatter.pairs.len());
        let of = |model: &OwnModel| {
            let event = format!("overturning of the {}", model.model);
            own_risk((&event, model.overturning), (place.name, place.measure), counts)
        };
        self.models.iter().map(of).collect()
    }
}

/// What is asked of the peaks of a structure at one site.
pub(crate) struct OwnQuestion<'a> {
    pub(crate) levels: &'a OwnLevels,
    pub(crate) place: Place<'a>,
    pub(crate) weights: &'a SiteWeights<'a>,
    pub(crate) hazard: &'a Hazard<'a>,
    pub(crate) scatter: &'a Scatter,
    /// Rate of the demand, 1/yr.
    pub(crate) target_per_year: f64,
    /// Years that probabilities refer to.
    pub(crate) years: f64,
    /// Displacement capacity of the structure, m.
    pub(crate) capacity_m: Option<f64>,
    pub(crate) safety_factor: f64,
    pub(crate) limit: Option<FrameLimit>,
    pub(crate) proxy_beyond_limit: Option<LimitRisk>,
}

impl OwnQuestion<'_> {
    /// Demand, verdict and risks by each model.
    pub(crate) fn answer(&self, peaks: &OwnPeaks) -> Result<OwnReport, DesignError> {
        let OwnLevels { places, values: levels } = self.levels;
        let mean: StripeWeights = self.hazard.mean.at_levels(places)?;
        let hazard = self.hazard.at_levels(&mean, places)?;
        let repaired = self.weights.repaired().map(|runs| runs.at_levels(places)).transpose()?;
        let weights = SiteWeights::new(&mean, repaired.as_ref());
        let model = |(model, restitution, peaks_m): &(&'static str, f64, Vec<f64>)| {
            let pool = PooledDemand::new(&Stripe::new(levels, peaks_m)?)?;
            let risk = |threshold_m: f64| -> Result<EventRisk, DesignError> {
                let risk = risk_of_exceeding(&pool, &weights, threshold_m, self.years)?;
                Ok(bounded(risk, &weights, &self.scatter.pairs))
            };
            let demand_m = weights.curve(&pool)?.exact_ordinate(self.target_per_year)?.displacement_m;
            let asked = (self.target_per_year, 1.0, self.capacity_m);
            let bands = demand_bands(&pool, (&hazard, repaired.as_ref()), self.scatter, asked)?;
            let upper_m = bands.as_ref().map(|bands| bands.demand_m.quoted()[1]);
            let check = |capacity_m: f64| OwnCheck::new(capacity_m, (demand_m, upper_m), self.safety_factor);
            let beyond_limit = |limit: FrameLimit| {
                let asked = (limit.displacement_m, self.years);
                LimitRisk::new(&pool, (&hazard, repaired.as_ref()), self.scatter, asked)
            };
            Ok(OwnModel {
                model,
                restitution: *restitution,
                demand_m,
                bands,
                beyond_capacity: self.capacity_m.map(risk).transpose()?,
                beyond_limit: self.limit.map(beyond_limit).transpose()?,
                overturning: risk(OVERTURNING_M)?,
                check: self.capacity_m.map(check),
            })
        };
        let models = peaks.models.iter().map(model).collect::<Result<_, DesignError>>()?;
        Ok(OwnReport {
            levels: levels.clone(),
            levels_of_study: self.place.measure.plan.levels.len(),
            limit: self.limit,
            proxy_beyond_limit: self.proxy_beyond_limit,
            analyses: peaks.analyses,
            models,
        })
    }
}
