//! A component of a record, as a file has it.

use std::path::PathBuf;

use uplift_motion::{AccelerationUnit, RecordFormat, RecordingDescription};

/// One component of a file, without its samples.
#[derive(Debug, Clone)]
pub(super) struct Component {
    /// The file.
    pub(super) path: PathBuf,
    /// Its number in a file with several.
    pub(super) channel: Option<usize>,
    /// Its layout.
    pub(super) format: RecordFormat,
    /// What its head says.
    pub(super) description: RecordingDescription,
    /// The unit of its accelerations in the file.
    pub(super) unit: AccelerationUnit,
    /// The unit given for it; none where the file states its own.
    pub(super) given_unit: Option<AccelerationUnit>,
    /// Time step, s.
    pub(super) dt_s: f64,
    /// Samples.
    pub(super) points: usize,
    /// SHA-256 of the file.
    pub(super) file_sha256: String,
    /// SHA-256 of the samples: the same motion in two files has one.
    pub(super) samples_sha256: String,
}

impl Component {
    /// Its file, with its channel in a file of several.
    pub(super) fn place(&self) -> String {
        let channel = self.channel.map_or_else(String::new, |channel| format!(", channel {channel}"));
        format!("{}{channel}", self.path.display())
    }
}
