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

/// The quantile at `probability` of (value, weight) pairs sorted by value: linear between the middles of the weights,
/// which run from 0 at the first value to 1 at the last.
///
/// Where all weigh alike that is [`quantile`]. Values without weight do not count; NaN where there is no weight.
pub fn weighted_quantile(pairs: &[(f64, f64)], probability: f64) -> f64 {
    let counting = || pairs.iter().filter(|(_, weight)| *weight > 0.0);
    let (Some(&(first, first_weight)), Some(&(_, last_weight))) = (counting().next(), counting().next_back()) else {
        return f64::NAN;
    };
    let total: f64 = counting().map(|(_, weight)| weight).sum();
    // from the middle of the first weight to the middle of the last
    let sought = probability * (total - 0.5 * (first_weight + last_weight));
    let (mut value_before, mut weight_before, mut position) = (first, first_weight, 0.0);
    for &(value, weight) in counting().skip(1) {
        let step = 0.5 * (weight_before + weight);
        if position + step >= sought {
            let part = ((sought - position) / step).max(0.0);
            // also where both are infinite, whose difference is NaN
            return if part == 0.0 || value_before == value {
                value_before
            } else {
                value_before + (value - value_before) * part
            };
        }
        (value_before, weight_before, position) = (value, weight, position + step);
    }
    value_before
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

    #[test]
    fn alike_weights_are_the_plain_quantile() {
        let values = [1.0, 2.0, 4.0, 8.0, 9.0];
        let pairs = values.map(|value| (value, 0.2));
        for probability in [0.0, 0.05, 0.25, 0.5, 0.6, 0.95, 1.0] {
            let (found, expected) = (weighted_quantile(&pairs, probability), quantile(&values, probability));
            assert!((found - expected).abs() < 1e-12, "{probability}: {found} {expected}");
        }
    }

    #[test]
    fn weights_by_hand() {
        // from middle to middle: ½ (0.25 + 0.5) twice, 0.75 in all
        let pairs = [(0.0, 0.25), (5.0, 0.0), (10.0, 0.5), (20.0, 0.25)];
        assert_eq!(weighted_quantile(&pairs, 0.5), 10.0);
        assert_eq!(weighted_quantile(&pairs, 0.75), 15.0);
        assert_eq!(weighted_quantile(&[(3.0, 1.0)], 0.9), 3.0);
        assert!(weighted_quantile(&[(3.0, 0.0)], 0.5).is_nan());
        let infinite = [(1.0, 0.25), (f64::INFINITY, 0.25), (f64::INFINITY, 0.5)];
        assert_eq!([0.0, 0.1, 0.9].map(|p| weighted_quantile(&infinite, p)), [1.0, f64::INFINITY, f64::INFINITY]);
    }
}
