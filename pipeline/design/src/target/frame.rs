//! The frame itself at the value that its proxy was found to need, and the value that the wobbling frame needs.

use serde::Serialize;
use uplift_alarms::OwnRisk;
use uplift_risk::SiteWeights;
use uplift_study::Structure;
use uplift_uniform_risk::EventRisk;

use super::search::{digits, least, rounded_up};
use super::trial::Trials;
use super::{TargetEvent, TargetOptions};
use crate::certainty::{Bands, Scatter};
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::limit::{FrameLimit, LimitRisk};
use crate::opening::Place;
use crate::own_frame::{FrameLevels, FrameModel, FrameQuestion, FrameReport, OwnFrame};
use crate::risk::own_risk;

/// Most values at which a wobbling frame is shaken.
const MOST_VALUES: usize = 8;
/// How near the last value that is not safe lies to the first that is, as a share of it.
const NEAR: f64 = 0.02;
/// Least and largest factor from one value to the next while none is safe.
const STEPS: [f64; 2] = [1.05, 1.5];

/// The frame itself, where a structure describes one that can wobble.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetFrame {
    /// The value at which both models are judged: the safe value of the proxy, or the best estimate where that is
    /// beyond the range.
    pub value: f64,
    /// Levels at which it was shaken at that value, in the unit of the measure.
    pub levels: Vec<f64>,
    /// Levels of the study.
    #[serde(skip)]
    pub levels_of_study: usize,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Wobbling under both components, then in the plane of the study's component.
    pub models: Vec<TargetFrameModel>,
    /// The limit that the wobbling frame passes at the value more often than it overturns; none where overturning is
    /// not what is asked for, and where it tells how often the frame fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<FrameLimit>,
    /// How often it passes that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_limit: Option<LimitRisk>,
    /// The least value tried at which the upper limit of the wobbling frame's rate meets the target, and at all larger
    /// ones; infinite beyond the range.
    pub safe_value: f64,
    /// The largest value tried at which it does not; none where the first value is safe.
    pub missed_at: Option<f64>,
    /// Every value at which the wobbling frame was shaken, ascending.
    pub tried: Vec<TriedFrame>,
}

/// One model of the frame at the value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetFrameModel {
    /// `wobbling frame` or `planar frame`.
    pub model: &'static str,
    /// Velocity after over before an impact.
    pub restitution: f64,
    /// Travel of the deck at the target rate, m; infinite where it overturns more often.
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

/// A value at which the wobbling frame was shaken.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TriedFrame {
    /// The value.
    pub value: f64,
    /// How often it happens, 1/yr.
    pub per_year: f64,
    /// The upper limit of its band, 1/yr.
    pub upper_per_year: f64,
    /// Whether that meets the target.
    pub is_safe: bool,
}

impl TargetFrame {
    /// The wobbling frame.
    pub fn wobbling(&self) -> &TargetFrameModel {
        &self.models[0]
    }

    /// Risks of it that may come from outside the levels.
    pub(super) fn own_risks(&self, event: &str, place: Place<'_>, counts: (usize, usize)) -> Vec<OwnRisk> {
        let of = |own: &TargetFrameModel| {
            own_risk((&format!("{event} of the {}", own.model), own.risk), (place.name, place.measure), counts)
        };
        self.models.iter().map(of).collect()
    }
}

impl TargetFrameModel {
    /// Of a model whose `threshold_m` must not be exceeded; none where it must not overturn.
    fn from_model(of: &FrameModel, threshold_m: Option<f64>, target_per_year: f64) -> Self {
        let (risk, bands) = match (threshold_m, of.beyond_capacity) {
            (Some(_), Some(risk)) => (risk, of.bands.and_then(|bands| bands.beyond_capacity_per_year)),
            _ => (of.overturning, of.bands.and_then(|bands| bands.overturning_per_year)),
        };
        let mut own = Self {
            model: of.model,
            restitution: of.restitution,
            demand_m: of.demand_m,
            risk,
            bands,
            is_met: risk.per_year <= target_per_year,
            is_safe: false,
        };
        own.is_safe = own.upper_per_year() <= target_per_year;
        own
    }

    /// The upper limit of the rate, 1/yr; the rate itself of a single record.
    pub fn upper_per_year(&self) -> f64 {
        let limit = self.risk.at_most_per_year.or_else(|| Some(self.bands?.fullest()[1]));
        limit.unwrap_or(self.risk.per_year)
    }
}

impl TargetFrame {
    /// Whether the wobbling frame passes its limit more often than the target, which is of overturning alone.
    pub fn passes_limit_above(&self, target_per_year: f64) -> bool {
        self.limit.is_some() && self.beyond_limit.is_some_and(|beyond| beyond.risk.per_year > target_per_year)
    }
}

/// Where and by what a frame is judged.
pub(super) struct FrameTarget<'a> {
    pub(super) structure: &'a Structure,
    pub(super) options: &'a TargetOptions,
    pub(super) place: Place<'a>,
    /// The hazard of the place, and how records scatter.
    pub(super) of_records: (&'a Hazard<'a>, &'a Scatter),
    pub(super) target_per_year: f64,
    pub(super) years: f64,
}

impl FrameTarget<'_> {
    /// The frame at the `safe` value of its proxy, or at the `best` estimate where that is infinite, and the value that
    /// it needs up to `most`; none where it is not asked for, and with the reason where it leaves the ground.
    pub(super) fn judge(
        &self,
        trials: &mut Trials<'_>,
        [safe, best, most]: [f64; 3],
    ) -> Result<(Option<TargetFrame>, Option<String>), DesignError> {
        let Some(pairs) = trials.components.take() else { return Ok((None, None)) };
        let value = if safe.is_finite() { safe } else { best };
        let Some(first) = self.structure_at(value)? else { return Ok((None, Some(NO_COLUMNS.to_owned()))) };
        let mut frame = OwnFrame::from_structure(&first, pairs)?;
        let levels = frame.levels(&trials.records.set, self.place.measure);
        let at = (self.place.measure.measure(), &levels);
        if let Some(reason) = frame.leaves_the_ground(&trials.records.set, at)? {
            return Ok((None, Some(reason)));
        }
        let (mut report, models) = self.shaken(trials, (&frame, &first), &levels, true)?;
        let mut tried = vec![(value, models[0].clone())];
        while tried.len() < MOST_VALUES {
            let Some(next) = self.next(&tried, most) else { break };
            let Some(structure) = self.structure_at(next)? else { break };
            frame = OwnFrame::from_structure(&structure, frame.pairs)?;
            let levels = frame.levels(&trials.records.set, self.place.measure);
            let (own, models) = self.shaken(trials, (&frame, &structure), &levels, false)?;
            report.analyses += own.analyses;
            tried.extend(models.into_iter().map(|model| (next, model)));
            tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let at = least(&tried, |model| model.is_safe);
        let of_tried = |(value, model): &(f64, TargetFrameModel)| TriedFrame {
            value: *value,
            per_year: model.risk.per_year,
            upper_per_year: model.upper_per_year(),
            is_safe: model.is_safe,
        };
        let limit = report.governing_limit();
        let found = TargetFrame {
            value,
            levels: levels.values,
            levels_of_study: report.levels_of_study,
            analyses: report.analyses,
            models,
            limit,
            beyond_limit: limit.and_then(|_| report.wobbling().beyond_limit),
            safe_value: at.map_or(f64::INFINITY, |at| tried[at].0),
            missed_at: at.unwrap_or(tried.len()).checked_sub(1).map(|at| tried[at].0),
            tried: tried.iter().map(of_tried).collect(),
        };
        Ok((Some(found), None))
    }

    fn structure_at(&self, value: f64) -> Result<Option<Structure>, DesignError> {
        let (quantity, refused) = (self.options.quantity, super::trial::refused);
        Ok(self.structure.varied(quantity, value).map_err(|mistake| refused(quantity, value, &mistake))?)
    }

    /// Its models, the planar one too where it is asked for.
    fn shaken(
        &self,
        trials: &mut Trials<'_>,
        (frame, structure): (&OwnFrame, &Structure),
        levels: &FrameLevels,
        with_planar: bool,
    ) -> Result<(FrameReport, Vec<TargetFrameModel>), DesignError> {
        let peaks = trials.shake(frame, levels, with_planar)?;
        let threshold_m = match self.options.event() {
            TargetEvent::Overturning => None,
            TargetEvent::BeyondCapacity(factor) => structure.system.capacity_m().map(|own_m| own_m / factor),
            TargetEvent::Beyond(displacement_m) => Some(displacement_m),
        };
        let (hazard, scatter) = self.of_records;
        let question = FrameQuestion {
            levels,
            place: self.place,
            weights: &SiteWeights::Alike(hazard.mean),
            hazard,
            scatter,
            target_per_year: self.target_per_year,
            years: self.years,
            capacity_m: threshold_m,
            safety_factor: 1.0,
            limit: frame.limit.filter(|_| threshold_m.is_none()),
            proxy_beyond_limit: None,
        };
        let report = question.answer(&peaks)?;
        let of = |model: &FrameModel| TargetFrameModel::from_model(model, threshold_m, self.target_per_year);
        let models = report.models.iter().map(of).collect();
        Ok((report, models))
    }

    /// The next value to try; none where the first is safe, where the last that is not lies near enough to the next,
    /// and where the largest is not.
    fn next(&self, tried: &[(f64, TargetFrameModel)], most: f64) -> Option<f64> {
        let rates: Vec<(f64, f64)> = tried.iter().map(|(value, of)| (*value, of.upper_per_year())).collect();
        let next = next_value(&rates, self.target_per_year, self.options.tolerance.max(NEAR))?.min(most);
        let next = rounded_up(next, digits(self.options.tolerance)).min(most);
        tried.iter().all(|(value, _)| value.total_cmp(&next).is_ne()).then_some(next)
    }
}

/// Why a frame is left out where strength or capacity vary.
pub(super) const NO_COLUMNS: &str =
    "strength and capacity follow from the size of the columns: vary width, size or tendon-stiffness";

/// The value to try after those of these upper limits, `(value, 1/yr)`, ascending; none where enough are tried.
fn next_value(rates: &[(f64, f64)], target_per_year: f64, near: f64) -> Option<f64> {
    let line = |[(a, rate_a), (b, rate_b)]: [(f64, f64); 2]| {
        let slope = (rate_b / rate_a).ln() / (b / a).ln();
        let value = a * ((target_per_year / rate_a).ln() / slope).exp();
        (slope < 0.0 && value.is_finite()).then_some(value)
    };
    match least(rates, |rate| *rate <= target_per_year) {
        Some(0) => None,
        Some(at) => {
            let [missed, safe] = [rates[at - 1], rates[at]];
            let [from, to] = [missed.0 * (1.0 + near), safe.0 / (1.0 + near)];
            if from > to {
                let is_near = safe.0 <= missed.0 * (1.0 + near);
                return (!is_near).then(|| (missed.0 * safe.0).sqrt());
            }
            Some(line([missed, safe]).unwrap_or_else(|| (from * to).sqrt()).clamp(from, to))
        }
        None => {
            let last = *rates.last()?;
            let before = rates.len().checked_sub(2).map(|at| rates[at]);
            let guess = before.and_then(|before| line([before, last]));
            // a little further than the line goes, so that the target lies between
            let guess = guess.map_or(f64::INFINITY, |value| value * (1.0 + 0.5 * near));
            let [least, most] = STEPS.map(|step| step * last.0);
            Some(if before.is_none() { (least * most).sqrt() } else { guess.clamp(least, most) })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values of a search from 1 on, and how many there are.
    fn searched(rate: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let mut rates = vec![(1.0, rate(1.0))];
        while let Some(next) = next_value(&rates, 1e-4, 0.02).filter(|_| rates.len() < MOST_VALUES) {
            rates.push((next, rate(next)));
            rates.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        rates
    }

    #[test]
    fn few_values_find_the_safe_one() {
        // a power, one that bends, and steps
        let power = |value: f64| 3e-4 * value.powi(-3);
        let bends = |value: f64| 2e-3 * (-1.5 * value).exp();
        let steps = |value: f64| (1e5 * power(value)).ceil() / 1e5;
        for rate in [&power as &dyn Fn(f64) -> f64, &bends, &steps] {
            let rates = searched(rate);
            let at = least(&rates, |rate| *rate <= 1e-4).unwrap();
            let [missed, safe] = [rates[at - 1].0, rates[at].0];
            assert!(safe <= 1.0201 * missed && rates.len() <= MOST_VALUES, "{rates:?}");
        }
        assert_eq!(searched(|_| 9e-5).len(), 1);
    }

    #[test]
    fn a_rate_that_does_not_fall_is_followed_by_steps() {
        let rates = searched(|_| 2e-4);
        assert_eq!(rates.len(), MOST_VALUES);
        assert!(rates.windows(2).all(|pair| pair[1].0 > pair[0].0));
        // none seen is a rate, too
        let rates = searched(|value| if value < 1.3 { 2e-4 } else { 0.0 });
        assert!(least(&rates, |rate| *rate <= 1e-4).is_some_and(|at| rates[at].0 < 1.35), "{rates:?}");
    }
}
