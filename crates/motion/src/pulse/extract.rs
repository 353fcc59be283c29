//! The pulse around a wavelet: ten wavelets of one scale, taken out of the velocity one by one.

use super::search::{NEIGHBOURHOOD, Peak};
use super::transform::{Blocks, Kernel, Resolution};
use super::wavelet;
use crate::peaks::integral;

/// Number of wavelets that make a pulse.
const WAVELETS: usize = 10;
/// Most scales tried between those next to the scale found by the search; all that are whole
/// numbers of samples, at any usual time step.
const MOST_SCALES: f64 = 400.0;

/// A pulse taken out of a velocity.
pub(super) struct Extraction {
    /// Pseudo-period of its wavelets \[s\].
    pub(super) period_s: f64,
    /// What is left of the velocity at its samples \[m/s\].
    pub(super) residual: Vec<f64>,
}

/// Takes the pulse at `peak` out of `velocity`, which has the orientation of the peak.
pub(super) fn extract(velocity: &[f64], dt_s: f64, peak: &Peak, resolution: Resolution) -> Extraction {
    let resolution = resolution.extraction;
    let mut area = integral(velocity, dt_s);
    let scale_s = strongest_scale(&area, dt_s, peak, resolution);
    let duration_s = (velocity.len() - 1) as f64 * dt_s;
    let mut residual = velocity.to_vec();
    let mut middle_s = peak.centre_s;
    for taken in 0..WAVELETS {
        if taken > 0 {
            area = integral(&residual, dt_s);
        }
        let blocks = Blocks::new(&area, dt_s, scale_s, resolution);
        let kernel = Kernel::new(scale_s, middle_s, blocks.step_s);
        #[allow(clippy::cast_possible_truncation)] // at most the resolution
        let reach = (NEIGHBOURHOOD * scale_s / blocks.step_s).ceil() as i64;
        let mut strongest = (0.0, middle_s);
        for shift in -reach..=reach {
            let centre_s = middle_s + shift as f64 * blocks.step_s;
            let coefficient = kernel.coefficient(&blocks, shift);
            if (0.0..=duration_s).contains(&centre_s) && coefficient.abs() > f64::abs(strongest.0) {
                strongest = (coefficient, centre_s);
            }
        }
        let (coefficient, centre_s) = strongest;
        if taken == 0 {
            // The others are searched around the first.
            middle_s = centre_s;
        }
        subtract(&mut residual, dt_s, coefficient, centre_s, scale_s);
    }
    Extraction { period_s: scale_s / wavelet::CENTRE_FREQUENCY, residual }
}

/// The scale with the largest coefficient at the centre of the peak, on a finer grid \[s\].
fn strongest_scale(area: &[f64], dt_s: f64, peak: &Peak, resolution: f64) -> f64 {
    let [low, high] = peak.scales_s;
    let blocks = Blocks::new(area, dt_s, low, resolution);
    let steps = ((high - low) / dt_s).round().clamp(1.0, MOST_SCALES);
    let mut strongest = (0.0, low);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // clamped
    for index in 0..=steps as u32 {
        let scale_s = low + f64::from(index) / steps * (high - low);
        let coefficient = Kernel::new(scale_s, peak.centre_s, blocks.step_s).coefficient(&blocks, 0).abs();
        if coefficient > strongest.0 {
            strongest = (coefficient, scale_s);
        }
    }
    strongest.1
}

/// Takes `coefficient` times the wavelet of unit energy out of a signal.
fn subtract(signal: &mut [f64], dt_s: f64, coefficient: f64, centre_s: f64, scale_s: f64) {
    let start_s = centre_s - 0.5 * wavelet::SUPPORT * scale_s;
    // Not negative; the conversion saturates.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let sample = |t_s: f64| (t_s / dt_s).max(0.0) as usize;
    let (first, end) = (sample(start_s), sample(start_s + wavelet::SUPPORT * scale_s).saturating_add(2));
    let end = end.min(signal.len());
    let amplitude = coefficient / scale_s.sqrt();
    for (index, value) in signal.iter_mut().enumerate().take(end).skip(first) {
        *value -= amplitude * wavelet::value((index as f64 * dt_s - start_s) / scale_s);
    }
}

#[cfg(test)]
mod tests {
    use super::super::energy;
    use super::*;

    const DT_S: f64 = 0.005;

    fn peak(centre_s: f64, low: f64, high: f64) -> Peak {
        Peak { centre_s, scales_s: [low, high], coefficients: [1.0, 0.0] }
    }

    #[test]
    fn a_wavelet_leaves_nothing() {
        let scale_s = 1.53;
        let mut velocity = vec![0.0; 4000];
        subtract(&mut velocity, DT_S, -2.0, 9.0, scale_s);
        // The search gives the centre to a part of the scale.
        let found = extract(&velocity, DT_S, &peak(9.03, 1.3, 1.8), Resolution::DEFAULT);
        assert!((found.period_s / (1.4 * scale_s) - 1.0).abs() < 0.02, "{}", found.period_s);
        assert!(energy(&found.residual) < 1e-3 * energy(&velocity));
    }

    #[test]
    fn every_wavelet_lowers_the_energy_also_at_the_ends_of_the_record() {
        let velocity: Vec<f64> =
            (0..2000).map(|i| (f64::from(i) * 0.011).sin() + (f64::from(i) * 0.0031).cos()).collect();
        for centre_s in [0.0, 0.3, 5.0, 9.995] {
            let found = extract(&velocity, DT_S, &peak(centre_s, 1.5, 2.5), Resolution::DEFAULT);
            assert!(energy(&found.residual) < energy(&velocity), "{centre_s}");
            assert!((2.1..=3.5).contains(&found.period_s));
        }
    }
}
