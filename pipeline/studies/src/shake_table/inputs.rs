//! What a study of a shaking table reads: the frame, the records, which of them are played.

use std::collections::BTreeMap;

use uplift_atomic_file::read_file;
use uplift_frame::{ColumnShape, RockingFrame, srss};
use uplift_inputs::{RecordSets, SetRecord, read_sets, rocking_frame};
use uplift_job::JobError;
use uplift_job::checksum::checksum;
use uplift_job::events::Events;
use uplift_result::Excitation;
use uplift_study::{ShakeTableStudy, Structure};

use super::excitations::{Chosen, all, read_table};
use crate::error::StudiesError;

/// The most that a structure file has.
const LARGEST_BYTES: u64 = 1 << 20;

/// What the tests of a study are made of.
pub struct Inputs {
    pub(crate) records: RecordSets,
    pub(crate) frame: RockingFrame,
    /// What the frame keeps of its velocity past the upright; none where nothing is lost.
    pub(crate) restitution: Option<f64>,
    /// SHA-256 of each input by its name.
    pub(crate) checksums: BTreeMap<String, String>,
    /// What to know of the inputs.
    pub(crate) notes: Vec<String>,
    chosen: Vec<Chosen>,
}

impl Inputs {
    /// Reads structure, records and excitations.
    pub(crate) fn read(study: &ShakeTableStudy, events: &dyn Events) -> Result<Self, StudiesError> {
        let structure = Structure::load(&study.structure)?;
        let frame = frame(&structure)?;
        let records = read_sets(&study.records, &[], study.gravity_m_s2, events)?;
        let (chosen, missing) = match &study.excitations {
            Some(table) => read_table(table, &records)?,
            None => (all(&records)?, None),
        };
        let mut checksums: BTreeMap<String, String> =
            chosen.iter().flat_map(|chosen| records.records[chosen.record].named_checksums()).collect();
        let mut file = |name: &str, path| {
            let bytes = read_file(path, LARGEST_BYTES).map_err(|error| JobError::input(error.to_string()))?;
            checksums.insert(name.to_owned(), checksum(&bytes));
            Ok::<(), StudiesError>(())
        };
        file("structure", &study.structure)?;
        study.excitations.iter().try_for_each(|table| file("excitations", table))?;
        let warnings = structure.warnings.iter().map(ToString::to_string);
        let notes = warnings.chain(records.notes.iter().cloned()).chain(missing).collect();
        Ok(Self { records, frame, restitution: structure.wobbling_restitution, checksums, notes, chosen })
    }

    /// The excitations with their records.
    pub(super) fn played(&self) -> Vec<(Excitation, &SetRecord)> {
        let played = |chosen: &Chosen| {
            let record = &self.records.records[chosen.record];
            let excitation = Excitation {
                exc_id: chosen.exc_id.clone(),
                class: chosen.class.clone(),
                record: record.pair.id.clone(),
                rsn: record.pair.metadata.get("rsn").cloned().unwrap_or_default(),
                recorded_pgv_m_s: srss(record.pair.h1.pgv_m_s(), record.pair.h2.pgv_m_s()),
            };
            (excitation, record)
        };
        self.chosen.iter().map(played).collect()
    }

    /// Samples of all records.
    pub(super) fn samples(&self) -> u64 {
        self.records.records.iter().map(|record| (record.pair.h1.len() + record.pair.h2.len()) as u64).sum()
    }
}

fn frame(structure: &Structure) -> Result<RockingFrame, StudiesError> {
    let fail = |reason: String| JobError::input(format!("{}: {reason}", structure.file.display()));
    let of = &structure.description;
    if of.deck_mass_kg.is_none() || structure.columns.is_none() {
        return Err(fail(format!(
            "a shaking table needs columns and a deck: kind \"{}\" has none; give a frame or a restrained-frame",
            of.kind.name()
        ))
        .into());
    }
    let frame = rocking_frame(structure)?;
    if frame.shape() == ColumnShape::Rectangle {
        return Err(fail(
            "the columns of a frame that is shaken in two directions wobble on their rims: write column_shape = \
             \"cylinder\" if they are round"
                .to_owned(),
        )
        .into());
    }
    Ok(frame)
}
