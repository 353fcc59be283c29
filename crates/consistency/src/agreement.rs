//! How far two spectra of one risk agree: by PGA over by PGV.

/// Ratios of paired ordinates in one class of displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Number of pairs.
    pub count: usize,
    /// Geometric mean of the ratios.
    pub geometric_mean: f64,
    /// The smallest ratio.
    pub smallest: f64,
    /// The largest ratio.
    pub largest: f64,
    /// Root mean square of ln(ratio).
    pub rms: f64,
}

impl Agreement {
    /// Of the pairs whose geometric mean lies from `from_m` to below `below_m`, m; none where there is no such pair.
    ///
    /// - `pairs_m`: (ordinate of the one, of the other), m; the ratio is the first over the second. Pairs with a
    ///   displacement that is 0 or not finite are left out.
    pub fn from_pairs(pairs_m: impl IntoIterator<Item = (f64, f64)>, from_m: f64, below_m: f64) -> Option<Self> {
        let (mut count, mut sum, mut squares) = (0_usize, 0.0, 0.0);
        let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
        for (first_m, second_m) in pairs_m {
            let both = [first_m, second_m];
            if !both.iter().all(|value| value.is_finite() && *value > 0.0)
                || !(from_m..below_m).contains(&(first_m * second_m).sqrt())
            {
                continue;
            }
            let ratio = first_m / second_m;
            count += 1;
            sum += ratio.ln();
            squares += ratio.ln().powi(2);
            (smallest, largest) = (smallest.min(ratio), largest.max(ratio));
        }
        let mean = |sum: f64| sum / count as f64;
        let (geometric_mean, rms) = (mean(sum).exp(), mean(squares).sqrt());
        (count > 0).then_some(Self { count, geometric_mean, smallest, largest, rms })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_by_class() {
        let pairs = [(0.04, 0.01), (0.01, 0.04), (0.001, 0.001), (0.0, 1.0), (f64::INFINITY, 1.0)];
        let found = Agreement::from_pairs(pairs, 0.01, f64::INFINITY).unwrap();
        assert_eq!((found.count, found.smallest, found.largest), (2, 0.25, 4.0));
        assert!((found.geometric_mean - 1.0).abs() < 1e-15 && (found.rms - 4.0_f64.ln()).abs() < 1e-15);
        assert_eq!(Agreement::from_pairs(pairs, 0.0005, 0.01).unwrap().count, 1);
        assert_eq!(Agreement::from_pairs(pairs, 5.0, 6.0), None);
    }
}
