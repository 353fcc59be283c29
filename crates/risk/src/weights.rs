//! What a site's hazard makes of each stripe: Eq. 4.4 by the trapezoid rule.

use uplift_fragility::{Stripes, exceedance_probabilities};
use uplift_hazard::{Extrapolation, HazardCurve};

use crate::fixed_point::{self, MAX_RATE_PER_YEAR, quanta};
use crate::{Disaggregation, RiskError, check_count};

/// The weight of each stripe in the risk integral of one site, 1/yr.
///
/// The fragility P is linear in the hazard rate λ between stripes, so Eq. 4.4 becomes
/// λ(c) = Σ ½ (Pᵢ + Pᵢ₊₁)(λᵢ − λᵢ₊₁) + ½ P₁ (λ₀ − λ₁) + Pₘ λₘ = Σ wⱼ Pⱼ.
///
/// The second term is the lower tail: below the first stripe P falls linearly to 0 at the first abscissa of the hazard
/// curve, of rate λ₀. The third is the upper tail: above the last stripe P stays as it is there.
#[derive(Debug, Clone, PartialEq)]
pub struct StripeWeights {
    /// λ at the stripes, 1/yr.
    rates: Vec<f64>,
    /// λ₀ at the first abscissa, 1/yr; the first stripe's own rate where there is no lower tail.
    first_abscissa_rate: f64,
    /// Total weights, in quanta.
    quanta: Vec<u128>,
}

impl StripeWeights {
    /// From the hazard rates alone.
    ///
    /// - `rates_per_year`: hazard rate at each stripe level, 1/yr, `[level]`, in the order of increasing levels.
    /// - `first_abscissa_rate_per_year`: hazard rate at the first abscissa of the curve; `None` where the first stripe
    ///   lies at or below it, which leaves no lower tail.
    ///
    /// # Errors
    /// No rate; a rate that is not positive, above 2²⁰ per year, or rises with the level.
    pub fn new(rates_per_year: &[f64], first_abscissa_rate_per_year: Option<f64>) -> Result<Self, RiskError> {
        let &[first, ..] = rates_per_year else {
            return Err(RiskError::NoLevels);
        };
        let mut ceiling = MAX_RATE_PER_YEAR;
        for (index, &rate) in rates_per_year.iter().enumerate() {
            if !(rate > 0.0 && rate <= ceiling) {
                return Err(RiskError::Rate { index, rate });
            }
            ceiling = rate;
        }
        let foot = first_abscissa_rate_per_year.unwrap_or(first);
        if !(first..=MAX_RATE_PER_YEAR).contains(&foot) {
            return Err(RiskError::FirstAbscissaRate { rate: foot, first_stripe: first });
        }
        // wⱼ = ½ (λⱼ₋₁ − λⱼ₊₁), with λ₀ before the first stripe; the last one has ½ (λₘ₋₁ − λₘ) + λₘ.
        let exact: Vec<u128> = rates_per_year.iter().map(|&rate| quanta(rate)).collect();
        let mut before = quanta(foot);
        let mut weights = Vec::with_capacity(exact.len());
        for (index, &rate) in exact.iter().enumerate() {
            weights.push(exact.get(index + 1).map_or_else(|| before.midpoint(rate), |after| (before - after) / 2));
            before = rate;
        }
        Ok(Self { rates: rates_per_year.to_vec(), first_abscissa_rate: foot, quanta: weights })
    }

    /// From a site's hazard curve, read at the stripe levels.
    ///
    /// - `curve`: hazard of the same intensity measure, in the unit of `levels`.
    /// - `levels`: stripe levels, strictly increasing, `[level]`.
    /// - `extrapolation`: what to do with a stripe outside the curve. With [`Extrapolation::LogLog`] a first stripe
    ///   below the first abscissa has no lower tail.
    ///
    /// # Errors
    /// A stripe outside the curve under [`Extrapolation::Refuse`]; otherwise as [`StripeWeights::new`].
    pub fn from_hazard(curve: &HazardCurve, levels: &[f64], extrapolation: Extrapolation) -> Result<Self, RiskError> {
        let rates = levels
            .iter()
            .map(|&level| curve.rate_at_extrapolated(level, extrapolation))
            .collect::<Result<Vec<_>, _>>()?;
        let foot = curve.first();
        let has_lower_tail = levels.first().is_some_and(|&level| level > foot.im);
        Self::new(&rates, has_lower_tail.then_some(foot.maf))
    }

    /// The weights where only the stripes at these `places` are analysed: an interval between two of them has the rates
    /// of all that lie in it.
    ///
    /// # Errors
    /// No place, or places that do not ascend.
    pub fn at_levels(&self, places: &[usize]) -> Result<Self, RiskError> {
        let rates: Vec<f64> = places.iter().filter_map(|&place| self.rates.get(place).copied()).collect();
        Self::new(&rates, Some(self.first_abscissa_rate))
    }

    /// Number of stripe levels.
    pub fn level_count(&self) -> usize {
        self.rates.len()
    }

    /// Hazard rate at each stripe, 1/yr, `[level]`.
    pub fn rates_per_year(&self) -> &[f64] {
        &self.rates
    }

    /// Total weight of each stripe, tails included, 1/yr, `[level]`.
    pub fn per_year(&self) -> Vec<f64> {
        self.quanta.iter().map(|&weight| fixed_point::rate_per_year(weight, 1)).collect()
    }

    /// The part of the first stripe's weight that lies below it, ½ (λ₀ − λ₁), 1/yr.
    pub fn lower_tail_per_year(&self) -> f64 {
        0.5 * (self.first_abscissa_rate - self.rates[0])
    }

    /// The part of the last stripe's weight that lies above it, λₘ, 1/yr.
    pub fn upper_tail_per_year(&self) -> f64 {
        self.rates[self.rates.len() - 1]
    }

    /// Where the risk of any fragility comes from: between which stripes, and from which tail.
    ///
    /// - `probabilities`: P(EDP > c | level), empirical or fitted, `[level]`.
    ///
    /// # Errors
    /// A number of probabilities other than the number of levels, or one outside 0 to 1.
    pub fn disaggregate(&self, probabilities: &[f64]) -> Result<Disaggregation, RiskError> {
        let levels = self.level_count();
        check_count("probabilities of exceedance", probabilities.len(), levels)?;
        for (index, &probability) in probabilities.iter().enumerate() {
            if !(0.0..=1.0).contains(&probability) {
                return Err(RiskError::Probability { index, probability });
            }
        }
        let intervals = probabilities
            .windows(2)
            .zip(self.rates.windows(2))
            .map(|(p, rate)| 0.5 * (p[0] + p[1]) * (rate[0] - rate[1]))
            .collect();
        Ok(Disaggregation {
            lower_tail_per_year: probabilities[0] * self.lower_tail_per_year(),
            intervals_per_year: intervals,
            upper_tail_per_year: probabilities[levels - 1] * self.upper_tail_per_year(),
        })
    }

    /// Total weights in quanta, `[level]`.
    pub(crate) fn quanta(&self) -> &[u128] {
        &self.quanta
    }
}

/// Mean annual frequency of exceeding `threshold_m`, 1/yr: Eq. 4.7 put into Eq. 4.4, term by term.
///
/// The plain form, for one threshold; [`RiskCurve`](crate::RiskCurve) answers many.
///
/// # Errors
/// Stripes and weights with different numbers of levels; a threshold that is negative or not finite.
pub fn mean_annual_frequency(stripes: &Stripes, weights: &StripeWeights, threshold_m: f64) -> Result<f64, RiskError> {
    let probabilities = exceedance_probabilities(stripes, threshold_m)?;
    Ok(weights.disaggregate(&probabilities)?.total_per_year())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewer_stripes_keep_the_rates_between_them() {
        // without the middle one: w₁ = ½(0.5 − 0.125) + ½(1 − 0.5), w₃ = ½(0.5 − 0.125) + 0.125
        let weights = StripeWeights::new(&[0.5, 0.25, 0.125], Some(1.0)).unwrap().at_levels(&[0, 2]).unwrap();
        assert_eq!(weights.per_year(), [0.4375, 0.3125]);
        assert_eq!(weights.at_levels(&[0, 1]).unwrap(), weights);
        assert!(weights.at_levels(&[]).is_err() && weights.at_levels(&[1, 0]).is_err());
    }

    #[test]
    fn weights_of_three_stripes_by_hand() {
        // λ₀ = 1, λ = 0.5, 0.25, 0.125:
        // w₁ = ½(0.5 − 0.25) + ½(1 − 0.5) = 0.125 + 0.25; w₂ = ½(0.5 − 0.125); w₃ = ½(0.25 − 0.125) + 0.125.
        let weights = StripeWeights::new(&[0.5, 0.25, 0.125], Some(1.0)).unwrap();
        assert_eq!(weights.per_year(), [0.375, 0.1875, 0.1875]);
        assert_eq!(weights.lower_tail_per_year(), 0.25);
        assert_eq!(weights.upper_tail_per_year(), 0.125);
        // One stripe: nothing but tails, ½ (1 − 0.5) + 0.5.
        assert_eq!(StripeWeights::new(&[0.5], Some(1.0)).unwrap().per_year(), [0.75]);
        assert_eq!(StripeWeights::new(&[0.5], None).unwrap().per_year(), [0.5]);
    }

    #[test]
    fn refuses_rates_that_are_no_hazard() {
        assert_eq!(StripeWeights::new(&[], None).unwrap_err(), RiskError::NoLevels);
        for (rates, index) in [([0.1, 0.2], 1), ([0.1, 0.0], 1), ([-0.1, -0.2], 0), ([f64::INFINITY, 1.0], 0)] {
            assert_eq!(StripeWeights::new(&rates, None).unwrap_err(), RiskError::Rate { index, rate: rates[index] });
        }
        assert!(matches!(StripeWeights::new(&[0.1, f64::NAN], None), Err(RiskError::Rate { index: 1, .. })));
        for foot in [0.05, f64::NAN, 2e6] {
            let error = StripeWeights::new(&[0.1], Some(foot)).unwrap_err();
            assert!(matches!(error, RiskError::FirstAbscissaRate { .. }));
        }
    }

    #[test]
    fn a_stripe_outside_the_curve_is_refused_or_extrapolated_never_ignored() {
        // λ = 1/im² on [1, 8].
        let curve = HazardCurve::new("PGV", "cm/s", "", vec![1.0, 8.0], vec![1.0, 1.0 / 64.0]).unwrap();
        let refuse = |levels: &[f64]| StripeWeights::from_hazard(&curve, levels, Extrapolation::Refuse);
        let loglog = |levels: &[f64]| StripeWeights::from_hazard(&curve, levels, Extrapolation::LogLog).unwrap();
        assert!(matches!(refuse(&[0.5, 2.0]), Err(RiskError::Hazard(_))));
        assert!(matches!(refuse(&[2.0, 16.0]), Err(RiskError::Hazard(_))));

        let inside = refuse(&[2.0, 4.0]).unwrap();
        assert_eq!(inside, loglog(&[2.0, 4.0]));
        assert!((inside.rates_per_year()[0] - 0.25).abs() < 1e-15);
        assert!((inside.lower_tail_per_year() - 0.375).abs() < 1e-15);

        // At the first abscissa the lower tail is empty; below it there is none.
        assert_eq!(refuse(&[1.0, 4.0]).unwrap().lower_tail_per_year(), 0.0);
        let below = loglog(&[0.5, 16.0]);
        assert_eq!(below.lower_tail_per_year(), 0.0);
        assert!((below.rates_per_year()[0] - 4.0).abs() < 1e-14);
        assert!((below.upper_tail_per_year() - 1.0 / 256.0).abs() < 1e-16);
    }

    #[test]
    fn refuses_probabilities_that_are_none() {
        let weights = StripeWeights::new(&[0.5, 0.25], None).unwrap();
        assert!(matches!(weights.disaggregate(&[0.5]), Err(RiskError::Count { found: 1, expected: 2, .. })));
        for bad in [-0.1, 1.1, f64::NAN] {
            assert!(matches!(weights.disaggregate(&[0.5, bad]), Err(RiskError::Probability { index: 1, .. })));
        }
    }
}
