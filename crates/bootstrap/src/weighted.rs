//! Quantiles of values that weigh differently.

/// The smallest value whose weight, with that of all smaller ones, reaches `probability` of the total; `pairs` are
/// (value, weight), sorted by value. NaN where there is no weight.
pub fn weighted_quantile(pairs: &[(f64, f64)], probability: f64) -> f64 {
    let total: f64 = pairs.iter().map(|pair| pair.1).sum();
    // a hair less than the target, which sums of equal weights may miss by their rounding
    let target = probability * total * (1.0 - 1e-12);
    let mut sum = 0.0;
    for &(value, weight) in pairs {
        sum += weight;
        if weight > 0.0 && sum >= target {
            return value;
        }
    }
    f64::NAN
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_count() {
        let pairs = [(1.0, 0.2), (2.0, 0.5), (3.0, 0.3)];
        for (probability, expected) in [(0.0, 1.0), (0.2, 1.0), (0.21, 2.0), (0.7, 2.0), (0.71, 3.0), (1.0, 3.0)] {
            assert_eq!(weighted_quantile(&pairs, probability), expected, "{probability}");
        }
        // a value without weight does not count
        assert_eq!(weighted_quantile(&[(1.0, 0.0), (2.0, 1.0)], 0.0), 2.0);
        assert!(weighted_quantile(&[], 0.5).is_nan());
    }
}
