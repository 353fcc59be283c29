//! Arias intensity and the significant durations defined by its growth.

use std::f64::consts::PI;

use crate::accelerogram::Accelerogram;

impl Accelerogram {
    /// Arias intensity \[m/s\], I = π/(2 g) ∫ a² dt, with the acceleration of gravity
    /// `gravity_m_s2` \[m/s²\]; the integral by the trapezoidal rule on the squared samples.
    ///
    /// The squares of the samples are the field's practice, and closer to the ground motion
    /// itself: a straight line between samples cuts the peaks of high-frequency motion, which
    /// weigh most here.
    ///
    /// # Source
    ///
    /// A. Arias, "A measure of earthquake intensity", in Seismic Design for Nuclear Power
    /// Plants, MIT Press, 1970.
    pub fn arias_intensity_m_s(&self, gravity_m_s2: f64) -> f64 {
        PI / (2.0 * gravity_m_s2) * self.squared_integral()
    }

    /// Cumulative absolute velocity \[m/s\], ∫ |a| dt; the integral by the trapezoidal rule on the
    /// samples.
    ///
    /// # Source
    ///
    /// Electric Power Research Institute, "A criterion for determining exceedance of the operating
    /// basis earthquake", report NP-5930, 1988.
    pub fn cumulative_absolute_velocity_m_s(&self) -> f64 {
        0.5 * self.dt_s() * self.intervals().map(|(a0, a1)| a0.abs() + a1.abs()).sum::<f64>()
    }

    /// Significant duration \[s\]: the time between the moments at which the Arias intensity
    /// has reached the fractions `from` and `to` (each in \[0, 1\]) of its final value; zero for
    /// a record without any acceleration.
    ///
    /// D5-75 is `significant_duration_s(0.05, 0.75)`, D5-95 is
    /// `significant_duration_s(0.05, 0.95)`.
    ///
    /// # Source
    ///
    /// M. D. Trifunac and A. G. Brady, Bull. Seism. Soc. Am. 65 (1975) 581–626.
    pub fn significant_duration_s(&self, from: f64, to: f64) -> f64 {
        self.arias_time_s(to) - self.arias_time_s(from)
    }

    /// Significant duration D5-75 \[s\].
    pub fn d5_75_s(&self) -> f64 {
        self.significant_duration_s(0.05, 0.75)
    }

    /// Significant duration D5-95 \[s\].
    pub fn d5_95_s(&self) -> f64 {
        self.significant_duration_s(0.05, 0.95)
    }

    /// Earliest time \[s\] at which the Arias intensity has reached `fraction` (in \[0, 1\]) of
    /// its final value, which grows evenly inside an interval; zero for a record without any
    /// acceleration.
    pub fn arias_time_s(&self, fraction: f64) -> f64 {
        let mut missing = fraction * self.squared_integral();
        let mut last_s = 0.0;
        for (i, (a0, a1)) in self.intervals().enumerate() {
            if missing <= 0.0 {
                break;
            }
            let gain = self.dt_s() * mean_square(a0, a1);
            if missing < gain {
                return (i as f64 + missing / gain) * self.dt_s();
            }
            missing -= gain;
            if gain > 0.0 {
                last_s = (i + 1) as f64 * self.dt_s();
            }
        }
        last_s
    }

    /// ∫ a² dt \[m²/s³\].
    fn squared_integral(&self) -> f64 {
        let mean_squares = self.intervals().map(|(a0, a1)| mean_square(a0, a1));
        self.dt_s() * mean_squares.sum::<f64>()
    }
}

/// Mean of the squares at both ends of an interval.
fn mean_square(a0: f64, a1: f64) -> f64 {
    0.5 * (a0 * a0 + a1 * a1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn motion(dt_s: f64, acceleration_m_s2: Vec<f64>) -> Accelerogram {
        Accelerogram::new(dt_s, acceleration_m_s2).unwrap()
    }

    #[test]
    fn constant_acceleration_grows_evenly() {
        let m = motion(0.1, vec![-2.0; 101]);
        let arias = m.arias_intensity_m_s(10.0);
        assert!((arias - PI / 20.0 * 4.0 * 10.0).abs() < 1e-13, "{arias}");
        assert!((m.arias_time_s(0.05) - 0.5).abs() < 1e-13);
        assert!((m.d5_75_s() - 7.0).abs() < 1e-12);
        assert!((m.d5_95_s() - 9.0).abs() < 1e-12);
    }

    #[test]
    fn a_triangle_by_hand() {
        // Squares 0, 1, 4, 1, 0: trapezoids of 0.5, 2.5, 2.5, 0.5, together 6.
        let m = motion(1.0, vec![0.0, 1.0, -2.0, 1.0, 0.0]);
        assert!((m.arias_intensity_m_s(PI) - 3.0).abs() < 1e-15);
        for (fraction, time_s) in [(0.25 / 6.0, 0.5), (0.5 / 6.0, 1.0), (0.5, 2.0), (0.75, 2.6)] {
            assert!((m.arias_time_s(fraction) - time_s).abs() < 1e-14, "{fraction}");
        }
    }

    #[test]
    fn a_sine_over_whole_cycles_is_summed_exactly() {
        // ∫ sin² over n cycles is half the duration; equal samples of it sum without error.
        let m = motion(0.1, (0..=200).map(|i| (f64::from(i) * PI / 10.0).sin()).collect());
        assert!((m.arias_intensity_m_s(PI) - 0.5 * 10.0).abs() < 1e-12);
    }

    #[test]
    fn ends_and_silence() {
        let m = motion(1.0, vec![0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        assert_eq!(m.arias_time_s(0.0), 0.0);
        assert_eq!(m.arias_time_s(1.0), 3.0);
        let silent = motion(1.0, vec![0.0; 4]);
        assert_eq!((silent.arias_intensity_m_s(9.81), silent.d5_95_s()), (0.0, 0.0));
    }

    proptest! {
        #[test]
        fn durations_are_ordered_and_do_not_depend_on_the_scale(
            samples in prop::collection::vec(-5.0..5.0_f64, 2..60), exponent in -6..6_i32,
        ) {
            let m = motion(0.01, samples);
            let (d75, d95) = (m.d5_75_s(), m.d5_95_s());
            prop_assert!(0.0 <= d75 && d75 <= d95 && d95 <= m.duration_s());
            let factor = 2.0_f64.powi(exponent);
            let scaled = m.scaled(factor).unwrap();
            prop_assert!((scaled.d5_95_s() - d95).abs() < 1e-12);
            prop_assert_eq!(scaled.arias_intensity_m_s(9.81), factor * factor * m.arias_intensity_m_s(9.81));
        }

        #[test]
        fn the_time_of_a_fraction_gives_the_fraction_back(
            samples in prop::collection::vec(-5.0..5.0_f64, 2..40), fraction in 0.01..0.99_f64,
        ) {
            let m = motion(0.01, samples);
            let t = m.arias_time_s(fraction);
            // ∫ a² dt up to t, by hand
            let sum: f64 = m.intervals().enumerate().map(|(i, (a0, a1))| {
                (t - 0.01 * i as f64).clamp(0.0, 0.01) * mean_square(a0, a1)
            }).sum();
            let total = m.squared_integral();
            prop_assume!(total > 0.0);
            prop_assert!((sum / total - fraction).abs() < 1e-10);
        }
    }
}
