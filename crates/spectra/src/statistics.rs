//! Percentiles of displacements.

use uplift_fragility::quantile;

/// The percentile of a sample at `percent` (0 to 100): linear between order statistics, as numpy, Excel and MATLAB's
/// `prctile` nearly do; `+∞` where it falls on a system that overturned. NaN of an empty sample.
pub fn percentile(sample_m: &[f64], percent: f64) -> f64 {
    let mut sorted = sample_m.to_vec();
    sorted.sort_by(f64::total_cmp);
    quantile(&sorted, percent / 100.0)
}

/// The largest abscissa at which a line is infinite: below it the figures leave the line out (`α_crit` of Section
/// 2.4.2, `(f_up/mg)_crit` of Section 3.4.3). None where the system stands throughout.
pub fn critical(abscissae: &[f64], ordinates_m: &[f64]) -> Option<f64> {
    abscissae
        .iter()
        .zip(ordinates_m)
        .filter(|(_, ordinate)| ordinate.is_infinite())
        .map(|(abscissa, _)| *abscissa)
        .reduce(f64::max)
}
