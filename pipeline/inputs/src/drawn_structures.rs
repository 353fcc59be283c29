//! Records that shake structures which are not known exactly: one record a motion and structure.
//!
//! An aleatory study draws structures of each motion's own, an epistemic one the same structures for all. Either way
//! every record counts alike, so that the spectrum is that of the mean frequency over the structures.

use uplift_job::JobError;
use uplift_job::checksum::checksum;
use uplift_oscillator::{Oscillator, OscillatorError, PostUplift};
use uplift_structure::{Realization, UncertainQuantity};
use uplift_study::{Uncertainty, UncertaintyKind, UniformRiskStudy, Warning};
use uplift_uncertainty::unit_cube;

use super::Record;
use crate::error::InputsError;

/// Records at most: those that a pool of demands holds.
const MOST_RECORDS: usize = u16::MAX as usize;

/// Between the name of a motion and the number of the structure that it shakes.
pub(super) const STRUCTURE: &str = ":s";

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

    fn is_as_described(&self, study: &UniformRiskStudy) -> bool {
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

/// The `records`, each with every structure that it shakes, and their `description` with that.
pub(super) fn shaking_structures(
    records: Vec<Record>,
    of: &Uncertainty,
    (study, description): (&UniformRiskStudy, String),
) -> Result<(Vec<Record>, String), InputsError> {
    let each = study.structures_of_a_motion();
    let rows = match of.kind {
        UncertaintyKind::Epistemic => each,
        UncertaintyKind::Aleatory => records.len() * each,
    };
    let all = records.len().saturating_mul(each);
    if all > MOST_RECORDS {
        return Err(JobError::input(format!(
            "[uncertainty]: {each} structures under each of {} records are {all} runs at a level, and {MOST_RECORDS} \
             is the most: use fewer structures",
            records.len()
        ))
        .into());
    }
    let dimensions = of.quantities.len();
    let points = unit_cube(of.sampling, (rows, dimensions), of.seed)?;
    let structure = |row: usize, number: usize| {
        let values = of.vector.values(&points[row * dimensions..(row + 1) * dimensions]);
        DrawnStructure { number, values: of.quantities.iter().copied().zip(values).collect() }
    };
    if of.is_known() {
        // nothing scatters: one structure, which is no draw where it is as described
        let only = structure(0, 1);
        let only = (!only.is_as_described(study)).then_some(only);
        let of_only = |record: Record| Record { structure: only.clone(), ..record };
        return Ok((records.into_iter().map(of_only).collect(), description));
    }
    let mut shaking = Vec::with_capacity(all);
    for (position, record) in records.into_iter().enumerate() {
        for index in 0..each {
            let row = match of.kind {
                UncertaintyKind::Epistemic => index,
                UncertaintyKind::Aleatory => position * each + index,
            };
            let id = if each == 1 { record.id.clone() } else { format!("{}{STRUCTURE}{}", record.id, index + 1) };
            shaking.push(Record { id, structure: Some(structure(row, index + 1)), ..record.clone() });
        }
    }
    let words = match of.kind {
        UncertaintyKind::Epistemic => format!("{description}, each shaking the same {each} structures"),
        UncertaintyKind::Aleatory if each == 1 => format!("{description}, each shaking a structure of its own"),
        UncertaintyKind::Aleatory => format!("{description}, each shaking {each} structures of its own"),
    };
    Ok((shaking, words))
}
