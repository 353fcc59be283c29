//! Bands of an empirical distribution.

use crate::sample::Sample;

/// 97.5 % quantile of the normal distribution.
const NORMAL_975: f64 = 1.959_963_984_540_054;

/// Pointwise 95 % band of the distribution function at `x`, `F ± 1.96 √(F(1 − F)/n)` within 0 and 1: Greenwood's
/// formula without censoring, what MATLAB's `ecdf` draws.
pub fn greenwood_band(sample: &Sample, x: f64) -> [f64; 2] {
    let f = sample.cdf(x);
    let half = NORMAL_975 * (f * (1.0 - f) / sample.len() as f64).sqrt();
    [(f - half).max(0.0), (f + half).min(1.0)]
}

/// Half the width of a band that holds the whole distribution function with 95 %, `√(ln(2/0.05)/2n)`.
///
/// # Source
/// A. Dvoretzky, J. Kiefer and J. Wolfowitz (1956); P. Massart (1990).
pub fn dkw_half_width(size: usize) -> f64 {
    ((2.0_f64 / 0.05).ln() / (2.0 * size as f64)).sqrt()
}
