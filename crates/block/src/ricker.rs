//! Ricker wavelets: ground acceleration as the second or third derivative of a Gaussian.

use uplift_motion::Accelerogram;
use uplift_taylor::{Forcing, ORDER};

use crate::error::{BlockError, within};

/// Which derivative of the Gaussian the ground acceleration is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RickerShape {
    /// Second derivative (Eq. 2.7): aₚ(1 − z²) exp(−z²/2) with z = √2 π t/Tₚ.
    Symmetric,
    /// Third derivative (Eq. 2.8): (aₚ/βᵣ)(z² − 3) z exp(−z²/2) with z = 2π t/(√3 Tₚ).
    Antisymmetric,
}

/// A Ricker wavelet of acceleration amplitude aₚ and period Tₚ, centred at time zero.
///
/// It lasts from −3 Tₚ to 3 Tₚ, which the text does not say: outside, the acceleration is below 1e-22
/// aₚ, and taken as zero.
///
/// # Source
/// Reggiani Manzo, Eq. 2.7–2.9; N. Ricker (1943, 1944).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RickerPulse {
    shape: RickerShape,
    amplitude_m_s2: f64,
    period_s: f64,
}

/// Half the duration of a pulse in periods.
const HALF_DURATION_PERIODS: f64 = 3.0;

/// Pieces in a period. Over one, z grows by less than 0.3, and the Taylor series to [`ORDER`] is exact to rounding.
const PIECES_PER_PERIOD: u32 = 16;

/// βᵣ, which makes the largest acceleration of the antisymmetric wavelet aₚ; the text prints 1.3801.
///
/// It is the maximum of |z² − 3| |z| exp(−z²/2), at z² = 3 − √6.
pub const BETA_R: f64 = 1.380_119_046_160_749_3;

impl RickerPulse {
    /// The wavelet of amplitude aₚ \[m/s²\] (its sign turns the wavelet over) and period Tₚ \[s\].
    ///
    /// # Errors
    /// [`BlockError::OutOfRange`] unless |aₚ| ≤ 1e6 m/s² and 1e-6 s ≤ Tₚ ≤ 1e6 s.
    pub fn new(shape: RickerShape, amplitude_m_s2: f64, period_s: f64) -> Result<Self, BlockError> {
        let amplitude_m_s2 =
            within("pulse amplitude", amplitude_m_s2, "m/s2", -1e6..=1e6, "between -1e6 and 1e6 m/s2")?;
        let period_s = within("pulse period", period_s, "s", 1e-6..=1e6, "between 1e-6 s and 1e6 s")?;
        Ok(Self { shape, amplitude_m_s2, period_s })
    }

    /// Shape of the wavelet.
    pub fn shape(&self) -> RickerShape {
        self.shape
    }

    /// Largest ground acceleration aₚ \[m/s²\].
    pub fn amplitude_m_s2(&self) -> f64 {
        self.amplitude_m_s2
    }

    /// Period Tₚ \[s\].
    pub fn period_s(&self) -> f64 {
        self.period_s
    }

    /// Cyclic frequency ωₚ = 2π/Tₚ \[rad/s\] (Eq. 2.9).
    pub fn frequency_rad_s(&self) -> f64 {
        std::f64::consts::TAU / self.period_s
    }

    /// Ground acceleration at the time `t_s` from the centre \[m/s²\].
    pub fn acceleration_m_s2(&self, t_s: f64) -> f64 {
        if t_s.abs() > HALF_DURATION_PERIODS * self.period_s { 0.0 } else { self.taylor(t_s, 0.0).value(0.0) }
    }

    /// Largest ground displacement \[m\]: of the Gaussian itself, or of its first derivative.
    pub fn peak_ground_displacement_m(&self) -> f64 {
        let gaussian = self.amplitude_m_s2.abs() / self.rate().powi(2);
        match self.shape {
            RickerShape::Symmetric => gaussian,
            RickerShape::Antisymmetric => gaussian / BETA_R * (-0.5_f64).exp(),
        }
    }

    /// The wavelet as a record with `per_period` samples a period, which begins three periods before its centre.
    ///
    /// # Errors
    /// [`BlockError::OutOfRange`] unless there are 2 to 1e6 samples a period.
    pub fn sampled(&self, per_period: u32) -> Result<Accelerogram, BlockError> {
        within("samples per period", f64::from(per_period), "(pure number)", 2.0..=1e6, "between 2 and 1e6")?;
        let dt_s = self.period_s / f64::from(per_period);
        // whole half-durations from the centre, so that an antisymmetric wavelet stays so in every bit
        let half = 3 * per_period;
        let samples =
            (0..=2 * half).map(|i| self.taylor((f64::from(i) - f64::from(half)) * dt_s, 0.0).value(0.0)).collect();
        Ok(Accelerogram::new(dt_s, samples)?)
    }

    /// dz/dt \[1/s\].
    fn rate(&self) -> f64 {
        use std::f64::consts::{PI, SQRT_2, TAU};
        match self.shape {
            RickerShape::Symmetric => SQRT_2 * PI / self.period_s,
            RickerShape::Antisymmetric => TAU / (3.0_f64.sqrt() * self.period_s),
        }
    }

    pub(crate) fn start_s(&self) -> f64 {
        -HALF_DURATION_PERIODS * self.period_s
    }

    pub(crate) fn segments() -> usize {
        (2 * 3 * PIECES_PER_PERIOD) as usize
    }

    pub(crate) fn segment_s(&self) -> f64 {
        self.period_s / f64::from(PIECES_PER_PERIOD)
    }

    /// The acceleration \[m/s²\] around the time `t_s`, in powers of (time − t)/`step_s`.
    ///
    /// The n-th derivative of Heₘ(z) exp(−z²/2) is (−1)ⁿ Heₘ₊ₙ(z) exp(−z²/2), with the Hermite polynomials
    /// Heₙ₊₁ = z Heₙ − n Heₙ₋₁.
    pub(crate) fn taylor(&self, t_s: f64, step_s: f64) -> Forcing {
        let z = self.rate() * t_s;
        let ratio = -self.rate() * step_s;
        let gaussian = (-0.5 * z * z).exp();
        // the wavelets are −aₚ He₂ and aₚ/βᵣ He₃ times the Gaussian
        let (first, factor) = match self.shape {
            RickerShape::Symmetric => (2, -self.amplitude_m_s2),
            RickerShape::Antisymmetric => (3, self.amplitude_m_s2 / BETA_R),
        };
        let (mut before, mut hermite) = (1.0, z);
        let mut forcing = Forcing::default();
        let mut scale = factor * gaussian;
        for index in 1..first + ORDER {
            if index >= first {
                let k = index - first;
                forcing.push(scale * hermite);
                scale *= ratio / (k + 1) as f64;
            }
            (before, hermite) = (hermite, z * hermite - index as f64 * before);
        }
        forcing
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn printed(shape: RickerShape, t: f64) -> f64 {
        let q = 4.0 * PI * PI * t * t / 3.0;
        match shape {
            RickerShape::Symmetric => (1.0 - 2.0 * PI * PI * t * t) * (-PI * PI * t * t).exp(),
            RickerShape::Antisymmetric => (q - 3.0) * 2.0 * PI * t / 3.0_f64.sqrt() * (-0.5 * q).exp() / BETA_R,
        }
    }

    #[test]
    fn equations_2_7_and_2_8_and_their_series() {
        for shape in [RickerShape::Symmetric, RickerShape::Antisymmetric] {
            let pulse = RickerPulse::new(shape, 1.0, 1.0).unwrap();
            for i in -60..60 {
                let t = f64::from(i) / 20.0 + 0.013;
                assert!((pulse.acceleration_m_s2(t) - printed(shape, t)).abs() < 2e-15, "{shape:?} {t}");
                let step = pulse.segment_s();
                let series = pulse.taylor(t, step);
                for s in [0.3, 1.0] {
                    assert!((series.value(s) - printed(shape, t + s * step)).abs() < 4e-15, "{shape:?} {t} {s}");
                }
            }
        }
    }

    #[test]
    fn the_largest_acceleration_is_the_amplitude() {
        let at = (3.0 - 6.0_f64.sqrt()).sqrt();
        assert!(((at * at - 3.0) * at * (-0.5 * at * at).exp() + BETA_R).abs() < 1e-15);
        for shape in [RickerShape::Symmetric, RickerShape::Antisymmetric] {
            let pulse = RickerPulse::new(shape, 2.5, 0.4).unwrap();
            let record = pulse.sampled(2000).unwrap();
            let peak = record.acceleration_m_s2().iter().fold(0.0_f64, |p, a| p.max(a.abs()));
            assert!((peak / 2.5 - 1.0).abs() < 1e-5 && peak <= 2.5 * (1.0 + 1e-15), "{shape:?} {peak}");
            assert!((record.duration_s() - 2.4).abs() < 1e-12);
        }
    }

    #[test]
    fn peak_ground_displacement_is_that_of_the_double_integral() {
        for shape in [RickerShape::Symmetric, RickerShape::Antisymmetric] {
            let pulse = RickerPulse::new(shape, 3.0, 0.8).unwrap();
            let record = pulse.sampled(4000).unwrap();
            let (dt, mut v, mut u, mut peak) = (record.dt_s(), 0.0, 0.0, 0.0_f64);
            for ends in record.acceleration_m_s2().windows(2) {
                u += dt * v + dt * dt * (2.0 * ends[0] + ends[1]) / 6.0;
                v += 0.5 * dt * (ends[0] + ends[1]);
                peak = peak.max(u.abs());
            }
            assert!((peak / pulse.peak_ground_displacement_m() - 1.0).abs() < 1e-6, "{shape:?}");
        }
    }

    #[test]
    fn refuses_what_is_no_pulse() {
        for (amplitude, period) in [(f64::NAN, 1.0), (1e7, 1.0), (1.0, 0.0), (1.0, f64::INFINITY), (1.0, -1.0)] {
            assert!(RickerPulse::new(RickerShape::Symmetric, amplitude, period).is_err());
        }
        let message = RickerPulse::new(RickerShape::Symmetric, 1.0, 0.0).unwrap_err().to_string();
        assert_eq!(message, "pulse period is 0 s: it must be between 1e-6 s and 1e6 s");
        assert!(RickerPulse::new(RickerShape::Symmetric, 1.0, 1.0).unwrap().sampled(1).is_err());
    }
}
