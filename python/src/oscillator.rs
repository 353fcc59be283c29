//! The numbers of oscillators, checked together.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_plausible::{CAPACITY, GRAVITY, POST_UPLIFT_STIFFNESS, RESTITUTION, STRENGTH, UPLIFT_DISPLACEMENT};

use crate::errors::{check_plausible, refused};

/// The numbers of an oscillator as Python gives them; names as in the study file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Numbers {
    pub(crate) strength: f64,
    pub(crate) uplift_displacement_m: f64,
    pub(crate) restitution: f64,
    pub(crate) capacity_m: Option<f64>,
    pub(crate) post_uplift_stiffness_per_s2: Option<f64>,
    pub(crate) gravity_m_s2: f64,
}

impl Numbers {
    /// The oscillator of these numbers.
    ///
    /// # Errors
    /// `ValueError` that names every number that no oscillator has.
    pub(crate) fn oscillator(&self) -> PyResult<Oscillator> {
        check_plausible(&[
            (STRENGTH, "strength", Some(self.strength)),
            (UPLIFT_DISPLACEMENT, "uplift_displacement_m", Some(self.uplift_displacement_m)),
            (RESTITUTION, "restitution", Some(self.restitution)),
            (CAPACITY, "capacity_m", self.capacity_m),
            (POST_UPLIFT_STIFFNESS, "post_uplift_stiffness_per_s2", self.post_uplift_stiffness_per_s2),
            (GRAVITY, "gravity_m_s2", Some(self.gravity_m_s2)),
        ])?;
        let post_uplift = match (self.capacity_m, self.post_uplift_stiffness_per_s2) {
            (Some(_), Some(_)) => {
                let message = "capacity_m needs a negative stiffness after uplift, post_uplift_stiffness_per_s2 is a \
                               positive one: give one of them";
                return Err(PyValueError::new_err(message));
            }
            (Some(capacity_m), None) => PostUplift::Negative { capacity_m },
            (None, Some(stiffness_per_s2)) => PostUplift::Positive { stiffness_per_s2 },
            (None, None) => PostUplift::Zero,
        };
        Oscillator::new(self.strength, self.gravity_m_s2, self.uplift_displacement_m, self.restitution, post_uplift)
            .map_err(refused)
    }
}
