//! How often something happens to a structure, and how often it may where no run shows it.

use serde::Serialize;
use uplift_hazard::{HazardError, probability_from_rate};

use crate::ordinate::TAIL_SHARE_LIMIT;
use crate::weights::StripeWeights;

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
    pub fn new(per_year: f64, [lower_tail, upper_tail]: [f64; 2], years: f64) -> Result<Self, HazardError> {
        let share = |tail: f64| if per_year > 0.0 { (tail / per_year).min(1.0) } else { 0.0 };
        let probability = probability_from_rate(per_year, years)?;
        let (lower_tail_share, upper_tail_share) = (share(lower_tail), share(upper_tail));
        Ok(Self { per_year, probability, lower_tail_share, upper_tail_share, at_most_per_year: None })
    }

    /// The larger of both shares outside the levels, and what it does to the rate: `rate too low (3 % of the risk lies
    /// above the last level, 200 cm/s)`; none where the rate is off by at most a tenth, since bands of 105 records are
    /// wider, or the share is at most [`TAIL_SHARE_LIMIT`].
    ///
    /// - `levels`: the first and the last, in `unit`.
    /// - `beyond_per_year`: how often motions are stronger than the last level, 1/yr; infinite where it is not known.
    /// - `in_words`: a share in words.
    pub fn outside_levels(
        &self,
        (first, last): (f64, f64),
        unit: &str,
        beyond_per_year: f64,
        in_words: impl Fn(f64) -> String,
    ) -> Option<(f64, String)> {
        let (share, most_off, error, beyond) = if self.upper_tail_share >= self.lower_tail_share {
            // all motions above the last level may do what a share of those at it do
            let most_off = beyond_per_year / self.per_year - self.upper_tail_share;
            (self.upper_tail_share, most_off, "too low", format!("above the last level, {last}"))
        } else {
            let share = self.lower_tail_share;
            (share, share, "too high", format!("below the first level, {first}"))
        };
        let told = || format!("rate {error} ({} of the risk lies {beyond} {unit})", in_words(share));
        (share > TAIL_SHARE_LIMIT && most_off > WITHIN_BAND).then(|| (share, told()))
    }
}

/// By how much of itself a rate may be off before that is told.
const WITHIN_BAND: f64 = 0.1;

/// Confidence of the bound on the share of motions at the last level.
pub const BOUND_CONFIDENCE: f64 = 0.95;

/// The share of all motions that may do what none of so many pairs did, with [`BOUND_CONFIDENCE`]: nearly 3/N.
pub fn share_at_most(pairs: f64) -> f64 {
    1.0 - (1.0 - BOUND_CONFIDENCE).powf(1.0 / pairs)
}

/// The frequency that something has at most which no run shows, 1/yr: all motions stronger than the last level do it,
/// and at that level the share that so many pairs leave open; from the level before it on that share grows from zero
/// as a fragility between stripes does (Eq. 4.4).
pub fn at_most_per_year(weights: &StripeWeights, pairs: f64) -> f64 {
    let beyond = weights.upper_tail_per_year();
    let last = weights.per_year().last().copied().unwrap_or(beyond);
    beyond + share_at_most(pairs) * (last - beyond)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(lower_tail_share: f64, upper_tail_share: f64, share_at_last_level: f64) -> Option<(f64, String)> {
        let per_year = 1e-5;
        let risk =
            EventRisk { per_year, probability: 5e-4, lower_tail_share, upper_tail_share, at_most_per_year: None };
        let beyond_per_year = upper_tail_share * per_year / share_at_last_level;
        risk.outside_levels((1.0, 200.0), "cm/s", beyond_per_year, |share| format!("{:.1} %", 100.0 * share))
    }

    #[test]
    fn what_a_band_holds_is_not_told() {
        // a third of the records do it at the last level: with all motions above it the rate would rise by 3 %
        let of_last = [1.0, 0.35, 0.02].map(|share| told(0.0, 0.016, share).map(|(share, _)| share));
        assert_eq!(of_last, [None, None, Some(0.016)]);
        assert_eq!(told(0.08, 0.0, 1.0), None);
    }

    #[test]
    fn the_larger_share_says_which_way_the_rate_is_wrong() {
        let above = "rate too low (30.0 % of the risk lies above the last level, 200 cm/s)".to_owned();
        assert_eq!(told(0.02, 0.3, 0.5), Some((0.3, above)));
        let below = "rate too high (50.0 % of the risk lies below the first level, 1 cm/s)".to_owned();
        assert_eq!(told(0.5, 0.3, 0.5), Some((0.5, below)));
    }
}
