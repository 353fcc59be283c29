//! One of the structures that a study does not know exactly.

use uplift_job::JobError;
use uplift_job::checksum::checksum;
use uplift_oscillator::{Oscillator, OscillatorError, PostUplift};
use uplift_structure::{Realization, UncertainQuantity};
use uplift_study::{UniformRiskStudy, Warning};

use crate::error::InputsError;

/// One of the structures that may be.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnStructure {
    /// Its number, from 1 on: among those of its motion (aleatory), or among all (epistemic).
    pub number: usize,
    /// The values of what is not known exactly; of the strength the factor on each of the study's.
    pub values: Vec<(UncertainQuantity, f64)>,
}

impl DrawnStructure {
    /// SHA-256 of it with a motion of this key.
    pub(super) fn key_with(&self, motion_key: &str) -> String {
        let values: Vec<String> = self
            .values
            .iter()
            .map(|(quantity, value)| format!("{} {:016x}", quantity.key(), value.to_bits()))
            .collect();
        checksum(format!("{motion_key} with {}", values.join(" ")).as_bytes())
    }

    pub(super) fn is_as_described(&self, study: &UniformRiskStudy) -> bool {
        let described = |quantity| study.oscillator.value(quantity).map(f64::to_bits);
        self.values.iter().all(|(quantity, value)| described(*quantity) == Some(value.to_bits()))
    }

    /// The value of a quantity; none where that is known exactly.
    pub fn value(&self, quantity: UncertainQuantity) -> Option<f64> {
        self.values.iter().find(|(of, _)| *of == quantity).map(|(_, value)| *value)
    }

    /// The oscillator of `study` at one of its strengths, but for what is drawn.
    ///
    /// # Errors
    /// One that cannot be: what it has, and what to do.
    pub fn oscillator(&self, study: &UniformRiskStudy, strength: f64) -> Result<Oscillator, InputsError> {
        let own = &study.oscillator;
        let mut drawn = Realization::default();
        self.values.iter().for_each(|(quantity, value)| drawn.set(*quantity, *value));
        let uplift_displacement_m = drawn.uplift_displacement_m.unwrap_or(own.uplift_displacement_m);
        let post_uplift = match own.post_uplift {
            PostUplift::Negative { capacity_m } => {
                PostUplift::Negative { capacity_m: drawn.capacity_m.unwrap_or(capacity_m) }
            }
            other => other,
        };
        let strength = drawn.strength.map_or(strength, |factor| factor * strength);
        let restitution = drawn.restitution.unwrap_or(own.restitution);
        Oscillator::new(strength, study.gravity_m_s2, uplift_displacement_m, restitution, post_uplift)
            .map_err(|error| self.refused(study, strength, &error))
    }

    /// What it has, what is wrong with it, and what was doubtful in the study already.
    fn refused(&self, study: &UniformRiskStudy, strength: f64, error: &OscillatorError) -> InputsError {
        let values: Vec<String> =
            self.values.iter().map(|(quantity, value)| format!("{} {value}", quantity.key())).collect();
        let is_doubt = |warning: &&Warning| warning.unlikely && warning.what.contains("uncertainty.");
        let doubts = study.warnings.iter().filter(is_doubt).map(|doubt| format!("; mistake? {}", doubt.what));
        let doubts = doubts.collect::<Vec<_>>().concat();
        JobError::input(format!(
            "[uncertainty]: a sampled structure is invalid ({}, of strength {strength}): {error}; use less scatter, \
             or correlate related quantities{doubts}",
            values.join(", ")
        ))
        .into()
    }
}
