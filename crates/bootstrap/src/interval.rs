//! Confidence intervals of one ordinate.

use statrs::distribution::{ContinuousCDF, Normal};
use uplift_fragility::quantile;
use uplift_risk::RecordSample;

use crate::{BootstrapError, ResamplingPlan, acceleration};

/// How an interval is read from the replicates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Interval {
    /// Quantiles of the replicates: [`Band::percentile`].
    #[default]
    Percentile,
    /// Quantiles at levels corrected for bias and skewness: [`Band::bca`].
    Bca,
}

impl Interval {
    /// Every interval.
    pub const ALL: [Self; 2] = [Self::Percentile, Self::Bca];

    /// Name in files and keys: percentile, bca.
    pub fn key(self) -> &'static str {
        match self {
            Self::Percentile => "percentile",
            Self::Bca => "bca",
        }
    }

    /// The samples of which a band asks beside the replicates of `plan`: those without each unit, for BCa.
    ///
    /// # Errors
    /// As [`ResamplingPlan::left_out`].
    pub fn left_out(self, plan: &ResamplingPlan) -> Result<Vec<RecordSample>, BootstrapError> {
        match self {
            Self::Percentile => Ok(Vec::new()),
            Self::Bca => plan.left_out(),
        }
    }

    /// The band of an ordinate at a `confidence` between 0 and 1.
    ///
    /// - `replicates_m`: the ordinate of each replicate, m.
    /// - `estimate_m`: that of all records, m.
    /// - `without_each_m`: those of [`left_out`](Self::left_out), m.
    /// - `size`: units in a sample, records or earthquakes.
    pub fn band(
        self,
        replicates_m: &[f64],
        confidence: f64,
        estimate_m: f64,
        (without_each_m, size): (&[f64], u32),
    ) -> Band {
        let mut sorted = replicates_m.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        match self {
            Self::Percentile => Band::percentile(&sorted, confidence),
            Self::Bca => Band::bca(&sorted, confidence, estimate_m, acceleration(without_each_m, size)),
        }
    }
}

/// An interval of an ordinate and its median.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// Lower limit, m.
    pub lower_m: f64,
    /// Median of the replicates, m.
    pub median_m: f64,
    /// Upper limit, m.
    pub upper_m: f64,
}

impl Band {
    /// The band of `sorted` replicates, m, at a `confidence` between 0 and 1, between their quantiles, as in Section
    /// 4.5: at 5 and 95 % for a confidence of 0.9.
    pub fn percentile(sorted: &[f64], confidence: f64) -> Self {
        let tail = 0.5 * (1.0 - confidence);
        Self::between(sorted, [tail, 1.0 - tail])
    }

    /// The bias-corrected and accelerated band (BCa) of `sorted` replicates, m, at a `confidence` between 0 and
    /// 1: its limits are quantiles at levels moved by the bias of the median and by the skewness of the
    /// influence of single records.
    ///
    /// `estimate_m` is the ordinate of all records, m; `acceleration` that for the size of the sample, see
    /// [`acceleration`](crate::acceleration). The median is that of the replicates. The limits are NaN where
    /// the correction does not exist: all replicates on one side of the estimate, or single records that make
    /// the spectrum infinite.
    ///
    /// # Source
    /// Efron and Tibshirani (1993), "An introduction to the bootstrap", Eq. 14.9 to 14.15.
    pub fn bca(sorted: &[f64], confidence: f64, estimate_m: f64, acceleration: f64) -> Self {
        let tail = 0.5 * (1.0 - confidence);
        Self::between(sorted, bca_levels(sorted, tail, estimate_m, acceleration))
    }

    fn between(sorted: &[f64], [low, high]: [f64; 2]) -> Self {
        let at = |level: f64| if level.is_nan() { f64::NAN } else { quantile(sorted, level) };
        Self { lower_m: at(low), median_m: quantile(sorted, 0.5), upper_m: at(high) }
    }
}

/// The levels of both limits.
fn bca_levels(sorted: &[f64], tail: f64, estimate_m: f64, acceleration: f64) -> [f64; 2] {
    let below = sorted.partition_point(|&value| value < estimate_m);
    let not_above = sorted.partition_point(|&value| value <= estimate_m);
    // ordinates are demands and may be met exactly: half of those count as below
    let share = 0.5 * (below + not_above) as f64 / sorted.len() as f64;
    let normal = Normal::standard();
    let bias = normal.inverse_cdf(share);
    if !bias.is_finite() || !acceleration.is_finite() {
        return [f64::NAN; 2];
    }
    [tail, 1.0 - tail].map(|level| {
        let shifted = bias + normal.inverse_cdf(level);
        normal.cdf(bias + shifted / (1.0 - acceleration * shifted))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn replicates() -> Vec<f64> {
        (0..=1000).map(|i| f64::from(i) / 1000.0).collect()
    }

    #[test]
    fn percentiles_are_quantiles() {
        let band = Band::percentile(&replicates(), 0.9);
        for (found, expected) in [(band.lower_m, 0.05), (band.median_m, 0.5), (band.upper_m, 0.95)] {
            assert!((found - expected).abs() < 1e-12, "{band:?}");
        }
    }

    #[test]
    fn bca_without_bias_and_skewness_is_percentiles() {
        let plain = Band::percentile(&replicates(), 0.9);
        let bca = Band::bca(&replicates(), 0.9, 0.5, 0.0);
        assert!((plain.lower_m - bca.lower_m).abs() < 1e-9 && (plain.upper_m - bca.upper_m).abs() < 1e-9);
    }

    // z0 = Φ⁻¹(0.6) = 0.2533471, z(0.05) = −1.6448536, a = 0.1:
    // 0.2533471 − 1.3915065/(1 + 0.13915065) = −0.9681846 → Φ = 0.166477;
    // 0.2533471 + 1.8982007/(1 − 0.18982007) = 2.5962805 → Φ = 0.995288.
    #[test]
    fn bca_by_hand() {
        let band = Band::bca(&replicates(), 0.9, 0.6, 0.1);
        assert!((band.lower_m - 0.166_477).abs() < 2e-3 && (band.upper_m - 0.995_288).abs() < 1e-3, "{band:?}");
        assert!((band.median_m - 0.5).abs() < 1e-12);
    }

    #[test]
    fn bca_says_where_it_does_not_exist() {
        let band = Band::bca(&replicates(), 0.9, 2.0, 0.0);
        assert!(band.lower_m.is_nan() && band.upper_m.is_nan() && band.median_m == 0.5);
        let zeros = Band::bca(&[0.0; 9], 0.9, 0.0, 0.0);
        assert_eq!(zeros, Band { lower_m: 0.0, median_m: 0.0, upper_m: 0.0 });
    }
}
