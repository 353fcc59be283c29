//! Named problems with known answers, shared by docs, tests and benchmarks.

use std::f64::consts::PI;

/// The symmetric Ricker pulse (Eq. 2.7), `a_g(t) = a_p (1 − s²) exp(−s²/2)`, `s = √2 π (t − t_c)/T_p`, sampled over
/// `0 … 2 t_c`.
///
/// * `amplitude_m_s2` — `a_p`, m/s²
/// * `period_s` — `T_p`, s
/// * `dt_s` — sampling interval, s
/// * `samples` — number of samples; the pulse is centred among them
pub fn symmetric_ricker_pulse(amplitude_m_s2: f64, period_s: f64, dt_s: f64, samples: usize) -> Vec<f64> {
    let centre = 0.5 * (samples.max(1) - 1) as f64;
    (0..samples)
        .map(|i| {
            let s = 2.0_f64.sqrt() * PI * (i as f64 - centre) * dt_s / period_s;
            amplitude_m_s2 * (1.0 - s * s) * (-0.5 * s * s).exp()
        })
        .collect()
}

/// Broad-band noise of bounded amplitude (m/s²) from a fixed multiplicative congruential generator, shaped by a half
/// sine in time: an event-rich excitation that is the same on every machine.
pub fn shaped_noise(amplitude_m_s2: f64, samples: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(2).wrapping_add(1);
    (0..samples)
        .map(|i| {
            // multiplier of L'Ecuyer (1999) for modulus 2^64; the high bits are the good ones
            state = state.wrapping_mul(0xf135_7aea_2e62_a9c5);
            let uniform = (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
            let envelope = (PI * i as f64 / samples.max(2) as f64).sin();
            2.0 * amplitude_m_s2 * envelope * uniform
        })
        .collect()
}
