//! Bands by resampling motions, and the test that swaps within pairs.
//!
//! A replicate draws motions with replacement: of pairs both values together, of samples that are not paired each by
//! itself. It has its own stream of the counter-based generator `ChaCha8`, numbered by the replicate, and so depends on
//! the seed and its number alone.

use uplift_random::{ChaCha8Rng, Rng, stream};

use crate::error::ValidationError;
use crate::kolmogorov_smirnov::KolmogorovSmirnov;
use crate::pairs::{check, log_ratios, mean_and_deviation};
use crate::sample::Sample;

/// Fills the seed behind the 8 bytes of the user's number.
const MOTIONS: &[u8; 24] = b"uplift validate  motions";
/// The same for swaps within pairs.
const SWAPS: &[u8; 24] = b"uplift validate    swaps";

/// Values of a sample beyond which the replicates are fewer.
const MANY: usize = 20_000;
/// Values that are drawn of samples so large.
const MOST_DRAWN: usize = 200_000_000;
/// Replicates that even the largest samples have: their standard error of a quantile of 5 % is then 2 %.
const FEWEST: u32 = 100;

/// How to resample.
#[derive(Clone, Copy)]
pub struct Resampling<'a> {
    /// Replicates, fewer of very large samples ([`Resampling::replicates_for`]).
    pub replicates: u32,
    /// Seed.
    pub seed: u64,
    /// Whether to stop, asked before each replicate.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

impl Default for Resampling<'_> {
    fn default() -> Self {
        Self { replicates: 10_000, seed: 1, stop: &|| false }
    }
}

impl Resampling<'_> {
    /// The replicates of a sample of so many values: beyond 20 000 values as many as draw 2·10⁸ together, but 100.
    pub fn replicates_for(&self, values: usize) -> u32 {
        if values <= MANY {
            return self.replicates;
        }
        let bound = u32::try_from(MOST_DRAWN / values).unwrap_or(u32::MAX);
        self.replicates.min(bound.max(FEWEST))
    }

    /// # Errors
    /// [`ValidationError::Stopped`] if the caller wants it.
    pub(crate) fn go_on(&self) -> Result<(), ValidationError> {
        if (self.stop)() { Err(ValidationError::Stopped) } else { Ok(()) }
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
    let replicates = resampling.replicates_for(measured.len());
    for replicate in 0..replicates {
        resampling.go_on()?;
        let mut stream = Stream::new(MOTIONS, resampling.seed, replicate);
        let drawn: Vec<usize> = measured.iter().map(|_| stream.below(measured.len())).collect();
        let [m, c] = [measured, computed].map(|values| drawn.iter().map(|index| values[*index]).collect::<Vec<f64>>());
        found[0].extend(median_error(m.clone(), c.clone()));
        let (mean, deviation) = mean_and_deviation(&log_ratios(m.into_iter().zip(c)));
        found[1].extend(mean);
        found[2].extend(deviation);
    }
    let [median_ratio, log_bias, log_dispersion] = found.map(|values| quantiles(values, replicates));
    Ok(Bands { median_ratio, log_bias, log_dispersion })
}

/// Band of the median's signed error `u50,computed/u50,measured − 1` of samples that are not paired.
///
/// # Errors
/// [`ValidationError::Stopped`].
pub fn median_ratio_band(
    measured: &Sample,
    computed: &Sample,
    resampling: Resampling,
) -> Result<Option<Quantiles>, ValidationError> {
    let mut found = Vec::new();
    let replicates = resampling.replicates_for(measured.len().max(computed.len()));
    for replicate in 0..replicates {
        resampling.go_on()?;
        let mut stream = Stream::new(MOTIONS, resampling.seed, replicate);
        let mut draw = |sample: &Sample| -> Vec<f64> {
            (0..sample.len()).map(|_| sample.sorted()[stream.below(sample.len())]).collect()
        };
        let (m, c) = (draw(measured), draw(computed));
        found.extend(median_error(m, c));
    }
    Ok(quantiles(found, replicates))
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
    let replicates = resampling.replicates_for(measured.len());
    for replicate in 0..replicates {
        resampling.go_on()?;
        let mut stream = Stream::new(SWAPS, resampling.seed, replicate);
        let swap = |(m, c): (&f64, &f64)| if stream.below(2) == 0 { (*m, *c) } else { (*c, *m) };
        let (m, c): (Vec<f64>, Vec<f64>) = measured.iter().zip(computed).map(swap).unzip();
        as_large += u32::from(distance(m, c)? >= observed - 1e-12);
    }
    Ok(f64::from(as_large) / (f64::from(replicates) + 1.0))
}

/// The error of the median; none where it is ∞/∞.
fn median_error(measured: Vec<f64>, computed: Vec<f64>) -> Option<f64> {
    let error = median_of_unsorted(computed) / median_of_unsorted(measured) - 1.0;
    (!error.is_nan()).then_some(error)
}

/// As that of the sorted values, without sorting them.
fn median_of_unsorted(mut values: Vec<f64>) -> f64 {
    let half = values.len() / 2;
    let is_odd = values.len() % 2 == 1;
    let (below, upper, _) = values.select_nth_unstable_by(half, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp).filter(|_| !is_odd);
    lower.map_or(*upper, |lower| 0.5 * (lower + *upper))
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
        Self(stream(domain, seed, u64::from(replicate)))
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
    fn a_median_needs_no_order() {
        let mut stream = Stream::new(MOTIONS, 1, 0);
        for size in 1..40 {
            let values: Vec<f64> = (0..size).map(|_| (9.0 * stream.uniform()).floor()).collect();
            let sorted = Sample::new(values.clone()).unwrap();
            assert_eq!(median_of_unsorted(values), sorted.median());
        }
    }

    #[test]
    fn very_large_samples_have_fewer_replicates() {
        let usual = Resampling::default();
        let of = [10, 20_000, 200_000, 1_000_000_000].map(|values| usual.replicates_for(values));
        assert_eq!(of, [10_000, 10_000, 1000, 100]);
    }

    #[test]
    fn who_stops_it_waits_for_one_replicate() {
        let resampling = Resampling { stop: &|| true, ..Resampling::default() };
        let sample = Sample::new(vec![1.0, 2.0]).unwrap();
        assert_eq!(bands(&[1.0, 2.0], &[1.0, 3.0], resampling), Err(ValidationError::Stopped));
        assert_eq!(permutation_p(&[1.0, 2.0], &[1.0, 3.0], resampling), Err(ValidationError::Stopped));
        assert_eq!(median_ratio_band(&sample, &sample, resampling), Err(ValidationError::Stopped));
    }

    #[test]
    fn quantiles_among_infinite_values_are_values() {
        let inf = f64::INFINITY;
        let values = [1.0, 2.0, inf, inf];
        assert_eq!([0.0, 0.25, 0.5, 0.9].map(|share| quantile_of_sorted(&values, share)), [1.0, 1.75, inf, inf]);
        assert_eq!(quantile_of_sorted(&[-inf, -inf, 0.0], 0.25), -inf);
    }
}
