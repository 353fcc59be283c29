//! Distances of two distributions in the unit of their values.

use crate::sample::{Sample, distinct};

/// Wasserstein's distance `∫|F − G| dx`, in the unit of the values; none with infinite values.
pub fn wasserstein_distance(one: &Sample, other: &Sample) -> Option<f64> {
    integral(one, other, f64::abs)
}

/// Energy distance `√(2 ∫(F − G)² dx)`, in the square root of the unit of the values; none with infinite values.
///
/// # Source
/// G. J. Székely and M. L. Rizzo (2013), "Energy statistics".
pub fn energy_distance(one: &Sample, other: &Sample) -> Option<f64> {
    integral(one, other, |difference| difference * difference).map(|integral| (2.0 * integral).sqrt())
}

fn integral(one: &Sample, other: &Sample, of: impl Fn(f64) -> f64) -> Option<f64> {
    if !(one.is_finite() && other.is_finite()) {
        return None;
    }
    let values = distinct(one, other);
    Some(values.windows(2).map(|ends| of(one.cdf(ends[0].0) - other.cdf(ends[0].0)) * (ends[1].0 - ends[0].0)).sum())
}
