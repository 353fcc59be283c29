//! How much the demands of a stripe scatter: the efficiency of an intensity measure (Luco and Cornell,
//! Earthquake Spectra 23, 2007).
//!
//! An efficient measure leaves little scatter in the demand at a given level. Demands of zero and overturned runs have
//! no logarithm: they are counted, and a dispersion that would have to ignore them is not given.

use crate::{Stripes, quantile};

/// The scatter of the demands at one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dispersion {
    /// Demands of zero.
    pub zeros: usize,
    /// Overturned runs.
    pub overturned: usize,
    /// Median demand, m; +∞ where half of the runs or more overturn.
    pub median_m: f64,
    /// Half the logarithm of the ratio of the 84th to the 16th percentile: the dispersion of a lognormal
    /// demand. All runs take part; NaN where more than about 16 % are zero or overturned, or there are too few
    /// runs for these percentiles.
    pub by_percentiles: f64,
    /// Standard deviation of the logarithm, with n − 1 degrees of freedom; NaN where a run has none, or
    /// there are fewer than two.
    pub of_logarithm: f64,
}

impl Dispersion {
    /// The scatter of the stripe `level`.
    ///
    /// # Panics
    /// If `level` is not below [`Stripes::level_count`].
    pub fn from_stripes(stripes: &Stripes<'_>, level: usize) -> Self {
        let mut demands_m: Vec<f64> = stripes.stripe(level).collect();
        demands_m.sort_by(f64::total_cmp);
        let count = demands_m.len();
        let zeros = demands_m.partition_point(|&demand| demand == 0.0);
        let overturned = count - demands_m.partition_point(|&demand| demand.is_finite());
        let (low, high) = (quantile(&demands_m, 0.16), quantile(&demands_m, 0.84));
        let by_percentiles =
            if count >= 3 && low > 0.0 && high.is_finite() { 0.5 * (high / low).ln() } else { f64::NAN };
        let of_logarithm = if zeros + overturned > 0 || count < 2 {
            f64::NAN
        } else {
            standard_deviation(&demands_m.iter().map(|demand| demand.ln()).collect::<Vec<_>>())
        };
        Self { zeros, overturned, median_m: quantile(&demands_m, 0.5), by_percentiles, of_logarithm }
    }
}

/// The level at which each record first lifts the structure, in the unit of the levels, `[record]`; NaN where no level
/// of the record stays below uplift, or none shakes it at all.
///
/// Below uplift the structure is elastic and its demand proportional to the level: so `level · u_up/EDP`, from the
/// highest level whose demand and all demands below it stay under `uplift_displacement_m`, is exact.
pub fn uplift_levels(stripes: &Stripes<'_>, uplift_displacement_m: f64) -> Vec<f64> {
    (0..stripes.record_count())
        .map(|record| {
            let demands_m = stripes.record(record);
            let below = demands_m.iter().take_while(|&&demand| demand < uplift_displacement_m).count();
            match below.checked_sub(1) {
                Some(last) if demands_m[last] > 0.0 => stripes.levels()[last] * uplift_displacement_m / demands_m[last],
                _ => f64::NAN,
            }
        })
        .collect()
}

/// The mean over levels of each record's deviation from the stripe: `ln EDP` less the mean of `ln EDP` over the
/// records, `[record]`.
///
/// Only stripes count whose median exceeds `median_above_m` and in which every demand has a logarithm; empty where
/// there is none such. A record is one observation, however many levels it was scaled to; NaN where it belongs to none
/// of these stripes.
pub fn mean_residuals(stripes: &Stripes<'_>, median_above_m: f64) -> Vec<f64> {
    let mut sums = vec![0.0; stripes.record_count()];
    let mut levels = vec![0; stripes.record_count()];
    for level in 0..stripes.level_count() {
        let scatter = Dispersion::from_stripes(stripes, level);
        if scatter.zeros + scatter.overturned > 0 || scatter.median_m <= median_above_m {
            continue;
        }
        let logarithms: Vec<f64> = stripes.stripe(level).map(f64::ln).collect();
        let mean = logarithms.iter().sum::<f64>() / logarithms.len() as f64;
        let of_level = (0..stripes.record_count()).filter(|&record| stripes.belongs(record, level));
        for (record, logarithm) in of_level.zip(&logarithms) {
            sums[record] += logarithm - mean;
            levels[record] += 1;
        }
    }
    if levels.iter().all(|&count| count == 0) {
        return Vec::new();
    }
    sums.into_iter().zip(levels).map(|(sum, count)| sum / f64::from(count)).collect()
}

/// Standard deviation with n − 1 degrees of freedom; NaN of fewer than two values.
pub fn standard_deviation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    if values.len() < 2 { f64::NAN } else { (squares / (n - 1.0)).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn scatter_by_hand() {
        // e⁰ … e⁴: percentiles at positions 0.64, 2 and 3.36 of the sorted values
        let demands: Vec<f64> = (0..5).map(|i| f64::from(i).exp()).collect();
        let scatter = Dispersion::from_stripes(&Stripes::new(&[1.0], &demands).unwrap(), 0);
        let e = std::f64::consts::E;
        let (low, high) = (1.0 + 0.64 * (e - 1.0), e.powi(3) + 0.36 * (e.powi(4) - e.powi(3)));
        assert!((scatter.by_percentiles - 0.5 * (high / low).ln()).abs() < 1e-14);
        assert!((scatter.of_logarithm - 2.5_f64.sqrt()).abs() < 1e-14);
        assert_eq!(scatter.median_m, 2.0_f64.exp());
        assert_eq!((scatter.zeros, scatter.overturned), (0, 0));
    }

    #[test]
    fn runs_without_a_logarithm_are_counted_and_never_dropped() {
        let mut demands = vec![0.1; 20];
        demands[0] = 0.0;
        demands[1] = INF;
        let scatter = Dispersion::from_stripes(&Stripes::new(&[1.0], &demands).unwrap(), 0);
        assert_eq!((scatter.zeros, scatter.overturned, scatter.by_percentiles), (1, 1, 0.0));
        assert!(scatter.of_logarithm.is_nan());
        let overturned = Dispersion::from_stripes(&Stripes::new(&[1.0], &[0.1, INF, INF]).unwrap(), 0);
        assert!(overturned.by_percentiles.is_nan() && overturned.median_m == INF);
        let single = Dispersion::from_stripes(&Stripes::new(&[1.0], &[0.1]).unwrap(), 0);
        assert!(single.by_percentiles.is_nan() && single.of_logarithm.is_nan() && single.median_m == 0.1);
    }

    #[test]
    fn uplift_is_found_by_proportion() {
        // record 0 is elastic with 1e-4 m per unit: uplift of 5e-4 m at 5; record 1 never stays
        // below; record 2 never moves
        let edp_m = [1e-4, 4e-4, 3e-2, 6e-4, 7e-4, 8e-4, 0.0, 0.0, 0.0];
        let found = uplift_levels(&Stripes::new(&[1.0, 4.0, 16.0], &edp_m).unwrap(), 5e-4);
        assert!((found[0] - 5.0).abs() < 1e-12 && found[1].is_nan() && found[2].is_nan(), "{found:?}");
    }

    #[test]
    fn residuals_are_averaged_over_the_stripes_that_rock() {
        // the first stripe does not rock, the second and third do: deviations ± ln 2 / 2 and ± ln 8 / 2
        let edp_m = [1e-4, 0.2, 0.8, 3e-4, 0.1, 0.1];
        let found = mean_residuals(&Stripes::new(&[1.0, 2.0, 3.0], &edp_m).unwrap(), 5e-4);
        let expected = (2.0_f64.ln() + 8.0_f64.ln()) / 4.0;
        assert!((found[0] - expected).abs() < 1e-14 && (found[1] + expected).abs() < 1e-14);
        assert!(mean_residuals(&Stripes::new(&[1.0], &[0.1, INF]).unwrap(), 5e-4).is_empty());
    }
}
