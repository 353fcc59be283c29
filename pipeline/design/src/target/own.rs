//! The structure itself, a frame or a block, at the value that its equivalent oscillator was found to need, and the
//! value that it needs itself.

use serde::Serialize;
use uplift_alarms::OwnRisk;
use uplift_ida::WOBBLING_FRAME;
use uplift_study::Structure;
use uplift_uniform_risk::EventRisk;

use super::search::{MOST_VALUES, NEAR, digits, least, next_value, rounded_up};
use super::trial::Trials;
use super::{TargetEvent, TargetOptions};
use crate::certainty::{Bands, Scatter, upper_per_year};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::limit::{FrameLimit, LimitRisk};
use crate::opening::Place;
use crate::own_structure::{OwnLevels, OwnModel, OwnMotion, OwnQuestion, OwnReport, OwnStructure};
use crate::risk::own_risk;

/// The structure itself: a frame or a block.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetOwn {
    /// The value at which its models are judged: the safe value of the proxy, or the best estimate where that is
    /// beyond the range.
    pub value: f64,
    /// Levels at which it was shaken at that value, in the unit of the measure.
    pub levels: Vec<f64>,
    /// Levels of the study.
    #[serde(skip)]
    pub levels_of_study: usize,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Wobbling under both components, then in the plane of the study's component; or what moves in a plane alone.
    pub models: Vec<TargetModel>,
    /// The value at which the limit is looked at: the safe one, or the first where there is none.
    #[serde(skip)]
    pub limit_at: f64,
    /// The limit that it passes there more often than it overturns; none where overturning is not what is asked for,
    /// and where it tells how often the structure fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<FrameLimit>,
    /// How often it passes that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_limit: Option<LimitRisk>,
    /// The least value tried at which the upper limit of its rate meets the target, and at all larger ones; infinite
    /// beyond the range.
    pub safe_value: f64,
    /// The largest value tried at which it does not; none where the first value is safe.
    pub missed_at: Option<f64>,
    /// Every value at which it was shaken, ascending.
    pub tried: Vec<TriedOwn>,
}

/// One model at the value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetModel {
    /// `wobbling frame`, `planar frame`, `block` or `equivalent block`.
    pub model: &'static str,
    /// Velocity after over before an impact.
    pub restitution: f64,
    /// Travel of the deck, or of the point of a block that its file follows, at the target rate, m; infinite where it
    /// overturns more often.
    pub demand_m: f64,
    /// How often it happens.
    pub risk: EventRisk,
    /// Its 90 % bands, 1/yr; none where no run shows it, and of a single record.
    pub bands: Option<Bands>,
    /// Whether the rate meets the target.
    pub is_met: bool,
    /// Whether the upper limit of its band does.
    pub is_safe: bool,
}

/// A value at which the structure itself was shaken.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TriedOwn {
    /// The value.
    pub value: f64,
    /// How often it happens.
    #[serde(flatten)]
    pub risk: EventRisk,
    /// The upper limit of its band, 1/yr.
    pub upper_per_year: f64,
    /// Whether that meets the target.
    pub is_safe: bool,
}

impl TargetOwn {
    /// Of `models` at the first value, and what was `tried`, ascending; without a limit.
    fn new(
        (levels, levels_of_study): (Vec<f64>, usize),
        analyses: u64,
        (value, models): (f64, Vec<TargetModel>),
        tried: &[(f64, TargetModel)],
    ) -> Self {
        let at = least(tried, |model| model.is_safe);
        let of_tried = |(value, model): &(f64, TargetModel)| TriedOwn {
            value: *value,
            risk: model.risk,
            upper_per_year: model.upper_per_year(),
            is_safe: model.is_safe,
        };
        Self {
            value,
            levels,
            levels_of_study,
            analyses,
            models,
            limit_at: value,
            limit: None,
            beyond_limit: None,
            safe_value: at.map_or(f64::INFINITY, |at| tried[at].0),
            missed_at: at.unwrap_or(tried.len()).checked_sub(1).map(|at| tried[at].0),
            tried: tried.iter().map(of_tried).collect(),
        }
    }

    /// The model that decides: the wobbling frame, or the only one.
    pub fn decisive(&self) -> &TargetModel {
        &self.models[0]
    }

    /// Whether it is a frame under both components.
    pub fn wobbles(&self) -> bool {
        self.decisive().model == WOBBLING_FRAME
    }

    /// The upper limit of its rate at the least safe value, 1/yr; 0 where there is none.
    pub fn upper_per_year_where_safe(&self) -> f64 {
        let at_safe = self.tried.iter().find(|tried| tried.value.total_cmp(&self.safe_value).is_eq());
        at_safe.map_or(0.0, |tried| tried.upper_per_year)
    }

    /// Risks of it that may come from outside the levels.
    pub(super) fn own_risks(&self, event: &str, place: Place<'_>, counts: (usize, usize)) -> Vec<OwnRisk> {
        let of = |own: &TargetModel| {
            own_risk((&format!("{event} of the {}", own.model), own.risk), (place.name, place.measure), counts)
        };
        self.models.iter().map(of).collect()
    }
}

impl TargetModel {
    /// Of a structure whose `threshold_m` must not be exceeded; none where it must not overturn.
    fn from_own(of: &OwnModel, threshold_m: Option<f64>, target_per_year: f64) -> Self {
        let (risk, bands) = match (threshold_m, of.beyond_capacity) {
            (Some(_), Some(risk)) => (risk, of.bands.and_then(|bands| bands.beyond_capacity_per_year)),
            _ => (of.overturning, of.bands.and_then(|bands| bands.overturning_per_year)),
        };
        let is_met = risk.per_year <= target_per_year;
        let OwnModel { model, restitution, demand_m, .. } = *of;
        let mut own = Self { model, restitution, demand_m, risk, bands, is_met, is_safe: false };
        own.is_safe = own.upper_per_year() <= target_per_year;
        own
    }

    /// The upper limit of the rate, 1/yr; the rate itself of a single record.
    pub fn upper_per_year(&self) -> f64 {
        upper_per_year(&self.risk, self.bands)
    }
}

impl TargetOwn {
    /// Whether it passes its limit more often than the target, which is of overturning alone.
    pub fn passes_limit_above(&self, target_per_year: f64) -> bool {
        self.limit.is_some() && self.beyond_limit.is_some_and(|beyond| beyond.risk.per_year > target_per_year)
    }
}

/// Where and by what it is judged.
pub(super) struct Judge<'a> {
    pub(super) structure: &'a Structure,
    /// How it is shaken itself; none where that is not asked for, and why it cannot be.
    pub(super) motion: Result<Option<OwnMotion>, String>,
    pub(super) options: &'a TargetOptions,
    pub(super) place: Place<'a>,
    /// The hazard of the place, and how records scatter.
    pub(super) of_records: (&'a Hazard<'a>, &'a Scatter),
    pub(super) target_per_year: f64,
    pub(super) years: f64,
}

impl Judge<'_> {
    /// The structure itself at the `safe` value of its proxy, or at the `best` estimate where that is infinite, and the
    /// value that it needs up to `most`; none where it is not asked for, and with the reason where it cannot be
    /// shaken.
    pub(super) fn judge(
        &self,
        trials: &mut Trials<'_>,
        [safe, best]: [f64; 2],
        [least, most]: [f64; 2],
    ) -> Result<(Option<TargetOwn>, Option<String>), DesignError> {
        let value = if safe.is_finite() { safe } else { best };
        let motion = match &self.motion {
            Ok(Some(motion)) => *motion,
            Ok(None) => return Ok((None, None)),
            Err(reason) => return Ok((None, Some(reason.clone()))),
        };
        // that a frame in space needs less is not worth its many analyses
        let range = [if motion == OwnMotion::InSpace { value } else { least }, most];
        let Some(first) = self.structure_at(value)? else { return Ok((None, Some(OF_SIZE.to_owned()))) };
        let mut itself = match OwnStructure::from_structure(&first, (motion, trials.components.take()), None)? {
            Ok(itself) => itself,
            Err(reason) => return Ok((None, Some(reason))),
        };
        let levels = itself.levels(&trials.records.set, self.place.measure);
        let at = (self.place.measure.measure(), &levels);
        if let Some(reason) = itself.leaves_the_ground(&trials.records.set, at)? {
            return Ok((None, Some(reason)));
        }
        let (report, models) = self.shaken(trials, (&itself, &first), &levels, true)?;
        let mut analyses = report.analyses;
        let limit_of = |report: &OwnReport| (report.governing_limit(), report.decisive().beyond_limit);
        let mut limits = vec![(value, limit_of(&report))];
        let tried = self.searched((value, models[0].clone()), range, |next| {
            let Some(structure) = self.structure_at(next)? else { return Ok(None) };
            if itself.change(&structure, motion)?.is_some() {
                return Ok(None);
            }
            let levels = itself.levels(&trials.records.set, self.place.measure);
            let (own, models) = self.shaken(trials, (&itself, &structure), &levels, false)?;
            analyses += own.analyses;
            limits.push((next, limit_of(&own)));
            Ok(models.into_iter().next())
        })?;
        let own = TargetOwn::new((levels.values, report.levels_of_study), analyses, (value, models), &tried);
        // at what it needs, where that is known
        let at_safe = limits.iter().find(|(at, _)| at.total_cmp(&own.safe_value).is_eq());
        let (limit_at, (limit, beyond)) = *at_safe.unwrap_or(&limits[0]);
        let beyond_limit = beyond.filter(|_| limit.is_some());
        Ok((Some(TargetOwn { limit_at, limit, beyond_limit, ..own }), None))
    }

    /// Tries values from the `first` on, within a range, until the least safe one is known well enough; ascending.
    fn searched(
        &self,
        first: (f64, TargetModel),
        range: [f64; 2],
        mut shake: impl FnMut(f64) -> Result<Option<TargetModel>, DesignError>,
    ) -> Result<Vec<(f64, TargetModel)>, DesignError> {
        let mut tried = vec![first];
        while tried.len() < MOST_VALUES {
            let Some(next) = self.next(&tried, range) else { break };
            let Some(model) = shake(next)? else { break };
            tried.push((next, model));
            tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        Ok(tried)
    }

    fn structure_at(&self, value: f64) -> Result<Option<Structure>, DesignError> {
        let (quantity, refused) = (self.options.quantity, super::trial::refused);
        Ok(self.structure.varied(quantity, value).map_err(|mistake| refused(quantity, value, &mistake))?)
    }

    /// Its models, the planar one too where it is asked for.
    fn shaken(
        &self,
        trials: &mut Trials<'_>,
        (itself, structure): (&OwnStructure, &Structure),
        levels: &OwnLevels,
        with_planar: bool,
    ) -> Result<(OwnReport, Vec<TargetModel>), DesignError> {
        let peaks = trials.shake(itself, levels, with_planar)?;
        let threshold_m = match self.options.event() {
            TargetEvent::Overturning => None,
            TargetEvent::BeyondLimit => itself.limit.map(|limit| limit.displacement_m),
            TargetEvent::BeyondCapacity(factor) => structure.system.capacity_m().map(|own_m| own_m / factor),
            TargetEvent::Beyond(displacement_m) => Some(displacement_m),
        };
        let (hazard, scatter) = self.of_records;
        let question = OwnQuestion {
            levels,
            place: self.place,
            weights: &trials.weights,
            hazard,
            scatter,
            target_per_year: self.target_per_year,
            years: self.years,
            capacity_m: threshold_m,
            safety_factor: 1.0,
            limit: itself.limit.filter(|_| threshold_m.is_none()),
            proxy_beyond_limit: None,
        };
        let report = question.answer(&peaks)?;
        let of = |model: &OwnModel| TargetModel::from_own(model, threshold_m, self.target_per_year);
        let models = report.models.iter().map(of).collect();
        Ok((report, models))
    }

    /// The next value to try, within a range; none where its smallest is safe, where the last that is not lies near
    /// enough to the next, and where its largest is not.
    fn next(&self, tried: &[(f64, TargetModel)], [least, most]: [f64; 2]) -> Option<f64> {
        let rates: Vec<(f64, f64)> = tried.iter().map(|(value, of)| (*value, of.upper_per_year())).collect();
        let next = next_value(&rates, self.target_per_year, self.options.tolerance.max(NEAR))?.clamp(least, most);
        let next = rounded_up(next, digits(self.options.tolerance), most);
        tried.iter().all(|(value, _)| value.total_cmp(&next).is_ne()).then_some(next)
    }
}

/// Why the structure itself is left out where strength or capacity vary.
pub(super) const OF_SIZE: &str = "strength and capacity follow from its size: vary width or size";
