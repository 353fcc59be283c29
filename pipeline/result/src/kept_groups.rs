//! What commands added to a result after its run, and which additions a change of the study leaves valid.

use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_study::{Repair, UniformRiskStudy};

use super::file::ResultFile;
use super::layout::structures;
use super::{BANDS, CONSISTENCY, DISAGGREGATION, EFFICIENCY, INFLUENCE, TRENDS};
use crate::error::ResultError;

/// What can be added to a result after its run, each by its group and its name.
pub(super) fn added() -> [(&'static str, &'static str); 4] {
    [
        (BANDS.root(), "bootstrap"),
        (INFLUENCE.root(), "influence"),
        (EFFICIENCY.root(), "measures"),
        (structures::ROOT, "structures"),
    ]
}

/// The groups of a result that stay valid in a new result of the same analyses.
pub struct KeptGroups {
    file: ResultFile,
    groups: Vec<&'static str>,
}

impl KeptGroups {
    /// The additions to `file` that do not depend on what `study` changes.
    ///
    /// The study may differ from that of the file in `[bootstrap]` and `[consistency]` alone: anything else that counts
    /// changes the analyses. Bands depend on `[bootstrap]`; answers about structures quote the consistency; bands and
    /// influence depend on it where spectra are repaired.
    ///
    /// # Errors
    /// A file that is damaged or of another kind.
    pub fn valid_for(file: ResultFile, study: &UniformRiskStudy) -> Result<Self, ResultError> {
        let earlier = file.stored_study()?;
        let same_consistency = study.consistency == earlier.consistency;
        let is_repaired = file.has_repair() || study.consistency.repair == Repair::Weights;
        let same_spectra = same_consistency || !is_repaired;
        let groups = [
            (EFFICIENCY.root(), true),
            (TRENDS.root(), true),
            (INFLUENCE.root(), same_spectra),
            (DISAGGREGATION.root(), same_spectra),
            (BANDS.root(), same_spectra && study.bootstrap == earlier.bootstrap),
            (structures::ROOT, same_consistency),
            // a repair that was added; a run writes the rest of this group itself
            (CONSISTENCY.root(), same_consistency && file.has_repair()),
        ];
        Ok(Self { groups: groups.into_iter().filter(|(_, valid)| *valid).map(|(group, _)| group).collect(), file })
    }

    /// Whether a repair is among them, so that a run need not write the consistency.
    pub fn has_repair(&self) -> bool {
        self.groups.contains(&CONSISTENCY.root())
    }

    /// Whether the addition of this name is among them.
    pub(super) fn has(&self, name: &str) -> bool {
        added().iter().any(|(group, own)| *own == name && self.groups.contains(group))
    }

    /// Writes them.
    ///
    /// # Errors
    /// Whatever keeps the one file from being read or the other from being written.
    pub fn write(&self, writer: &mut LabelledWriter) -> Result<(), LabelledError> {
        writer.carry_groups(&self.file.reader, &self.groups)
    }
}
