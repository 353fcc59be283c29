//! Pulses of ground acceleration with a beginning and an end.

use std::f64::consts::{FRAC_PI_2, TAU};

use uplift_taylor::{Forcing, ORDER};

use crate::error::{FrameError, within};

/// Shape of a pulse of amplitude `A` and period `T`, with `τ = (t − start)/T`; zero outside the range of `τ`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PulseShape {
    /// `A sin 2πτ`, `0 ≤ τ ≤ 1`.
    Sine,
    /// `A cos 2πτ`, `0 ≤ τ ≤ 1`.
    Cosine,
    /// `A sin 2πτ`, `0 ≤ τ ≤ ½`.
    HalfSine,
    /// `A (1 − w²) exp(−w²/2)`, `w = 2π (τ − 1.25)`, `0 ≤ τ ≤ 2.5`.
    Ricker,
}

/// A pulse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    shape: PulseShape,
    amplitude_m_s2: f64,
    period_s: f64,
    start_s: f64,
}

/// Pieces in a period: over one the series of degree 24 is exact to rounding.
const PIECES_PER_PERIOD: u32 = 16;

impl Pulse {
    /// From its shape, its amplitude (m/s²; the sign turns it over), its period (s) and when it begins (s).
    ///
    /// # Errors
    /// The amplitude must be within ±1e6 m/s², the period between 1e-6 and 1e6 s, the start between 0 and 1e6 s.
    pub fn new(shape: PulseShape, amplitude_m_s2: f64, period_s: f64, start_s: f64) -> Result<Self, FrameError> {
        within("pulse amplitude", amplitude_m_s2, "m/s2", -1e6..=1e6, "between -1e6 and 1e6 m/s2")?;
        within("pulse period", period_s, "s", 1e-6..=1e6, "between 1e-6 and 1e6 s")?;
        within("pulse start", start_s, "s", 0.0..=1e6, "between 0 and 1e6 s")?;
        Ok(Self { shape, amplitude_m_s2, period_s, start_s })
    }

    /// Amplitude `A`, m/s².
    pub fn amplitude_m_s2(&self) -> f64 {
        self.amplitude_m_s2
    }

    /// When it begins, s.
    pub fn start_s(&self) -> f64 {
        self.start_s
    }

    /// When it ends, s.
    pub fn end_s(&self) -> f64 {
        self.start_s + self.periods() * self.period_s
    }

    fn periods(&self) -> f64 {
        match self.shape {
            PulseShape::Sine | PulseShape::Cosine => 1.0,
            PulseShape::HalfSine => 0.5,
            PulseShape::Ricker => 2.5,
        }
    }

    /// Ends of the pieces on which it is given by a series, s.
    pub(crate) fn knots_s(&self) -> impl Iterator<Item = f64> + '_ {
        let pieces = match self.shape {
            PulseShape::Sine | PulseShape::Cosine => PIECES_PER_PERIOD,
            PulseShape::HalfSine => PIECES_PER_PERIOD / 2,
            PulseShape::Ricker => PIECES_PER_PERIOD * 5 / 2,
        };
        let piece_s = self.period_s / f64::from(PIECES_PER_PERIOD);
        (0..=pieces).map(move |piece| self.start_s + f64::from(piece) * piece_s)
    }

    /// Whether `other` is a multiple of this one.
    pub(crate) fn is_parallel_to(&self, other: &Self) -> bool {
        Self { amplitude_m_s2: 0.0, ..*self } == Self { amplitude_m_s2: 0.0, ..*other }
    }

    /// The acceleration (m/s²) around the time `t_s` within the pulse, in powers of `(time − t)/step`.
    pub(crate) fn taylor(&self, t_s: f64, step_s: f64) -> Forcing {
        let phase = TAU * (t_s - self.start_s) / self.period_s;
        let rate = TAU * step_s / self.period_s;
        match self.shape {
            PulseShape::Sine | PulseShape::HalfSine => self.harmonic(phase, rate),
            PulseShape::Cosine => self.harmonic(phase + FRAC_PI_2, rate),
            PulseShape::Ricker => self.gaussian(phase - 1.25 * TAU, rate),
        }
    }

    fn harmonic(&self, phase: f64, rate: f64) -> Forcing {
        let (sin, cos) = phase.sin_cos();
        let mut forcing = Forcing::default();
        let mut scale = self.amplitude_m_s2;
        for k in 0..=ORDER {
            forcing.push(scale * [sin, cos, -sin, -cos][k % 4]);
            scale *= rate / (k + 1) as f64;
        }
        forcing
    }

    /// The n-th derivative of He₂(w) exp(−w²/2) is (−1)ⁿ He₂₊ₙ(w) exp(−w²/2), with the Hermite polynomials
    /// Heₙ₊₁ = w Heₙ − n Heₙ₋₁.
    fn gaussian(&self, w: f64, rate: f64) -> Forcing {
        let (mut before, mut hermite) = (w, w * w - 1.0);
        let mut forcing = Forcing::default();
        let mut scale = -self.amplitude_m_s2 * (-0.5 * w * w).exp();
        for k in 0..=ORDER {
            forcing.push(scale * hermite);
            scale *= -rate / (k + 1) as f64;
            (before, hermite) = (hermite, w * hermite - (k + 2) as f64 * before);
        }
        forcing
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(shape: PulseShape, tau: f64) -> f64 {
        let w = TAU * (tau - 1.25);
        match shape {
            PulseShape::Sine | PulseShape::HalfSine => (TAU * tau).sin(),
            PulseShape::Cosine => (TAU * tau).cos(),
            PulseShape::Ricker => (1.0 - w * w) * (-0.5 * w * w).exp(),
        }
    }

    #[test]
    fn a_series_is_the_pulse_over_a_piece() {
        for shape in [PulseShape::Sine, PulseShape::Cosine, PulseShape::HalfSine, PulseShape::Ricker] {
            let pulse = Pulse::new(shape, 3.0, 0.7, 0.2).unwrap();
            let knots: Vec<f64> = pulse.knots_s().collect();
            assert!((knots[knots.len() - 1] - pulse.end_s()).abs() < 1e-15 && knots[0] == 0.2);
            for ends in knots.windows(2) {
                let series = pulse.taylor(ends[0], ends[1] - ends[0]);
                for s in [0.0, 0.4, 1.0] {
                    let tau = (ends[0] + s * (ends[1] - ends[0]) - 0.2) / 0.7;
                    let error = series.value(s) - 3.0 * printed(shape, tau);
                    assert!(error.abs() < 1e-14, "{shape:?} at {tau}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn refuses_what_is_no_pulse() {
        for (amplitude, period, start) in [(f64::NAN, 1.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, -1.0), (2e6, 1.0, 0.0)] {
            assert!(Pulse::new(PulseShape::Sine, amplitude, period, start).is_err());
        }
    }
}
