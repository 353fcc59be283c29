//! Peak ground acceleration, velocity and displacement.

use crate::accelerogram::Accelerogram;

impl Accelerogram {
    /// Peak ground acceleration, max |a| \[m/s²\].
    pub fn pga_m_s2(&self) -> f64 {
        largest_magnitude(self.acceleration_m_s2().iter().copied())
    }

    /// Peak ground velocity, max |v| over the samples \[m/s\], of the trapezoidal integral of
    /// the acceleration as it is given: from rest, no baseline correction.
    ///
    /// At the samples the integral is exact for an acceleration that is linear between them;
    /// the measure does not look for a larger value between two samples.
    pub fn pgv_m_s(&self) -> f64 {
        largest_magnitude(self.velocity_m_s().into_iter())
    }

    /// Ground velocity at every sample \[m/s\], from rest; what [`Accelerogram::pgv_m_s`] is the peak of.
    pub fn velocity_m_s(&self) -> Vec<f64> {
        integral(self.acceleration_m_s2(), self.dt_s())
    }

    /// Ground velocity at the last sample \[m/s\]: that of a record with a sound baseline is small
    /// against its PGV.
    pub fn residual_velocity_m_s(&self) -> f64 {
        self.intervals().fold(0.0, |velocity_m_s, (a0, a1)| velocity_m_s + 0.5 * self.dt_s() * (a0 + a1))
    }

    /// Peak ground displacement, max |u| \[m\], of the exact double integral from rest of the
    /// piecewise linear acceleration (a cubic inside each interval), no baseline correction.
    ///
    /// A peak between two samples counts. This is the largest displacement of a free mass
    /// (strength zero) relative to the ground, within the duration of the record.
    pub fn pgd_m(&self) -> f64 {
        let dt_s = self.dt_s();
        let (mut u, mut v) = (0.0_f64, 0.0_f64);
        let mut peak_m = 0.0_f64;
        for (a0, a1) in self.intervals() {
            // s in [0, 1] is the time inside the interval in units of dt.
            let velocity = [v, dt_s * a0, 0.5 * dt_s * (a1 - a0)];
            let displacement = |s: f64| u + dt_s * s * (velocity[0] + s * (velocity[1] / 2.0 + s * velocity[2] / 3.0));
            for s in roots(velocity).into_iter().filter(|s| (0.0..1.0).contains(s)) {
                peak_m = peak_m.max(displacement(s).abs());
            }
            u = displacement(1.0);
            v += 0.5 * dt_s * (a0 + a1);
            peak_m = peak_m.max(u.abs());
        }
        peak_m
    }

    /// Values at both ends of every interval \[m/s²\].
    pub(crate) fn intervals(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.acceleration_m_s2().windows(2).map(|ends| (ends[0], ends[1]))
    }
}

pub(crate) fn largest_magnitude(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |largest, value| value.abs().max(largest))
}

/// Integral of a signal, linear between its samples, from the first to every sample.
pub(crate) fn integral(signal: &[f64], dt_s: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let steps = signal.windows(2).map(|ends| {
        sum += 0.5 * dt_s * (ends[0] + ends[1]);
        sum
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// Real roots of c0 + c1 s + c2 s², without cancellation; NaN or infinite where there is none.
fn roots([c0, c1, c2]: [f64; 3]) -> [f64; 2] {
    let q = -0.5 * (c1 + (c1 * c1 - 4.0 * c2 * c0).sqrt().copysign(c1));
    [q / c2, c0 / q]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn motion(dt_s: f64, acceleration_m_s2: &[f64]) -> Accelerogram {
        Accelerogram::new(dt_s, acceleration_m_s2.to_vec()).unwrap()
    }

    fn assert_close(found: f64, expected: f64, relative: f64) {
        assert!((found - expected).abs() <= relative * expected.abs(), "found {found}, expected {expected}");
    }

    #[test]
    fn constant_acceleration() {
        // a over T, and nothing after: v = a T, u = a T²/2.
        let m = motion(0.25, &[3.0; 9]);
        assert_eq!(m.pga_m_s2(), 3.0);
        assert_close(m.pgv_m_s(), 6.0, 1e-15);
        assert_close(m.pgd_m(), 6.0, 1e-15);
    }

    #[test]
    fn constant_acceleration_then_rest() {
        // Nine samples of a, then zeros. The ramp down in the tenth interval adds a h/2 to the
        // velocity and a h²/3 to the displacement; then the ground coasts for n intervals.
        let (a, h, n) = (-3.0, 0.25, 7);
        let mut samples = vec![a; 9];
        samples.extend(vec![0.0; n + 1]);
        let m = motion(h, &samples);
        let v0 = 8.0 * a * h;
        let v = v0 + a * h / 2.0;
        let u = a * (8.0 * h) * (8.0 * h) / 2.0 + v0 * h + a * h * h / 3.0 + v * h * n as f64;
        assert_close(m.pgv_m_s(), -v, 1e-15);
        assert_close(m.pgd_m(), -u, 1e-14);
    }

    #[test]
    fn peaks_between_samples() {
        // v(s) = a h (s - s²) in the first interval returns to rest at its end; then
        // a from -a to 0: v = -a h (s - s²/2), ends at -a h/2. Displacement: a h²/6 at h,
        // a h²/6 - a h² (1/2 - 1/6) = -a h²/6 at 2 h.
        let (a, h) = (6.0, 0.5);
        let m = motion(h, &[a, -a, 0.0]);
        assert_close(m.pgv_m_s(), a * h / 2.0, 1e-15);
        assert_close(m.pgd_m(), a * h * h / 6.0, 1e-15);

        // One interval from a to -3 a: v = a h (s - 2 s²) is zero at s = 1/2, where
        // u = a h² (1/8 - 1/12) = a h²/24; at the end u = a h² (1/2 - 2/3) = -a h²/6.
        // Stop the decay before the end value wins: from a to -1.6 a it is
        // v = a h (s - 1.3 s²), s = 1/1.3, u = a h²/(6·1.69); at the end a h² (1/2 - 1.3/3).
        let m = motion(h, &[a, -1.6 * a]);
        let at_end = a * h * h * (0.5 - 1.3 / 3.0);
        let inside = a * h * h / (6.0 * 1.69);
        assert!(inside > at_end);
        assert_close(m.pgd_m(), inside, 1e-14);
    }

    #[test]
    fn sine() {
        // a = A sin ωt over whole cycles: max v = 2A/ω at half a cycle, and u grows to
        // A T/ω at the end; the sampled sine differs by O((ω h)²/12).
        let (amplitude, period_s, cycles, per_cycle) = (2.0, 0.8, 5, 400);
        let omega = std::f64::consts::TAU / period_s;
        let h = period_s / f64::from(per_cycle);
        let samples: Vec<f64> =
            (0..=cycles * per_cycle).map(|i| amplitude * (omega * h * f64::from(i)).sin()).collect();
        let m = motion(h, &samples);
        let tolerance = (omega * h).powi(2) / 10.0;
        assert_close(m.pga_m_s2(), amplitude, 1e-12);
        assert_close(m.pgv_m_s(), 2.0 * amplitude / omega, tolerance);
        assert_close(m.pgd_m(), amplitude * period_s * f64::from(cycles) / omega, tolerance);
    }

    #[test]
    fn no_motion() {
        let m = motion(0.01, &[0.0; 5]);
        assert_eq!((m.pga_m_s2(), m.pgv_m_s(), m.pgd_m()), (0.0, 0.0, 0.0));
    }

    proptest! {
        #[test]
        fn pgd_is_that_of_the_densely_sampled_cubic(
            samples in prop::collection::vec(-5.0..5.0_f64, 2..12),
        ) {
            let h = 0.1;
            let m = motion(h, &samples);
            let (mut u, mut v, mut peak) = (0.0_f64, 0.0_f64, 0.0_f64);
            for (a0, a1) in m.intervals() {
                for k in 0..=1000 {
                    let t = h * f64::from(k) / 1000.0;
                    peak = peak.max((u + v * t + a0 * t * t / 2.0 + (a1 - a0) * t.powi(3) / (6.0 * h)).abs());
                }
                u += v * h + (2.0 * a0 + a1) * h * h / 6.0;
                v += (a0 + a1) * h / 2.0;
            }
            // Between the dense points lies at most |a|max (h/2000)²/2.
            prop_assert!(m.pgd_m() >= peak - 1e-13);
            prop_assert!(m.pgd_m() <= peak + 5.0 * (h / 2000.0).powi(2) / 2.0 + 1e-13);
        }

        #[test]
        fn a_finer_sampling_of_the_same_motion_changes_nothing(
            samples in prop::collection::vec(-5.0..5.0_f64, 2..30),
        ) {
            let coarse = motion(0.02, &samples);
            let mut fine = vec![samples[0]];
            for (a0, a1) in coarse.intervals() {
                fine.extend([a0 + 0.25 * (a1 - a0), 0.5 * (a0 + a1), a0 + 0.75 * (a1 - a0), a1]);
            }
            let fine = motion(0.005, &fine);
            prop_assert!((fine.pgd_m() - coarse.pgd_m()).abs() <= 1e-12 * coarse.pgd_m().max(1e-6));
            prop_assert!(fine.pgv_m_s() >= coarse.pgv_m_s() * (1.0 - 1e-12));
            prop_assert_eq!(fine.pga_m_s2(), coarse.pga_m_s2());
        }

        #[test]
        fn all_are_linear_in_the_scale_and_even(
            samples in prop::collection::vec(-5.0..5.0_f64, 2..50), exponent in -8..8_i32, sign in prop::bool::ANY,
        ) {
            // A power of two scales without rounding: the measures scale exactly.
            let factor = 2.0_f64.powi(exponent) * if sign { 1.0 } else { -1.0 };
            let m = motion(0.01, &samples);
            let scaled = m.scaled(factor).unwrap();
            prop_assert_eq!(scaled.pga_m_s2(), factor.abs() * m.pga_m_s2());
            prop_assert_eq!(scaled.pgv_m_s(), factor.abs() * m.pgv_m_s());
            prop_assert_eq!(scaled.pgd_m(), factor.abs() * m.pgd_m());
        }
    }
}
