//! The vertical components of pairs, from the columns `file_v`, `channel_v` and `sha256_v` of a manifest.

use std::collections::BTreeMap;

use rayon::prelude::*;
use uplift_job::text::first_names;
use uplift_motion::{Accelerogram, ReadOptions};

use super::manifest::{ComponentFile, Row};
use super::pairs::{CheckedPair, START, read_component};

/// A vertical component, upwards positive, with the SHA-256 of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Vertical {
    /// Its acceleration.
    pub accelerogram: Accelerogram,
    /// SHA-256 of its file.
    pub checksum: String,
}

/// Where the vertical components of pairs are, by the names of the pairs.
pub(super) struct ThirdComponents(BTreeMap<String, (ComponentFile, ReadOptions)>);

impl ThirdComponents {
    /// As the `rows` of a manifest say; values in g are converted with `gravity_m_s2`.
    pub(super) fn from_rows(rows: &[Row], gravity_m_s2: f64) -> Self {
        let own = |row: &Row| {
            let file = row.vertical.clone()?;
            let options =
                ReadOptions { format: row.format, channel: file.channel, dt_s: row.dt_s, unit: row.unit, gravity_m_s2 };
            Some((row.id.clone(), (file, options)))
        };
        Self(rows.iter().filter_map(own).collect())
    }

    /// The vertical components of `pairs`, in their order.
    ///
    /// # Errors
    /// All pairs that have none, in a line; everything that is wrong with the files, a line each.
    pub(super) fn read(&self, pairs: &[CheckedPair]) -> Result<Vec<Vertical>, Vec<String>> {
        let without: Vec<&str> =
            pairs.iter().map(|(pair, _)| pair.id.as_str()).filter(|id| !self.0.contains_key(*id)).collect();
        let mut mistakes = Vec::new();
        if !without.is_empty() {
            mistakes.push(format!(
                "{} of {} records have no third component, which records.vertical asks for: {}: name it in the column \
                 file_v of the manifest, or leave the records out",
                without.len(),
                pairs.len(),
                first_names(&without)
            ));
        }
        let of_pair = |(pair, _): &CheckedPair| {
            let (file, options) = self.0.get(&pair.id)?;
            let start_s = pair.metadata.get(START).and_then(|text| text.parse::<f64>().ok());
            Some(read(file, options, start_s).map_err(|reason| format!("record {}: {reason}", pair.id)))
        };
        let read: Vec<Result<Vertical, String>> = pairs.par_iter().filter_map(of_pair).collect();
        let mut verticals = Vec::new();
        for outcome in read {
            match outcome {
                Ok(vertical) => verticals.push(vertical),
                Err(mistake) => mistakes.push(mistake),
            }
        }
        if mistakes.is_empty() { Ok(verticals) } else { Err(mistakes) }
    }
}

/// The component in `file`, which must begin when the first horizontal one does, `start_s`, where both say it.
fn read(file: &ComponentFile, options: &ReadOptions, start_s: Option<f64>) -> Result<Vertical, String> {
    let (recording, checksum) = read_component(file, options)?;
    let accelerogram = recording.accelerogram;
    if let (Some(start_s), Some(own_s)) = (start_s, recording.description.start_time_s)
        && (start_s - own_s).abs() > 0.5 * accelerogram.dt_s()
    {
        return Err(format!(
            "its vertical component {} begins {:.3} s after the first horizontal one: cut them to a common start, or \
             leave the record out",
            file.path.display(),
            own_s - start_s
        ));
    }
    Ok(Vertical { accelerogram, checksum })
}
