//! Bands by resampling motions, and the test that swaps within pairs.
//!
//! A replicate draws motions with replacement: of pairs both values together, of samples that are not paired each by
//! itself. It has its own stream of the counter-based generator `ChaCha8`, numbered by the replicate, and so depends on
//! the seed and its number alone.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::error::ValidationError;
use crate::kolmogorov_smirnov::KolmogorovSmirnov;
use crate::pairs::{check, log_ratios, mean_and_deviation};
use crate::sample::{Sample, median_of_sorted};

/// Fills the seed behind the 8 bytes of the user's number.
const MOTIONS: &[u8; 24] = b"uplift validate  motions";
/// The same for swaps within pairs.
const SWAPS: &[u8; 24] = b"uplift validate    swaps";

/// How to resample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resampling {
    /// Replicates.
    pub replicates: u32,
    /// Seed.
    pub seed: u64,
}

impl Default for Resampling {
    fn default() -> Self {
        Self { replicates: 10_000, seed: 1 }
    }
}

/// Quantiles of a statistic over replicates.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Quantiles {
    /// 5 %.
    pub q05: f64,
    /// 50 %.
    pub q50: f64,
    /// 95 %.
    pub q95: f64,
    /// Replicates in which it is not defined: both medians infinite, fewer than two finite pairs. They do not count.
    pub undefined: u32,
}

/// Bands of pairs.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Bands {
    /// Signed error of the median, `u50,computed/u50,measured − 1`; none where it is defined in no replicate.
    pub median_ratio: Option<Quantiles>,
    /// Bias, mean of `ln(computed/measured)`.
    pub log_bias: Option<Quantiles>,
    /// Dispersion, its standard deviation.
    pub log_dispersion: Option<Quantiles>,
}

/// Bands of the median's error, bias and dispersion of pairs in the order of their motions.
///
/// # Errors
/// As many of each, at least one; none NaN or −∞.
pub fn bands(measured: &[f64], computed: &[f64], resampling: Resampling) -> Result<Bands, ValidationError> {
    check(measured, computed)?;
    let mut found = [Vec::new(), Vec::new(), Vec::new()];
    for replicate in 0..resampling.replicates {
        let mut stream = Stream::new(MOTIONS, resampling.seed, replicate);
        let drawn: Vec<usize> = measured.iter().map(|_| stream.below(measured.len())).collect();
        let [m, c] = [measured, computed].map(|values| drawn.iter().map(|index| values[*index]).collect::<Vec<f64>>());
        found[0].extend(median_error(m.clone(), c.clone()));
        let (mean, deviation) = mean_and_deviation(&log_ratios(m.into_iter().zip(c)));
        found[1].extend(mean);
        found[2].extend(deviation);
    }
    let [median_ratio, log_bias, log_dispersion] = found.map(|values| quantiles(values, resampling.replicates));
    Ok(Bands { median_ratio, log_bias, log_dispersion })
}

/// Band of the median's signed error `u50,computed/u50,measured − 1` of samples that are not paired.
pub fn median_ratio_band(measured: &Sample, computed: &Sample, resampling: Resampling) -> Option<Quantiles> {
    let mut found = Vec::new();
    for replicate in 0..resampling.replicates {
        let mut stream = Stream::new(MOTIONS, resampling.seed, replicate);
        let mut draw = |sample: &Sample| -> Vec<f64> {
            (0..sample.len()).map(|_| sample.sorted()[stream.below(sample.len())]).collect()
        };
        let (m, c) = (draw(measured), draw(computed));
        found.extend(median_error(m, c));
    }
    quantiles(found, resampling.replicates)
}

/// p of the Kolmogorov–Smirnov distance of pairs that are exchangeable within themselves: the part of swaps, of each
/// pair by the toss of a coin, with a distance as large.
///
/// Unlike the p of independent samples it takes account of the pairs' being alike.
///
/// # Errors
/// As many of each, at least one; none NaN or −∞.
pub fn permutation_p(measured: &[f64], computed: &[f64], resampling: Resampling) -> Result<f64, ValidationError> {
    check(measured, computed)?;
    let distance = |m: Vec<f64>, c: Vec<f64>| -> Result<f64, ValidationError> {
        Ok(KolmogorovSmirnov::distance_of(&Sample::new(m)?, &Sample::new(c)?))
    };
    let observed = distance(measured.to_vec(), computed.to_vec())?;
    let mut as_large = 1_u32;
    for replicate in 0..resampling.replicates {
        let mut stream = Stream::new(SWAPS, resampling.seed, replicate);
        let swap = |(m, c): (&f64, &f64)| if stream.below(2) == 0 { (*m, *c) } else { (*c, *m) };
        let (m, c): (Vec<f64>, Vec<f64>) = measured.iter().zip(computed).map(swap).unzip();
        as_large += u32::from(distance(m, c)? >= observed - 1e-12);
    }
    Ok(f64::from(as_large) / (f64::from(resampling.replicates) + 1.0))
}

/// The error of the median; none where it is ∞/∞.
fn median_error(mut measured: Vec<f64>, mut computed: Vec<f64>) -> Option<f64> {
    measured.sort_by(f64::total_cmp);
    computed.sort_by(f64::total_cmp);
    let error = median_of_sorted(&computed) / median_of_sorted(&measured) - 1.0;
    (!error.is_nan()).then_some(error)
}

fn quantiles(mut values: Vec<f64>, replicates: u32) -> Option<Quantiles> {
    if values.is_empty() {
        return None;
    }
    values.sort_by(f64::total_cmp);
    let undefined = replicates - u32::try_from(values.len()).unwrap_or(replicates);
    let [q05, q50, q95] = [0.05, 0.5, 0.95].map(|share| quantile_of_sorted(&values, share));
    Some(Quantiles { q05, q50, q95, undefined })
}

/// Quantile of ascending values, linear between them.
fn quantile_of_sorted(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // within the values
    let (below, part) = (place as usize, place.fract());
    let low = sorted[below];
    // between two infinite values there is nothing but these
    if part == 0.0 || sorted[below + 1] <= low { low } else { low + part * (sorted[below + 1] - low) }
}

/// The random numbers of one replicate.
pub(crate) struct Stream(ChaCha8Rng);

impl Stream {
    pub(crate) fn new(domain: &[u8; 24], seed: u64, replicate: u32) -> Self {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        bytes[8..].copy_from_slice(domain);
        let mut generator = ChaCha8Rng::from_seed(bytes);
        generator.set_stream(u64::from(replicate));
        Self(generator)
    }

    /// Uniform on `0..bound`: the high half of a product, uneven by less than 2⁻⁴⁰ for samples of any size.
    fn below(&mut self, bound: usize) -> usize {
        #[allow(clippy::cast_possible_truncation)] // below the bound
        let number = ((u128::from(self.0.next_u64()) * bound as u128) >> 64) as usize;
        number
    }

    /// Uniform on (0, 1).
    pub(crate) fn uniform(&mut self) -> f64 {
        ((self.0.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_among_infinite_values_are_values() {
        let inf = f64::INFINITY;
        let values = [1.0, 2.0, inf, inf];
        assert_eq!([0.0, 0.25, 0.5, 0.9].map(|share| quantile_of_sorted(&values, share)), [1.0, 1.75, inf, inf]);
        assert_eq!(quantile_of_sorted(&[-inf, -inf, 0.0], 0.25), -inf);
    }
}
