//! The filtered white noise: frequency content that moves with time.

use super::complex::Complex;
use super::parameters::Parameters;
use std::f64::consts::TAU;

/// Bounds of the filter's frequency \[Hz\]. The lower one is the model's; the upper one keeps four
/// samples to a cycle at a time step of 0.01 s.
const FREQUENCY_HZ: (f64, f64) = (0.3, 25.0);

/// A pulse's response is followed until it has fallen to e^−28 (7e-13) of its start.
const DECAY_EXPONENT: f64 = 28.0;

/// Steps of a pulse's response taken side by side.
const LANES: usize = 4;

/// Two independent realisations of the filtered noise, with unit variance at each time but the
/// first, where they are zero.
///
/// u(t) = (1/σ(t)) Σ h(t − τᵢ, λ(τᵢ)) wᵢ over the pulses τᵢ < t, one at each sample; h is the
/// pseudo-acceleration response of a damped oscillator,
/// h(s) = ω/√(1 − ζ²) e^(−ζ ω s) sin(ω √(1 − ζ²) s), and σ² the sum of h². `noise` are the w of
/// the two realisations.
///
/// # Source
///
/// Rezaeian & Der Kiureghian (2010).
pub(super) fn filtered_noise(parameters: &Parameters, dt_s: f64, noise: [&[f64]; 2]) -> [Vec<f64>; 2] {
    let [w1, w2] = noise;
    let count = w1.len().min(w2.len());
    // Room for the last block of a pulse; cut off at the end.
    let mut first = vec![0.0; count + LANES];
    let mut second = first.clone();
    let mut variance = first.clone();
    let damping = parameters.damping;
    let damped = (1.0 - damping * damping).sqrt();
    for pulse in 0..count {
        let omega = TAU * frequency_hz(parameters, pulse as f64 * dt_s);
        // The oscillator's free motion, turned and shrunk by one complex factor a step; several
        // steps side by side, for the processor to work on them at once.
        let turn = Complex(-damping, damped).scaled(omega * dt_s).exponential();
        let mut h = [Complex(omega / damped, 0.0).times(turn); LANES];
        let mut block_turn = turn;
        for lane in 1..LANES {
            h[lane] = h[lane - 1].times(turn);
            block_turn = block_turn.times(turn);
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive, saturating
        let steps = (DECAY_EXPONENT / (damping * omega * dt_s)).ceil() as usize;
        let after = pulse + 1;
        let end = after + steps.min(count - after).next_multiple_of(LANES);
        let blocks = first[after..end].as_chunks_mut::<LANES>().0.iter_mut();
        let blocks = blocks.zip(second[after..end].as_chunks_mut::<LANES>().0);
        for ((y1, y2), v) in blocks.zip(variance[after..end].as_chunks_mut::<LANES>().0) {
            for lane in 0..LANES {
                let Complex(_, response) = h[lane];
                y1[lane] += w1[pulse] * response;
                y2[lane] += w2[pulse] * response;
                v[lane] += response * response;
                h[lane] = h[lane].times(block_turn);
            }
        }
    }
    first.truncate(count);
    second.truncate(count);
    for ((y1, y2), v) in first.iter_mut().zip(&mut second).zip(&variance).skip(1) {
        let scale = 1.0 / v.sqrt();
        *y1 *= scale;
        *y2 *= scale;
    }
    [first, second]
}

/// Frequency of the filter at `time_s` \[Hz\].
fn frequency_hz(parameters: &Parameters, time_s: f64) -> f64 {
    let linear = parameters.f_mid_hz + parameters.f_slope_hz_s * (time_s - parameters.t_mid_s);
    linear.clamp(FREQUENCY_HZ.0, FREQUENCY_HZ.1)
}

#[cfg(test)]
mod tests {
    use super::super::random::RandomStream;
    use super::*;

    const PARAMETERS: Parameters =
        Parameters { ln_arias: -3.0, d5_95_s: 12.0, t_mid_s: 6.0, f_mid_hz: 4.0, f_slope_hz_s: -0.3, damping: 0.2 };

    /// The direct sum, written from the definition.
    fn direct(parameters: &Parameters, dt: f64, w: &[f64]) -> Vec<f64> {
        let h = |s: f64, tau: f64| {
            let omega = TAU * frequency_hz(parameters, tau);
            let damped = (1.0 - parameters.damping.powi(2)).sqrt();
            omega / damped * (-parameters.damping * omega * s).exp() * (omega * damped * s).sin()
        };
        (0..w.len())
            .map(|k| {
                let terms = (0..k).map(|i| h((k - i) as f64 * dt, i as f64 * dt));
                let sigma = terms.clone().map(|h| h * h).sum::<f64>().sqrt();
                if k == 0 { 0.0 } else { terms.zip(w).map(|(h, w)| h * w).sum::<f64>() / sigma }
            })
            .collect()
    }

    #[test]
    fn equals_the_direct_sum() {
        let mut stream = RandomStream::new(3, 0);
        let w: Vec<f64> = (0..1200).map(|_| stream.normal()).collect();
        let reversed: Vec<f64> = w.iter().rev().copied().collect();
        for damping in [0.02, 0.2, 0.95] {
            let parameters = Parameters { damping, ..PARAMETERS };
            let filtered = filtered_noise(&parameters, 0.01, [&w, &reversed]);
            for (ours, w) in filtered.iter().zip([&w, &reversed]) {
                for (a, b) in ours.iter().zip(direct(&parameters, 0.01, w)) {
                    assert!((a - b).abs() < 1e-10, "{damping}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn frequency_is_linear_within_its_bounds() {
        assert_eq!(frequency_hz(&PARAMETERS, 6.0), 4.0);
        assert!((frequency_hz(&PARAMETERS, 10.0) - 2.8).abs() < 1e-12);
        assert_eq!(frequency_hz(&PARAMETERS, 100.0), 0.3);
        let steep = Parameters { f_slope_hz_s: -2.0, t_mid_s: 40.0, ..PARAMETERS };
        assert_eq!(frequency_hz(&steep, 0.0), 25.0);
    }

    /// Over 4000 realisations of the noise: mean 0 and variance 1 at each of a few times.
    #[test]
    fn has_unit_variance_at_every_time() {
        let (count, runs) = (400, 2000);
        let mut stream = RandomStream::new(11, 0);
        let mut sums = vec![(0.0, 0.0); count];
        for _ in 0..runs {
            let w: Vec<f64> = (0..count).map(|_| stream.normal()).collect();
            let v: Vec<f64> = (0..count).map(|_| stream.normal()).collect();
            for realisation in filtered_noise(&PARAMETERS, 0.01, [&w, &v]) {
                for (sum, u) in sums.iter_mut().zip(realisation) {
                    sum.0 += u;
                    sum.1 += u * u;
                }
            }
        }
        let n = f64::from(2 * runs);
        for index in [1, 2, 10, 50, 150, 399] {
            let (mean, variance) = (sums[index].0 / n, sums[index].1 / n);
            assert!(mean.abs() < 4.0 / n.sqrt(), "mean at {index}: {mean}");
            assert!((variance - 1.0).abs() < 4.0 * (2.0 / n).sqrt(), "variance at {index}: {variance}");
        }
    }

    /// Up-crossings of zero of the stationary pseudo-acceleration come at the oscillator's
    /// undamped frequency.
    #[test]
    fn crosses_zero_at_the_frequency_of_the_filter() {
        let stationary = Parameters { f_slope_hz_s: 0.0, ..PARAMETERS };
        let (count, dt) = (40_000, 0.005);
        let mut stream = RandomStream::new(5, 0);
        let w: Vec<f64> = (0..count).map(|_| stream.normal()).collect();
        let [u, _] = filtered_noise(&stationary, dt, [&w, &w]);
        let crossings = u.windows(2).filter(|p| p[0] < 0.0 && p[1] >= 0.0).count();
        let rate = crossings as f64 / (f64::from(count) * dt);
        assert!((rate / 4.0 - 1.0).abs() < 0.05, "{rate} Hz");
    }
}
