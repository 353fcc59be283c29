//! A manifest, and which of its records.

use std::path::PathBuf;

use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_motion::{Combination, STANDARD_GRAVITY_M_S2};
use uplift_study::RecordSelection;

use crate::error::InputsError;
use crate::pairs::CheckedPair;
use crate::{manifest, pairs, selection};

/// A manifest, and which of its records.
#[derive(Debug, Clone, PartialEq)]
pub struct SetOptions {
    /// Manifest of a record set, CSV.
    pub manifest: PathBuf,
    /// Only rows whose `set_tags` contain this word.
    pub tag: Option<String>,
    /// How the peaks of two components make one.
    pub intensity: Combination,
    /// Ranges that the records lie in; empty for all.
    pub selection: RecordSelection,
}

impl SetOptions {
    /// The records that are asked for, and how many there are in all.
    pub(super) fn read(&self, events: &dyn Events) -> Result<(Vec<CheckedPair>, usize), InputsError> {
        let rows = manifest::read(&self.manifest, self.tag.as_deref()).map_err(JobError::Inputs)?;
        let count = rows.len();
        let pairs = pairs::read(rows, STANDARD_GRAVITY_M_S2).map_err(JobError::Inputs)?;
        let (chosen, notes) = selection::select(pairs, &self.selection, self.intensity, STANDARD_GRAVITY_M_S2)?;
        for note in notes {
            events.note(&note);
        }
        Ok((chosen, count))
    }
}
