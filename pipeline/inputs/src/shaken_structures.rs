//! Records that shake structures which are not known exactly: one record a motion and structure.
//!
//! An aleatory study draws structures of each motion's own, an epistemic one the same structures for all. Either way
//! every record counts alike, so that the spectrum is that of the mean frequency over the structures.

use uplift_job::JobError;
use uplift_study::{Uncertainty, UncertaintyKind, UniformRiskStudy};
use uplift_uncertainty::unit_cube;

use super::drawn_structure::DrawnStructure;
use super::record::Record;
use crate::error::InputsError;

/// Records at most: those that a pool of demands holds.
const MOST_RECORDS: usize = u16::MAX as usize;

/// Between the name of a motion and the number of the structure that it shakes.
pub(super) const STRUCTURE: &str = ":s";

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
