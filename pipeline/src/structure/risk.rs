//! A structure under the records of a study: how often it goes too far.

use serde::Serialize;
use uplift_fragility::Stripes as Stripe;
use uplift_hazard::probability_from_rate;
use uplift_risk::{PooledDemand, StripeWeights};

use super::weights::SiteWeights;
use crate::error::UpliftError;
use crate::uniform_risk::{Stripes, pooled_demand};

/// How often something happens to a structure at a site.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EventRisk {
    /// Mean annual frequency, 1/yr (Eq. 4.4).
    pub per_year: f64,
    /// Probability that it happens within the years of the study, 0 to 1 (Eq. 4.8 inverted).
    pub probability: f64,
    /// Share of the frequency that comes from below the first stripe, 0 to 1; 0 where it never happens.
    pub lower_tail_share: f64,
    /// Share of the frequency that comes from above the last stripe, 0 to 1; 0 where it never happens.
    pub upper_tail_share: f64,
    /// Where no run shows what may happen: the frequency that it has at most, 1/yr (docs/method.md, section 17). None
    /// where some run does, or where it cannot happen.
    pub at_most_per_year: Option<f64>,
}

impl EventRisk {
    /// From the shares and their sum, both 1/yr.
    ///
    /// # Errors
    /// Numbers that are no rate and no time, which the checks of study and inputs rule out.
    pub(super) fn new(per_year: f64, [lower_tail, upper_tail]: [f64; 2], years: f64) -> Result<Self, UpliftError> {
        let share = |tail: f64| if per_year > 0.0 { (tail / per_year).min(1.0) } else { 0.0 };
        let probability = probability_from_rate(per_year, years)?;
        let (lower_tail_share, upper_tail_share) = (share(lower_tail), share(upper_tail));
        Ok(Self { per_year, probability, lower_tail_share, upper_tail_share, at_most_per_year: None })
    }

    /// The same of something that may happen, though no run may show it of `pairs`, each with the positions of its
    /// records.
    pub(super) fn bounded(self, weights: &SiteWeights<'_>, pairs: &[Vec<usize>]) -> Self {
        let bound = || at_most_per_year(weights.stripes(), weights.effective_pairs(pairs));
        let at_most_per_year = (self.per_year == 0.0).then(bound);
        Self { at_most_per_year, ..self }
    }
}

/// Confidence of the bound on the share of motions at the last level.
pub(crate) const BOUND_CONFIDENCE: f64 = 0.95;

/// The share of all motions that may do what none of so many pairs did, with [`BOUND_CONFIDENCE`]: nearly 3/N.
pub(crate) fn share_at_most(pairs: f64) -> f64 {
    1.0 - (1.0 - BOUND_CONFIDENCE).powf(1.0 / pairs)
}

/// The frequency that something has at most which no run shows, 1/yr: all motions stronger than the last level do it,
/// and at that level the share that so many pairs leave open; from the level before it on that share grows from zero
/// as a fragility between stripes does (Eq. 4.4).
pub(super) fn at_most_per_year(weights: &StripeWeights, pairs: f64) -> f64 {
    let beyond = weights.upper_tail_per_year();
    let last = weights.per_year().last().copied().unwrap_or(beyond);
    beyond + share_at_most(pairs) * (last - beyond)
}

/// A threshold that nothing but overturning exceeds.
pub(super) const OVERTURNING_M: f64 = f64::MAX;

/// The risk of exceeding `threshold_m`.
///
/// # Errors
/// Stripes and weights of different levels; a threshold that is none.
pub(super) fn risk_of_exceeding(
    demand: &PooledDemand,
    weights: &SiteWeights<'_>,
    threshold_m: f64,
    years: f64,
) -> Result<EventRisk, UpliftError> {
    let curve = weights.curve(demand)?;
    let per_year = curve.mean_annual_frequency(threshold_m)?;
    let parts = curve.disaggregation(threshold_m)?;
    EventRisk::new(per_year, [parts.lower_tail_per_year, parts.upper_tail_per_year], years)
}

/// Between what happens and what does not, where runs are told by 1 and 0.
pub(super) const HAPPENS: f64 = 0.5;

/// Runs told by 1 where they exceed their threshold, m, and by 0 where not: what goes beyond [`HAPPENS`] is what
/// happens.
///
/// * `runs` — over the levels, each with its threshold
///
/// # Errors
/// Runs of another number of levels.
pub(super) fn happenings<'a>(
    levels: &[f64],
    runs: impl Iterator<Item = (&'a [f64], f64)>,
) -> Result<PooledDemand, UpliftError> {
    let tell = |(row_m, threshold_m): (&'a [f64], f64)| {
        row_m.iter().map(move |&peak_m| if peak_m > threshold_m { 1.0 } else { 0.0 })
    };
    let told: Vec<f64> = runs.flat_map(tell).collect();
    Ok(PooledDemand::new(&Stripe::new(levels, &told)?)?)
}

/// All demands of one oscillator of `stripes`, sorted.
///
/// # Errors
/// None for stripes that were computed.
pub(super) fn demand_of(stripes: &Stripes, oscillator: usize) -> Result<PooledDemand, UpliftError> {
    pooled_demand(stripes, oscillator)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn what_no_run_shows_has_a_bound_all_the_same() {
        // 1 − 0.05^(1/N), that is some 3/N
        assert!((share_at_most(1.0) - 0.95).abs() < 1e-12);
        assert!((share_at_most(300.0) * 300.0 - 3.0).abs() < 0.02);
        // rates 1, 0.5, 0.25: all beyond the last level, and 0.95 of half the last interval for a single record
        let weights = StripeWeights::new(&[1.0, 0.5, 0.25], None).unwrap();
        let none = EventRisk::new(0.0, [0.0, 0.0], 50.0).unwrap();
        let weights = SiteWeights::Alike(&weights);
        let bound = none.bounded(&weights, &[vec![0]]).at_most_per_year.unwrap();
        assert!((bound - (0.25 + 0.95 * 0.125)).abs() < 1e-12, "{bound}");
        // both components of the same pair leave as much open
        assert_eq!(none.bounded(&weights, &[vec![0, 1]]).at_most_per_year, Some(bound));
        let some = EventRisk::new(1e-3, [0.0, 0.0], 50.0).unwrap();
        assert_eq!(some.bounded(&weights, &[vec![0]]).at_most_per_year, None);
    }
}
