//! Annual rate and probability of exceedance in a period (Eq. 4.8).

use crate::error::{HazardError, check_positive};

/// Annual rate, 1/yr, of an event that has `probability` of occurring within `years`: −ln(1 − P)/T (Eq. 4.8).
///
/// Exact for small probabilities, where 1 − P would lose digits.
///
/// # Errors
/// [`HazardError::Argument`] unless 0 < `probability` < 1 and `years` is finite and above 0.
pub fn rate_from_probability(probability: f64, years: f64) -> Result<f64, HazardError> {
    check_positive("period [yr]", years)?;
    if probability > 0.0 && probability < 1.0 {
        return Ok(rate_of(probability, years));
    }
    Err(HazardError::Argument { what: "probability of exceedance", value: probability, must_be: "above 0 and below 1" })
}

/// −ln(1 − P)/T of a valid probability and period.
pub(crate) fn rate_of(probability: f64, years: f64) -> f64 {
    -(-probability).ln_1p() / years
}

/// Return period, years, of an event that has `probability` of occurring within `years`: 1/λ (Eq. 4.8).
///
/// Whole years stay whole: a probability that was computed from them is off by a rounding.
///
/// # Errors
/// As [`rate_from_probability`].
pub fn return_period_from_probability(probability: f64, years: f64) -> Result<f64, HazardError> {
    let period_years = 1.0 / rate_from_probability(probability, years)?;
    let whole = period_years.round();
    Ok(if (period_years - whole).abs() < 1e-12 * whole { whole } else { period_years })
}

/// Probability of at least one event within `years` at an annual `rate`, 1/yr: 1 − exp(−λT) (Eq. 4.8 inverted).
///
/// # Errors
/// [`HazardError::Argument`] unless `rate` is finite and not negative and `years` is finite and above 0.
pub fn probability_from_rate(rate: f64, years: f64) -> Result<f64, HazardError> {
    check_positive("period [yr]", years)?;
    if rate.is_finite() && rate >= 0.0 {
        return Ok(-(-rate * years).exp_m1());
    }
    Err(HazardError::Argument { what: "annual rate [1/yr]", value: rate, must_be: "a finite number, 0 or above" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Section 4.3.4 prints 0.0004, 0.0021 and 0.0139; these are the same with more digits.
    #[test]
    fn rates_of_the_three_probabilities() {
        for (probability, rate) in [(0.02, 0.000_404_05), (0.10, 0.002_107_21), (0.50, 0.013_862_94)] {
            assert!((rate_from_probability(probability, 50.0).unwrap() - rate).abs() < 5e-9);
        }
        // ln 2 / 50, exactly rounded
        assert_eq!(rate_from_probability(0.5, 50.0).unwrap(), std::f64::consts::LN_2 / 50.0);
    }

    #[test]
    fn small_probabilities_keep_their_digits() {
        assert_eq!(rate_from_probability(1e-20, 1.0).unwrap(), 1e-20);
        assert_eq!(probability_from_rate(1e-20, 1.0).unwrap(), 1e-20);
        assert_eq!(probability_from_rate(0.0, 50.0).unwrap(), 0.0);
        for period_years in [72.0, 475.0, 2475.0, 100_000.0] {
            let probability = probability_from_rate(1.0 / period_years, 50.0).unwrap();
            assert_eq!(return_period_from_probability(probability, 50.0).unwrap(), period_years);
        }
        assert!((return_period_from_probability(0.02, 50.0).unwrap() - 2_474.915_8).abs() < 1e-4);
    }

    #[test]
    fn refused_arguments() {
        for p in [0.0, 1.0, -0.1, 1.1, f64::NAN, f64::INFINITY] {
            assert!(rate_from_probability(p, 50.0).is_err(), "{p}");
        }
        for years in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(rate_from_probability(0.1, years).is_err());
            assert!(probability_from_rate(0.1, years).is_err());
        }
        for rate in [-1e-9, f64::NAN, f64::INFINITY] {
            assert!(probability_from_rate(rate, 50.0).is_err());
        }
        let message = rate_from_probability(1.0, 50.0).unwrap_err().to_string();
        assert_eq!(message, "probability of exceedance is 1, it must be above 0 and below 1");
    }

    proptest! {
        #[test]
        fn round_trip(p in 1e-12..0.99_f64, years in 0.1..1000.0_f64) {
            let back = probability_from_rate(rate_from_probability(p, years)?, years)?;
            prop_assert!((back / p - 1.0).abs() < 1e-13);
        }

        #[test]
        fn rates_grow_with_the_probability(p in 1e-12..0.98_f64, step in 1e-6..0.01_f64) {
            prop_assert!(rate_from_probability(p, 50.0)? < rate_from_probability(p + step, 50.0)?);
        }
    }
}
