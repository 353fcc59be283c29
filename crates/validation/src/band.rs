//! Bands of an empirical distribution.

use statrs::distribution::{Binomial, DiscreteCDF};

use crate::sample::Sample;

/// 97.5 % quantile of the normal distribution.
const NORMAL_975: f64 = 1.959_963_984_540_054;

/// How a band of an empirical distribution is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum BandRule {
    /// [`greenwood_band`], pointwise.
    #[default]
    Greenwood,
    /// [`dkw_half_width`], of the whole distribution.
    Dkw,
    /// [`bootstrap_band`], pointwise.
    Bootstrap,
}

impl BandRule {
    /// The 95 % band of the distribution function at `x`, within 0 and 1.
    pub fn at(self, sample: &Sample, x: f64) -> [f64; 2] {
        match self {
            Self::Greenwood => greenwood_band(sample, x),
            Self::Bootstrap => bootstrap_band(sample, x),
            Self::Dkw => {
                let (f, half) = (sample.cdf(x), dkw_half_width(sample.len()));
                [(f - half).max(0.0), (f + half).min(1.0)]
            }
        }
    }
}

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

/// Pointwise 95 % band of the distribution function at `x` over resamples of the values: 2.5 and 97.5 % quantiles of
/// `K/n`.
///
/// Nothing is drawn: how many of `n` values drawn with replacement are at most `x` is binomial with the probability
/// `F(x)`.
pub fn bootstrap_band(sample: &Sample, x: f64) -> [f64; 2] {
    let (f, size) = (sample.cdf(x), sample.len() as u64);
    Binomial::new(f, size).map_or([f; 2], |drawn| [0.025, 0.975].map(|p| drawn.inverse_cdf(p) as f64 / size as f64))
}
