//! Quantiles of samples that may hold zeros and infinities.

/// The quantile of `sorted` values at `probability`: linear between order statistics, at position `p (n − 1)` from 0.
///
/// That is the definition of numpy, R (type 7) and Excel (`PERCENTILE.INC`). An infinite value next to it makes the
/// quantile infinite, unless it falls on a finite value exactly. NaN where there is no value.
pub fn quantile(sorted: &[f64], probability: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let position = probability.clamp(0.0, 1.0) * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and the last index")]
    let index = (position as usize).min(last);
    let (below, above) = (sorted[index], sorted[(index + 1).min(last)]);
    let part = position - index as f64;
    // also where both are infinite, whose difference is NaN
    if part == 0.0 || below == above { below } else { below + part * (above - below) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_between_order_statistics() {
        // numpy.quantile([1, 2, 4, 8], [0, 0.05, 0.5, 0.95, 1]) by hand: positions 0, 0.15, 1.5, 2.85, 3
        let sorted = [1.0, 2.0, 4.0, 8.0];
        for (probability, expected) in [(0.0, 1.0), (0.05, 1.15), (0.5, 3.0), (0.95, 7.4), (1.0, 8.0)] {
            assert!((quantile(&sorted, probability) - expected).abs() < 1e-14);
        }
        assert_eq!(quantile(&[3.0], 0.9), 3.0);
        assert!(quantile(&[], 0.5).is_nan());
    }

    #[test]
    fn infinity_is_a_value_like_any_other() {
        let inf = f64::INFINITY;
        let sorted = [0.0, 1.0, inf, inf, inf];
        assert_eq!(quantile(&sorted, 0.25), 1.0);
        assert_eq!(quantile(&sorted, 0.3), inf);
        assert_eq!(quantile(&sorted, 0.9), inf);
    }
}
