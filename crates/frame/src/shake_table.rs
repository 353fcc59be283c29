//! Records as a shaking table plays them to a model of smaller size (Section 6.4).
//!
//! A model of lengths `1/λ` under the same accelerations moves as the prototype if its time runs `√λ` faster: the steps
//! of a record shrink by `√λ`, and with them velocities. The motions are then scaled so that
//! `PGV = √(PGV_x² + PGV_y²)`, the root of the sum of squares of the two peaks (Eq. 6.9), has the level wanted, all
//! components by the same factor. It is not the geometric mean of Chapters 3 and 4.

use uplift_motion::Accelerogram;

use crate::error::{FrameError, within};

/// A level of shaking of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableLevel {
    length_scale: f64,
    pgv_m_s: f64,
}

/// The root of the sum of squares of the peaks of two components (Eq. 6.9), in their unit.
pub fn srss(x: f64, y: f64) -> f64 {
    x.hypot(y)
}

impl TableLevel {
    /// From the length scale `λ`, prototype over model, and the level of [`srss`] PGV in the model's scale (m/s).
    ///
    /// # Errors
    /// The scale must be between 1e-3 and 1e3, the level between 1e-6 and 1e3 m/s.
    pub fn new(length_scale: f64, pgv_m_s: f64) -> Result<Self, FrameError> {
        within("length scale", length_scale, "(pure number)", 1e-3..=1e3, "between 1e-3 and 1e3")?;
        within("PGV", pgv_m_s, "m/s", 1e-6..=1e3, "between 1e-6 and 1e3 m/s")?;
        Ok(Self { length_scale, pgv_m_s })
    }

    /// Factor of accelerations for components of these peak velocities (m/s) as recorded; none where both are 0.
    pub fn factor(&self, pgv_m_s: [f64; 2]) -> Option<f64> {
        let recorded = srss(pgv_m_s[0], pgv_m_s[1]);
        (recorded > 0.0).then(|| self.pgv_m_s * self.length_scale.sqrt() / recorded)
    }

    /// A component in the model's scale: `factor` times the accelerations, with steps shorter by `√λ`.
    ///
    /// # Errors
    /// The products must be finite.
    pub fn component(&self, record: &Accelerogram, factor: f64) -> Result<Accelerogram, FrameError> {
        let scaled = record.acceleration_m_s2().iter().map(|a| factor * a).collect();
        Ok(Accelerogram::new(record.dt_s() / self.length_scale.sqrt(), scaled)?)
    }

    /// Two components in the model's scale, with the factor of their accelerations; none for records without velocity.
    ///
    /// # Errors
    /// As [`component`](Self::component).
    pub fn pair(&self, [x, y]: [&Accelerogram; 2]) -> Result<Option<([Accelerogram; 2], f64)>, FrameError> {
        let Some(factor) = self.factor([x.pgv_m_s(), y.pgv_m_s()]) else { return Ok(None) };
        Ok(Some(([self.component(x, factor)?, self.component(y, factor)?], factor)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scaled_pair_has_the_level() {
        let x = Accelerogram::new(0.01, vec![0.0, 2.0, -1.0, 0.5, 0.0]).unwrap();
        let y = Accelerogram::new(0.02, vec![0.0, -1.0, 1.5, 0.0]).unwrap();
        let ([a, b], factor) = TableLevel::new(5.0, 0.335).unwrap().pair([&x, &y]).unwrap().unwrap();
        assert!((srss(a.pgv_m_s(), b.pgv_m_s()) / 0.335 - 1.0).abs() < 1e-14);
        assert!((a.dt_s() * 5.0_f64.sqrt() / 0.01 - 1.0).abs() < 1e-15);
        assert!((a.pga_m_s2() / (factor * 2.0) - 1.0).abs() < 1e-15 && factor > 1.0);
        let still = Accelerogram::new(0.01, vec![0.0; 3]).unwrap();
        assert!(TableLevel::new(5.0, 0.335).unwrap().pair([&still, &still]).unwrap().is_none());
        assert!(TableLevel::new(0.0, 0.335).is_err() && TableLevel::new(5.0, f64::NAN).is_err());
    }
}
