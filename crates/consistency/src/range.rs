//! The rates at which two hazard curves and a set of stripes can be compared.

use uplift_hazard::HazardCurve;
use uplift_risk::StripeWeights;

use crate::ConsistencyError;

/// A range is wide enough for a verdict from this ratio of its ends on.
const LEAST_RATIO: f64 = 5.0;

/// What ends the range at its high, frequent end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HighLimit {
    /// 1.5 times the largest target rate: nothing more is asked.
    Target,
    /// Half the rate of the first stripe: below it nothing is shaken.
    FirstStripe,
    /// Half the rate at the first abscissa of the other measure's curve.
    OtherCurve,
}

/// What ends the range at its low, rare end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LowLimit {
    /// A quarter of the smallest target rate: nothing less is asked.
    Target,
    /// Twice the rate of the last stripe: above it nothing is shaken harder.
    LastStripe,
    /// Twice the rate at the last abscissa of the other measure's curve.
    OtherCurve,
}

/// The range of rates, 1/yr, from `high` down to `low`, and what ends it.
///
/// `high = min(1.5 largest target, ½ λ_x(x₁), ½ λ_y at its first abscissa)`,
/// `low = max(¼ smallest target, 2 λ_x(x_m), 2 λ_y at its last abscissa)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RateRange {
    /// The frequent end, 1/yr.
    pub high_per_year: f64,
    /// The rare end, 1/yr.
    pub low_per_year: f64,
    /// What ends it at the frequent end.
    pub high_limit: HighLimit,
    /// What ends it at the rare end.
    pub low_limit: LowLimit,
}

impl RateRange {
    /// The range of an analysis.
    ///
    /// - `targets_per_year`: target rates, 1/yr, in any order.
    /// - `stripes`: hazard of the measure x that the set is scaled to, at the stripes.
    /// - `other`: hazard of the other measure y.
    ///
    /// # Errors
    /// No target, or one that is not positive and finite.
    pub fn new(
        targets_per_year: &[f64],
        stripes: &StripeWeights,
        other: &HazardCurve,
    ) -> Result<Self, ConsistencyError> {
        let (mut largest, mut smallest) = (0.0_f64, f64::INFINITY);
        for &rate in targets_per_year {
            if !(rate.is_finite() && rate > 0.0) {
                return Err(ConsistencyError::Target { rate });
            }
            (largest, smallest) = (largest.max(rate), smallest.min(rate));
        }
        if targets_per_year.is_empty() {
            return Err(ConsistencyError::NoTargets);
        }
        let rates = stripes.rates_per_year();
        let mut high = (1.5 * largest, HighLimit::Target);
        let (first, last) = (rates[0], rates[rates.len() - 1]);
        for (rate, limit) in [(first, HighLimit::FirstStripe), (other.first().maf, HighLimit::OtherCurve)] {
            if 0.5 * rate < high.0 {
                high = (0.5 * rate, limit);
            }
        }
        let mut low = (0.25 * smallest, LowLimit::Target);
        for (rate, limit) in [(last, LowLimit::LastStripe), (other.last().maf, LowLimit::OtherCurve)] {
            if 2.0 * rate > low.0 {
                low = (2.0 * rate, limit);
            }
        }
        Ok(Self { high_per_year: high.0, low_per_year: low.0, high_limit: high.1, low_limit: low.1 })
    }

    /// Whether it is wide enough for a verdict, and for a repair: `high ≥ 5 low`.
    pub fn is_wide(&self) -> bool {
        self.high_per_year >= LEAST_RATIO * self.low_per_year
    }

    /// Whether `rate_per_year` lies in it, ends included.
    pub fn contains(&self, rate_per_year: f64) -> bool {
        (self.low_per_year..=self.high_per_year).contains(&rate_per_year)
    }

    /// `N` rates over it, 1/yr, falling, at equal ratios, ends included.
    pub fn rates<const N: usize>(&self) -> [f64; N] {
        let ln_ratio = (self.low_per_year / self.high_per_year).ln();
        std::array::from_fn(|index| match index {
            0 => self.high_per_year,
            _ if index + 1 == N => self.low_per_year,
            _ => self.high_per_year * (ln_ratio * index as f64 / (N - 1) as f64).exp(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_term_can_end_the_range() {
        // λ_y from 1 to 1e-6
        let other = HazardCurve::new("PGA", "g", "", vec![0.001, 1.0], vec![1.0, 1e-6]).unwrap();
        let range = |rates: &[f64], targets: &[f64]| {
            RateRange::new(targets, &StripeWeights::new(rates, None).unwrap(), &other).unwrap()
        };
        let usual = range(&[0.5, 1e-5], &[0.01, 0.001]);
        assert_eq!((usual.high_per_year, usual.high_limit), (0.015, HighLimit::Target));
        assert_eq!((usual.low_per_year, usual.low_limit), (0.000_25, LowLimit::Target));
        assert!(usual.is_wide() && usual.contains(0.015) && !usual.contains(0.016));
        let stripes = range(&[0.02, 0.004], &[0.01, 0.001]);
        assert_eq!((stripes.high_per_year, stripes.high_limit), (0.01, HighLimit::FirstStripe));
        assert_eq!((stripes.low_per_year, stripes.low_limit), (0.008, LowLimit::LastStripe));
        assert!(!stripes.is_wide());
        let curve = range(&[2.0, 1e-8], &[0.9, 1e-6]);
        assert_eq!((curve.high_per_year, curve.high_limit), (0.5, HighLimit::OtherCurve));
        assert_eq!((curve.low_per_year, curve.low_limit), (2e-6, LowLimit::OtherCurve));
    }

    #[test]
    fn rates_fall_from_end_to_end_at_equal_ratios() {
        let range = RateRange {
            high_per_year: 1e-2,
            low_per_year: 1e-4,
            high_limit: HighLimit::Target,
            low_limit: LowLimit::Target,
        };
        let rates: [f64; 3] = range.rates();
        assert_eq!((rates[0], rates[2]), (1e-2, 1e-4));
        assert!((rates[1] / 1e-3 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn refuses_targets_that_are_none() {
        let other = HazardCurve::new("PGA", "g", "", vec![0.001, 1.0], vec![1.0, 1e-6]).unwrap();
        let stripes = StripeWeights::new(&[0.1], None).unwrap();
        assert_eq!(RateRange::new(&[], &stripes, &other).unwrap_err(), ConsistencyError::NoTargets);
        for rate in [0.0, -1.0, f64::INFINITY] {
            let error = RateRange::new(&[0.1, rate], &stripes, &other).unwrap_err();
            assert_eq!(error, ConsistencyError::Target { rate });
        }
    }
}
