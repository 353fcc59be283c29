//! How well a fitted fragility agrees with the counts that it was fitted to.

use crate::StripeCount;

/// Agreement of a fragility with counts of exceedance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goodness {
    /// Log-likelihood Σ k ln p + (n − k) ln(1 − p), without the constant binomial coefficients; −∞ where the fragility
    /// excludes what happened.
    pub log_likelihood: f64,
    /// Twice the log-likelihood of the counts themselves less that of the fragility: 0 where all counts are met. The
    /// same records at every level are not independent, so this is no χ² of a test.
    pub deviance: f64,
    /// Largest difference from the counted share at any level.
    pub largest_error: f64,
}

impl Goodness {
    /// Of a fragility with this `probability` at an intensity.
    pub fn from_counts(counts: &[StripeCount], probability: impl Fn(f64) -> f64) -> Self {
        let mut found = Self { log_likelihood: 0.0, deviance: 0.0, largest_error: 0.0 };
        for &StripeCount { level, exceedances, trials } in counts.iter().filter(|count| count.trials > 0) {
            let (k, n) = (f64::from(exceedances), f64::from(trials));
            let likelihood = |p: f64| term(k, p) + term(n - k, 1.0 - p);
            let p = probability(level);
            found.log_likelihood += likelihood(p);
            found.deviance += 2.0 * (likelihood(k / n) - likelihood(p));
            found.largest_error = found.largest_error.max((k / n - p).abs());
        }
        found
    }
}

/// k ln p, which is 0 where k is.
fn term(k: f64, p: f64) -> f64 {
    if k == 0.0 { 0.0 } else { k * p.ln() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_by_hand() {
        let count = |level, exceedances, trials| StripeCount { level, exceedances, trials };
        let counts = [count(1.0, 0, 4), count(2.0, 1, 4), count(3.0, 0, 0), count(4.0, 4, 4)];
        let shares = |level: f64| if level < 2.0 { 0.0 } else { level * level / 16.0 };
        let met = Goodness::from_counts(&counts, shares);
        assert_eq!((met.deviance, met.largest_error), (0.0, 0.0));
        assert!((met.log_likelihood - (0.25_f64.ln() + 3.0 * 0.75_f64.ln())).abs() < 1e-15);
        let half = Goodness::from_counts(&counts, |_| 0.5);
        assert!((half.log_likelihood - 12.0 * 0.5_f64.ln()).abs() < 1e-14);
        assert!((half.deviance - 2.0 * (met.log_likelihood - half.log_likelihood)).abs() < 1e-14);
        assert_eq!(half.largest_error, 0.5);
        assert_eq!(Goodness::from_counts(&counts, |_| 0.0).log_likelihood, f64::NEG_INFINITY);
    }
}
