//! What an interrupted bootstrap keeps, to go on from.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use uplift_bootstrap::{Band, ResamplingPlan};
use uplift_motion::IntensityMeasure;

use super::bands::{BandSettings, StrengthBands};
use crate::error::UpliftError;
use crate::outputs::beside;
use crate::result::StoredStripes;
use uplift_labelled::{LabelledReader, LabelledWriter};

/// Finished strengths by measure and index.
pub(super) type Finished = BTreeMap<(&'static str, usize), StrengthBands>;

/// The file beside a result that holds the finished part of its bootstrap.
#[derive(Debug)]
pub(super) struct Checkpoint {
    path: PathBuf,
    fingerprint: String,
}

/// Where the bootstrap of the result at `result` keeps what is finished.
pub(crate) fn part_path(result: &Path) -> PathBuf {
    beside(result, "bootstrap.part.h5")
}

/// Finished strengths of all measures in the file of an interrupted bootstrap; none where there is none.
pub(crate) fn finished_strengths(part: &Path) -> Option<u64> {
    let reader = LabelledReader::open(part).ok()?;
    reader.attribute_text("/", "fingerprint").ok()?;
    let count = |measure: IntensityMeasure| {
        reader.array_u32(&format!("/{}/strength", measure.key())).map_or(0, |strengths| strengths.values.len() as u64)
    };
    Some(IntensityMeasure::ALL.into_iter().map(count).sum())
}

impl Checkpoint {
    /// The checkpoint of this very bootstrap: its fingerprint covers all numbers that the bands depend on.
    pub(super) fn of(stored: &StoredStripes, plan: &ResamplingPlan, settings: &BandSettings) -> Self {
        let mut hash = Sha256::new();
        let mut add = |values: &[f64]| {
            hash.update((values.len() as u64).to_le_bytes());
            for value in values {
                hash.update(value.to_le_bytes());
            }
        };
        add(&stored.targets_per_year);
        add(&stored.strengths);
        for measure in &stored.measures {
            add(&measure.levels);
            add(measure.edp_m.values());
            for weights in measure.weights.iter().chain(measure.branches.iter().flatten().map(|(_, weights)| weights)) {
                add(&weights.per_year());
            }
            let branch_weights: Vec<f64> = measure.branches.iter().flatten().map(|(weight, _)| *weight).collect();
            add(&branch_weights);
        }
        hash.update(format!("{:?} {} {:?}", plan.sizes(), plan.replicates(), settings));
        for count in plan.multiplicities() {
            hash.update(count.to_le_bytes());
        }
        Self { path: part_path(&stored.path), fingerprint: format!("{:x?}", hash.finalize()) }
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// What is there already of the measures `keys`; nothing if it belongs to other numbers or cannot be read.
    pub(super) fn load(&self, keys: &[&'static str]) -> Finished {
        let read = || -> Result<Finished, UpliftError> {
            let reader = LabelledReader::open(&self.path)?;
            let mut finished = Finished::new();
            if reader.attribute_text("/", "fingerprint")? != self.fingerprint {
                return Ok(finished);
            }
            for &key in keys.iter().filter(|key| reader.exists(&format!("/{key}/bands_m"))) {
                let strengths = reader.array_u32(&format!("/{key}/strength"))?.values;
                let bands = reader.array_f64(&format!("/{key}/bands_m"))?.values;
                let path = format!("/{key}/replicates_m");
                let replicates = if reader.exists(&path) { reader.array_f64(&path)?.values } else { Vec::new() };
                if strengths.is_empty() {
                    continue;
                }
                let (per_band, per_replicate) = (bands.len() / strengths.len(), replicates.len() / strengths.len());
                for (row, &strength) in strengths.iter().enumerate() {
                    let bands = bands[row * per_band..(row + 1) * per_band]
                        .chunks_exact(3)
                        .map(|band| Band { lower_m: band[0], median_m: band[1], upper_m: band[2] })
                        .collect();
                    let replicates_m = replicates[row * per_replicate..(row + 1) * per_replicate].to_vec();
                    finished.insert((key, strength as usize), StrengthBands { bands, replicates_m });
                }
            }
            Ok(finished)
        };
        read().unwrap_or_default()
    }

    /// Keep what is finished.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub(super) fn save(&self, finished: &Finished) -> Result<(), UpliftError> {
        let mut writer = LabelledWriter::create(&self.path)?;
        writer.attribute("/", "program", "uplift")?;
        writer.attribute("/", "fingerprint", self.fingerprint.as_str())?;
        let mut keys: Vec<&'static str> = finished.keys().map(|&(key, _)| key).collect();
        keys.dedup();
        for key in keys {
            let rows: Vec<(u32, &StrengthBands)> = finished
                .iter()
                .filter(|((of, _), _)| *of == key)
                .map(|((_, strength), bands)| (u32::try_from(*strength).unwrap_or(u32::MAX), bands))
                .collect();
            let indices: Vec<u32> = (0..).take(rows.len()).collect();
            let (row, value) = (format!("{key}_row"), format!("{key}_value"));
            writer.axis_u32(&row, &indices, "1", "row")?;
            let strengths: Vec<u32> = rows.iter().map(|row| row.0).collect();
            writer.array_u32(&format!("/{key}/strength"), &[&row], &strengths, "1", "index of the strength")?;
            let bands: Vec<f64> = rows
                .iter()
                .flat_map(|(_, done)| done.bands.iter().flat_map(|band| [band.lower_m, band.median_m, band.upper_m]))
                .collect();
            let values: Vec<u32> = (0..).take(bands.len() / rows.len()).collect();
            writer.axis_u32(&value, &values, "1", "limit")?;
            writer.array_f64(&format!("/{key}/bands_m"), &[&row, &value], &bands, "m", "bands")?;
            let replicates: Vec<f64> = rows.iter().flat_map(|(_, done)| done.replicates_m.iter().copied()).collect();
            if !replicates.is_empty() {
                let replicate = format!("{key}_replicate");
                let values: Vec<u32> = (0..).take(replicates.len() / rows.len()).collect();
                writer.axis_u32(&replicate, &values, "1", "replicate")?;
                writer.array_f64(
                    &format!("/{key}/replicates_m"),
                    &[&row, &replicate],
                    &replicates,
                    "m",
                    "replicates",
                )?;
            }
        }
        writer.finish()?;
        Ok(())
    }

    /// Take the file away, once its numbers are in the result.
    pub(super) fn remove(&self) {
        let _ = std::fs::remove_file(&self.path);
    }
}
