//! The high-pass filter that brings the ground to rest.

use super::complex::Complex;

/// Filters `acceleration` in place: the acceleration of a critically damped oscillator of
/// frequency `corner_hz` \[Hz\] that starts at rest and is driven by it.
///
/// z̈ + 2 ω ż + ω² z = x(t), result z̈. As z and its velocity decay after x has ended, the filtered
/// motion ends with neither velocity nor displacement, given time: the velocity falls like
/// ω t e^(−ω t). Exact for x linear between samples.
///
/// # Source
///
/// Rezaeian & Der Kiureghian (2010).
pub(super) fn high_pass(acceleration: &mut [f64], dt_s: f64, corner_hz: f64) {
    let omega = std::f64::consts::TAU * corner_hz;
    let Complex(decay, _) = Complex(-omega * dt_s, 0.0).exponential();
    // Duhamel's integral over a step, ∫ r e^(−ω r) x dr for z and ∫ (1 − ω r) e^(−ω r) x dr for
    // its velocity, with x = x₁ − (x₁ − x₀) r/dt at the time r before the step's end. (The closed
    // form of the step subtracts terms a thousand times larger than what is left.)
    let [i0, i1, i2] = [0, 1, 2].map(|power| moment(power, omega * dt_s, dt_s));
    let (z_end, z_change) = (i1, i2 / dt_s);
    let (velocity_end, velocity_change) = (i0 - omega * i1, (i1 - omega * i2) / dt_s);
    let (mut z, mut velocity, mut previous) = (0.0, 0.0, 0.0);
    for x in acceleration {
        let change = *x - previous;
        let free = velocity + omega * z;
        (z, velocity) = (
            (z + free * dt_s) * decay + z_end * *x - z_change * change,
            (velocity - omega * free * dt_s) * decay + velocity_end * *x - velocity_change * change,
        );
        previous = *x;
        *x -= omega * (2.0 * velocity + omega * z);
    }
}

/// ∫ rⁿ e^(−ω r) dr from 0 to dt, n = `power`, for y = ω dt far below one: the power series
/// dtⁿ⁺¹ Σ (−y)ᵏ/(k! (n + 1 + k)).
fn moment(power: i32, y: f64, dt_s: f64) -> f64 {
    let mut term = 1.0;
    let mut sum = 0.0;
    for k in 0..10 {
        sum += term / f64::from(power + 1 + k);
        term *= -y / f64::from(k + 1);
    }
    sum * (0..=power).fold(1.0, |product, _| product * dt_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Steady state of a sine: amplitude gain r²/(1 + r²), r the frequency over the corner.
    #[test]
    fn gain_is_that_of_the_critically_damped_oscillator() {
        let dt = 0.002;
        for frequency in [0.05, 0.2, 1.0, 5.0] {
            let mut x: Vec<f64> = (0..60_000).map(|i| (TAU * frequency * f64::from(i) * dt).sin()).collect();
            high_pass(&mut x, dt, 0.2);
            let peak = x[30_000..].iter().fold(0.0_f64, |m, a| m.max(a.abs()));
            let r: f64 = frequency / 0.2;
            assert!((peak / (r * r / (1.0 + r * r)) - 1.0).abs() < 1e-3, "{frequency}: {peak}");
        }
    }

    /// A constant from the first sample on: z̈ = (1 − ω t) e^(−ω t), but for the ramp of one step
    /// before it.
    #[test]
    fn step_response() {
        let (dt, corner) = (1e-4, 0.2);
        let mut x = vec![1.0; 60_000];
        high_pass(&mut x, dt, corner);
        for i in [0_usize, 1000, 10_000, 50_000] {
            let s = TAU * corner * i as f64 * dt;
            assert!((x[i] - (1.0 - s) * (-s).exp()).abs() < 3e-4, "{i}");
        }
    }
}
