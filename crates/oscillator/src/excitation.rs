//! A ground acceleration history and its scale.

use crate::error::{OscillatorError, require, require_positive};

/// A uniformly sampled ground acceleration, linear between samples, zero after the last one, times a scale factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excitation<'a> {
    dt_s: f64,
    acceleration_m_s2: &'a [f64],
    scale: f64,
}

impl<'a> Excitation<'a> {
    /// The history `acceleration_m_s2` (m/s²) sampled every `dt_s` seconds from `t = 0`, unscaled.
    ///
    /// # Errors
    /// The sampling interval must be finite and positive; at least two samples are needed and each must be finite.
    pub fn new(dt_s: f64, acceleration_m_s2: &'a [f64]) -> Result<Self, OscillatorError> {
        require_positive("dt_s", dt_s, "s")?;
        if acceleration_m_s2.len() < 2 {
            return Err(OscillatorError::TooFewSamples { samples: acceleration_m_s2.len() });
        }
        if let Some((index, &value)) = acceleration_m_s2.iter().enumerate().find(|(_, a)| !a.is_finite()) {
            return Err(OscillatorError::NotFinite { index, value });
        }
        Ok(Self { dt_s, acceleration_m_s2, scale: 1.0 })
    }

    /// The same history multiplied by `scale`.
    ///
    /// # Errors
    /// The scale factor must be finite.
    pub fn scaled(self, scale: f64) -> Result<Self, OscillatorError> {
        require(scale.is_finite(), "scale", scale, "", "finite")?;
        Ok(Self { scale: self.scale * scale, ..self })
    }

    /// Sampling interval, s.
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// The unscaled samples, m/s².
    pub fn acceleration_m_s2(&self) -> &'a [f64] {
        self.acceleration_m_s2
    }

    /// Scale factor that multiplies every sample.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Time of the last sample, s.
    pub fn duration_s(&self) -> f64 {
        (self.acceleration_m_s2.len() - 1) as f64 * self.dt_s
    }
}
