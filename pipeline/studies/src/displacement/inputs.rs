//! What the spectra of a study are made of: its record sets and structures.

use uplift_ida::System;
use uplift_inputs::{RecordSets, read_record_sets};
use uplift_job::checksum::motion_key;
use uplift_job::events::Events;
use uplift_spectra::MotionSet;
use uplift_study::DisplacementStudy;

use super::rounding::printed_structures;
use super::spectra::structures;
use crate::error::StudiesError;

/// What the spectra of a study are made of.
pub struct Inputs {
    /// The record sets.
    pub records: RecordSets,
    pub(crate) structures: Vec<System>,
    /// Those whose ordinates are printed.
    pub(crate) printed: Vec<System>,
}

/// The motions of every set, with their keys.
pub struct KeyedMotions<'a> {
    /// The motions of each set.
    pub motions: Vec<MotionSet<'a>>,
    /// Keys of the motions of each set.
    pub(crate) keys: Vec<Vec<String>>,
    pub(super) structures: &'a [System],
    pub(super) printed: &'a [System],
}

impl Inputs {
    /// Reads the record sets of `study`.
    ///
    /// # Errors
    /// Records that cannot be used.
    pub fn read(study: &DisplacementStudy, events: &dyn Events) -> Result<Self, StudiesError> {
        let structures = structures(study)?;
        let printed = printed_structures(study, &structures);
        Ok(Self { records: read_record_sets(study, events)?, structures, printed })
    }

    /// The motions of every set.
    ///
    /// # Errors
    /// Every component that does not move, so that it cannot be scaled.
    pub fn sets(&self, study: &DisplacementStudy) -> Result<KeyedMotions<'_>, StudiesError> {
        let sets = self.records.motions(study.gravity_m_s2)?;
        let keys = |set: &MotionSet<'_>| set.motions().iter().map(|motion| motion_key(motion.accelerogram)).collect();
        let keys = sets.iter().map(keys).collect();
        Ok(KeyedMotions { keys, motions: sets, structures: &self.structures, printed: &self.printed })
    }
}
