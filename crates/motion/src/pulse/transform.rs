//! Continuous wavelet transform of a sampled velocity, at a step that goes with the scale.
//!
//! The coefficient of the wavelet of scale a that starts at s is C = a^(−1/2) ∫ v(t) ψ((t − s)/a) dt.
//! The velocity enters as its means over blocks of whole samples, some [`Resolution`] of them in a
//! scale, and the wavelet as its exact integrals over the same blocks: the means keep what is too
//! fast for a scale out of it, and a long scale costs no more than a short one.

use super::wavelet;

/// Least number of blocks in one scale (1.4 times as many in a pseudo-period), unless the samples
/// are farther apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resolution {
    /// In the search over all scales and times.
    pub(super) search: f64,
    /// Where a pulse is extracted.
    pub(super) extraction: f64,
}

impl Resolution {
    /// Finer ones change no class and no period that matters: see the tests.
    pub(super) const DEFAULT: Self = Self { search: 32.0, extraction: 96.0 };
}

/// As fine as the samples, for those of accelerographs: 200 samples a second with the longest scale.
pub(super) const FINEST: f64 = 2048.0;

/// A signal as means over blocks of equal length, the first from time zero.
pub(super) struct Blocks {
    pub(super) step_s: f64,
    means: Vec<f64>,
}

impl Blocks {
    /// Blocks of as many samples as leave `resolution` blocks in `scale_s`, one sample at least,
    /// from the integral of the signal up to every sample.
    pub(super) fn new(integral: &[f64], dt_s: f64, scale_s: f64, resolution: f64) -> Self {
        let samples = (scale_s / (resolution * dt_s)).floor().max(1.0);
        let step_s = samples * dt_s;
        let last = integral.len() - 1;
        // Not negative; the conversion saturates, and no block is longer than the record.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let samples = (samples as usize).min(last);
        let block = |start: usize| (integral[(start + samples).min(last)] - integral[start]) / step_s;
        Self { step_s, means: (0..last).step_by(samples).map(block).collect() }
    }
}

/// The wavelet of one scale as its integrals over blocks, times a^(−1/2).
pub(super) struct Kernel {
    /// The block in which the wavelet starts; before the first block where negative.
    first: i64,
    weights: Vec<f64>,
}

impl Kernel {
    /// The wavelet of `scale_s` centred at `centre_s`, on blocks of `step_s`.
    pub(super) fn new(scale_s: f64, centre_s: f64, step_s: f64) -> Self {
        let start_s = centre_s - 0.5 * wavelet::SUPPORT * scale_s;
        let first = (start_s / step_s).floor();
        // Some tens of resolutions at most, as a block holds one sample or as many as the resolution asks.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let count = (wavelet::SUPPORT * scale_s / step_s).ceil() as usize + 1;
        let edge = |index: usize| wavelet::integral(((first + index as f64) * step_s - start_s) / scale_s);
        let amplitude = scale_s.sqrt();
        let mut before = edge(0);
        let weights = (1..=count).map(|index| {
            let after = edge(index);
            amplitude * (after - std::mem::replace(&mut before, after))
        });
        let weights = weights.collect();
        #[allow(clippy::cast_possible_truncation)]
        Self { first: first as i64, weights }
    }

    /// Coefficient of `blocks`, which are zero outside the record, with the wavelet moved by
    /// `shift` blocks.
    pub(super) fn coefficient(&self, blocks: &Blocks, shift: i64) -> f64 {
        let start = self.first.saturating_add(shift);
        let skipped = usize::try_from(start.saturating_neg()).unwrap_or(0);
        let start = usize::try_from(start).unwrap_or(0);
        match (self.weights.get(skipped..), blocks.means.get(start..)) {
            (Some(weights), Some(means)) => dot(weights, means),
            _ => 0.0,
        }
    }
}

/// Σ xᵢ yᵢ over the common length, in eight partial sums that the processor can form at once.
fn dot(x: &[f64], y: &[f64]) -> f64 {
    let count = x.len().min(y.len());
    let (x, y) = (x[..count].chunks_exact(8), y[..count].chunks_exact(8));
    let rest: f64 = x.remainder().iter().zip(y.remainder()).map(|(x, y)| x * y).sum();
    let mut sums = [0.0; 8];
    for (x, y) in x.zip(y) {
        for lane in 0..8 {
            sums[lane] += x[lane] * y[lane];
        }
    }
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peaks::integral;
    use proptest::prelude::*;

    #[test]
    fn means_by_hand() {
        // v = 1, 3, 5, 7, 9, 11 at 0.5 s: means of two intervals 3, 7, and half of 10.
        let area = integral(&[1.0, 3.0, 5.0, 7.0, 9.0, 11.0], 0.5);
        assert_eq!(area, [0.0, 1.0, 3.0, 6.0, 10.0, 15.0]);
        let blocks = Blocks::new(&area, 0.5, 2.0, 2.0);
        assert_eq!(blocks.step_s, 1.0);
        assert_eq!(blocks.means, [3.0, 7.0, 5.0]);
    }

    /// The wavelet of `scale_s` centred at `centre_s`, of unit energy, sampled.
    fn sampled(scale_s: f64, centre_s: f64, dt_s: f64, count: usize) -> Vec<f64> {
        let x = |i: usize| (i as f64 * dt_s - centre_s) / scale_s + 0.5 * wavelet::SUPPORT;
        (0..count).map(|i| wavelet::value(x(i)) / scale_s.sqrt()).collect()
    }

    #[test]
    fn the_coefficient_of_the_wavelet_itself_is_one_inside_the_record() {
        let (scale_s, dt_s) = (1.5, 0.01);
        let area = integral(&sampled(scale_s, 10.0, dt_s, 2001), dt_s);
        // The mean over a block takes some π²/6 (block/period)² off a wave.
        for (resolution, tolerance) in [(16.0, 0.01), (48.0, 2e-3), (1e9, 5e-4)] {
            let blocks = Blocks::new(&area, dt_s, scale_s, resolution);
            let found = Kernel::new(scale_s, 10.0, blocks.step_s).coefficient(&blocks, 0);
            assert!((found - 1.0).abs() < tolerance, "{resolution}: {found}");
            // Shifted by a whole number of scales, it is orthogonal.
            let next = Kernel::new(scale_s, 10.0 + scale_s, blocks.step_s).coefficient(&blocks, 0);
            assert!(next.abs() < tolerance, "{resolution}: {next}");
        }
        // Farther away than the support: nothing, on either side.
        let blocks = Blocks::new(&area, dt_s, scale_s, 16.0);
        let kernel = Kernel::new(scale_s, 10.0, blocks.step_s);
        for shift in [i64::MIN, -1000, 1000, i64::MAX] {
            assert_eq!(kernel.coefficient(&blocks, shift), 0.0);
        }
    }

    proptest! {
        /// The sum over blocks against the plain sum over samples, wavelets cut by the record's ends included.
        #[test]
        fn the_coefficient_is_the_integral(
            signal in prop::collection::vec(-1.0..1.0_f64, 2..300),
            scale_s in 0.2..3.0_f64,
            centre_s in -1.0..4.0_f64,
            shift in -20_i64..20,
        ) {
            let dt_s = 0.01;
            // One sample a block: the signal is a mean in every interval.
            let blocks = Blocks::new(&integral(&signal, dt_s), dt_s, scale_s, 1e9);
            let found = Kernel::new(scale_s, centre_s, dt_s).coefficient(&blocks, shift);
            let start_s = centre_s + shift as f64 * dt_s - 0.5 * wavelet::SUPPORT * scale_s;
            let expected = signal.windows(2).enumerate().map(|(i, ends)| {
                let middle_s = (i as f64 + 0.5) * dt_s;
                let mean = 0.5 * (ends[0] + ends[1]);
                mean * wavelet::value((middle_s - start_s) / scale_s) / scale_s.sqrt() * dt_s
            });
            let expected: f64 = expected.sum();
            prop_assert!((found - expected).abs() < 2e-3, "{found} {expected}");
        }

        #[test]
        fn partial_sums_add_up(pairs in prop::collection::vec((-1.0..1.0_f64, -1.0..1.0_f64), 0..100)) {
            let (x, y): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
            let expected: f64 = x.iter().zip(&y).map(|(x, y)| x * y).sum();
            prop_assert!((dot(&x, &y) - expected).abs() < 1e-12);
        }
    }
}
