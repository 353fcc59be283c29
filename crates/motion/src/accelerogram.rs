//! The accelerogram: ground acceleration at equal time steps.

use std::sync::Arc;

use crate::error::MotionError;

/// Ground acceleration sampled at equal steps, linear between samples.
///
/// The first sample is at time zero. The ground is at rest before it, and has no acceleration
/// after the last sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Accelerogram {
    dt_s: f64,
    /// Copies of a motion share them.
    acceleration_m_s2: Arc<[f64]>,
}

impl Accelerogram {
    /// Makes an accelerogram of the time step `dt_s` \[s\] and the samples
    /// `acceleration_m_s2` \[m/s²\].
    ///
    /// # Errors
    ///
    /// [`MotionError::TimeStep`] unless the step is finite and above zero,
    /// [`MotionError::TooFewSamples`] for fewer than two samples, and [`MotionError::Sample`] for
    /// the first sample that is not finite.
    pub fn new(dt_s: f64, acceleration_m_s2: Vec<f64>) -> Result<Self, MotionError> {
        if !(dt_s.is_finite() && dt_s > 0.0) {
            return Err(MotionError::TimeStep { dt_s });
        }
        if acceleration_m_s2.len() < 2 {
            return Err(MotionError::TooFewSamples { count: acceleration_m_s2.len() });
        }
        if let Some((index, &value)) = acceleration_m_s2.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            return Err(MotionError::Sample { index, value });
        }
        Ok(Self { dt_s, acceleration_m_s2: acceleration_m_s2.into() })
    }

    /// Time step \[s\].
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Samples of the ground acceleration \[m/s²\], the first at time zero.
    pub fn acceleration_m_s2(&self) -> &[f64] {
        &self.acceleration_m_s2
    }

    /// Number of samples, at least two.
    #[allow(clippy::len_without_is_empty)] // never empty
    pub fn len(&self) -> usize {
        self.acceleration_m_s2.len()
    }

    /// Time from the first to the last sample \[s\].
    pub fn duration_s(&self) -> f64 {
        (self.len() - 1) as f64 * self.dt_s
    }

    /// The same motion with every sample multiplied by `factor`.
    ///
    /// # Errors
    ///
    /// [`MotionError::Sample`] where the product is not finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, MotionError> {
        let scaled = self.acceleration_m_s2.iter().map(|a| factor * a);
        Self::new(self.dt_s, scaled.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_in_comes_out() {
        let motion = Accelerogram::new(0.5, vec![1.0, -2.0, 3.0]).unwrap();
        assert_eq!(motion.dt_s(), 0.5);
        assert_eq!(motion.len(), 3);
        assert_eq!(motion.duration_s(), 1.0);
        assert_eq!(motion.scaled(-2.0).unwrap().acceleration_m_s2(), [-2.0, 4.0, -6.0]);
    }

    #[test]
    fn refuses_what_is_no_accelerogram() {
        for dt_s in [0.0, -0.01, f64::NAN, f64::INFINITY] {
            let error = Accelerogram::new(dt_s, vec![0.0; 3]).unwrap_err();
            assert!(error.to_string().contains(&format!("{dt_s} s")), "{error}");
        }
        for count in 0..2 {
            let error = Accelerogram::new(0.01, vec![0.0; count]).unwrap_err();
            assert!(matches!(error, MotionError::TooFewSamples { count: c } if c == count));
        }
        let error = Accelerogram::new(0.01, vec![0.0, f64::NEG_INFINITY, f64::NAN]).unwrap_err();
        assert!(matches!(error, MotionError::Sample { index: 1, value } if value == f64::NEG_INFINITY));
        let motion = Accelerogram::new(0.01, vec![1e200, 1.0]).unwrap();
        assert!(matches!(motion.scaled(1e200), Err(MotionError::Sample { index: 0, .. })));
    }
}
