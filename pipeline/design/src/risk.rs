//! A structure under the records of a study: how often it goes too far.

use uplift_alarms::OwnRisk;
use uplift_fragility::Stripes as Stripe;
use uplift_ida::System;
use uplift_oscillator::Oscillator;
use uplift_risk::{PooledDemand, SiteWeights};
use uplift_uniform_risk::{EventRisk, SpectraOfResult, at_most_per_year};

use crate::error::DesignError;
use crate::opening::Place;

/// The same of something that may happen, though no run may show it of `pairs`, each with the positions of its
/// records.
pub(super) fn bounded(risk: EventRisk, weights: &SiteWeights<'_>, pairs: &[Vec<usize>]) -> EventRisk {
    let bound = || at_most_per_year(weights.stripes(), weights.effective_pairs(pairs));
    let at_most_per_year = (risk.per_year == 0.0).then(bound);
    EventRisk { at_most_per_year, ..risk }
}

/// The risk of an `event` at a `site`, in the form in which alarms look at it; its `pairs` count alike.
pub(super) fn own_risk(
    (event, risk): (&str, EventRisk),
    (site, measure): (&str, &SpectraOfResult),
    (records, pairs): (usize, usize),
) -> OwnRisk {
    let levels = &measure.plan.levels;
    OwnRisk {
        subject: format!("{event} at {site} by {}", measure.measure().label()),
        risk,
        measure: measure.measure(),
        levels: (levels[0], levels[levels.len() - 1]),
        records,
        pairs,
        effective_pairs: pairs as f64,
        beyond_per_year: f64::INFINITY,
    }
}

/// The same of risks at one `place`, where it is known how often motions are stronger than the last level.
pub(super) fn at_place(risks: impl IntoIterator<Item = OwnRisk>, place: Place<'_>) -> Vec<OwnRisk> {
    let beyond_per_year = place.measure.weights[place.site].upper_tail_per_year();
    risks.into_iter().map(|own| OwnRisk { beyond_per_year, ..own }).collect()
}

/// A threshold that nothing but overturning exceeds.
pub(super) const OVERTURNING_M: f64 = f64::MAX;

/// The displacement capacity of a system, m; none of any but an oscillator whose force falls.
pub(super) fn capacity_m(system: &System) -> Option<f64> {
    let System::Oscillator(oscillator) = system else { return None };
    oscillator_capacity_m(oscillator)
}

/// The displacement capacity of an oscillator, m; none where its force does not fall.
pub(super) fn oscillator_capacity_m(oscillator: &Oscillator) -> Option<f64> {
    Some(oscillator.capacity_m()).filter(|capacity_m| capacity_m.is_finite())
}

/// The risk of exceeding `threshold_m`.
pub(super) fn risk_of_exceeding(
    demand: &PooledDemand,
    weights: &SiteWeights<'_>,
    threshold_m: f64,
    years: f64,
) -> Result<EventRisk, DesignError> {
    let curve = weights.curve(demand)?;
    let per_year = curve.mean_annual_frequency(threshold_m)?;
    let parts = curve.disaggregation(threshold_m)?;
    Ok(EventRisk::new(per_year, [parts.lower_tail_per_year, parts.upper_tail_per_year], years)?)
}

/// Between what happens and what does not, where runs are told by 1 and 0.
pub(super) const HAPPENS: f64 = 0.5;

/// Runs told by 1 where they exceed their threshold, m, and by 0 where not: what goes beyond [`HAPPENS`] is what
/// happens.
///
/// * `runs` — over the levels, each with its threshold
pub(super) fn happenings<'a>(
    levels: &[f64],
    runs: impl Iterator<Item = (&'a [f64], f64)>,
) -> Result<PooledDemand, DesignError> {
    let tell = |(row_m, threshold_m): (&'a [f64], f64)| {
        row_m.iter().map(move |&peak_m| if peak_m > threshold_m { 1.0 } else { 0.0 })
    };
    let told: Vec<f64> = runs.flat_map(tell).collect();
    Ok(PooledDemand::new(&Stripe::new(levels, &told)?)?)
}

#[cfg(test)]
mod tests {
    use uplift_risk::StripeWeights;
    use uplift_uniform_risk::share_at_most;

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
        let bound = bounded(none, &weights, &[vec![0]]).at_most_per_year.unwrap();
        assert!((bound - (0.25 + 0.95 * 0.125)).abs() < 1e-12, "{bound}");
        // both components of the same pair leave as much open
        assert_eq!(bounded(none, &weights, &[vec![0, 1]]).at_most_per_year, Some(bound));
        let some = EventRisk::new(1e-3, [0.0, 0.0], 50.0).unwrap();
        assert_eq!(bounded(some, &weights, &[vec![0]]).at_most_per_year, None);
    }
}
