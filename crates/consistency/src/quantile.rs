//! Quantiles of values that weigh differently.

/// The quantile at `probability` of (value, weight) pairs sorted by value: linear between the middles of the weights,
/// which run from 0 at the first value to 1 at the last.
///
/// Where all weigh alike that is the definition of numpy, R (type 7) and Excel (`PERCENTILE.INC`). Values without
/// weight do not count; NaN where there is no weight.
pub(crate) fn weighted_quantile(pairs: &[(f64, f64)], probability: f64) -> f64 {
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
            return value_before + (value - value_before) * ((sought - position) / step).max(0.0);
        }
        (value_before, weight_before, position) = (value, weight, position + step);
    }
    value_before
}

#[cfg(test)]
mod tests {
    use uplift_fragility::quantile;

    use super::*;

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
    }
}
