//! The record set of a study: which ground motions shake the oscillators, and with what intensity.

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;
use sha2::{Digest, Sha256};
use uplift_motion::synthetic::SyntheticSetOptions;
use uplift_motion::{Accelerogram, Combination, Component, Horizontal, IntensityMeasure, MotionError, RecordPair};

use super::pairs::{self, CheckedPair};
use super::{cache, manifest, selection};
use crate::checksum::checksum;
use crate::error::UpliftError;
use crate::events::{Events, Silent};
use crate::import::unusual_peak;
use crate::machine::{Needs, PROGRAM_BYTES};
use uplift_study::{RecordSource, UniformRiskStudy};

/// One analysis record: a component of a pair with the intensity of the pair.
#[derive(Debug, Clone)]
pub struct Record {
    /// Identifier; where both components of a pair are used, followed by `:h1` or `:h2`.
    pub id: String,
    /// The component used.
    pub component: Horizontal,
    /// Its acceleration.
    pub accelerogram: Accelerogram,
    /// PGA of the pair, g, as the study combines its components (Eq. 4.5).
    pub pga_g: f64,
    /// PGV of the pair, cm/s, as the study combines its components (Eq. 4.6).
    pub pgv_cm_s: f64,
    /// The other measures that the study asks of its records, in their units, combined in the same way.
    pub further: BTreeMap<IntensityMeasure, f64>,
    /// Event, magnitude and whatever else is known.
    pub metadata: BTreeMap<String, String>,
    /// SHA-256 of the record's file; of the samples of a synthetic one.
    pub checksum: String,
}

impl Record {
    /// A number that the manifest says under `key`; NaN where it says none.
    pub fn number(&self, key: &str) -> f64 {
        self.metadata.get(key).and_then(|text| text.parse().ok()).unwrap_or(f64::NAN)
    }

    /// Intensity of the pair in the unit of `measure`; NaN for one that the study does not ask of its records.
    pub fn intensity(&self, measure: IntensityMeasure) -> f64 {
        match measure {
            IntensityMeasure::Pga => self.pga_g,
            IntensityMeasure::Pgv => self.pgv_cm_s,
            _ => self.further.get(&measure).copied().unwrap_or(f64::NAN),
        }
    }
}

/// The records of a study.
#[derive(Debug, Clone)]
pub struct RecordSet {
    /// Where they come from, in a line.
    pub description: String,
    /// True for motions made by the program; said wherever results are shown.
    pub synthetic: bool,
    /// The records, in the order of the result file.
    pub records: Vec<Record>,
    /// What is allowed but probably not meant.
    pub notes: Vec<String>,
}

/// Read or make the records of `study`.
///
/// # Errors
/// Everything that is wrong with the manifest or the record files, at once; [`UpliftError::Interrupted`] where `events`
/// say so while synthetic ones are made.
pub fn read_records(study: &UniformRiskStudy, events: &dyn Events) -> Result<RecordSet, UpliftError> {
    read_measured(study, &study.further_measures(), events)
}

/// The same with the measures `further` beside PGV and PGA, whatever the study asks for.
///
/// # Errors
/// As [`read_records`].
pub(crate) fn read_measured(
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    events: &dyn Events,
) -> Result<RecordSet, UpliftError> {
    read_set(study, further, None, events)
}

/// The same with the pairs that the records are components of, in their order: one or two records each, as
/// `records.component` says.
///
/// # Errors
/// As [`read_records`].
pub(crate) fn read_with_pairs(
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    events: &dyn Events,
) -> Result<(RecordSet, Vec<RecordPair>), UpliftError> {
    let mut pairs = Vec::new();
    let set = read_set(study, further, Some(&mut pairs), events)?;
    Ok((set, pairs))
}

fn read_set(
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    kept: Option<&mut Vec<RecordPair>>,
    events: &dyn Events,
) -> Result<RecordSet, UpliftError> {
    let (pairs, source, synthetic) = match &study.records.source {
        RecordSource::Synthetic { pairs, seed } => {
            (synthetic_pairs((*pairs, *seed), events)?, format!("seed {seed}"), true)
        }
        RecordSource::Manifest { manifest, tag } => {
            let name = manifest.file_name().unwrap_or(manifest.as_os_str()).to_string_lossy();
            let tag_note = tag.as_ref().map_or_else(String::new, |tag| format!(", tag {tag}"));
            (manifest_pairs(manifest, tag.as_deref(), study)?, format!("{name}{tag_note}"), false)
        }
    };
    let synthetic = synthetic || pairs.iter().any(is_made);
    let (mut pairs, mut notes) =
        selection::select(pairs, &study.records.select, study.records.intensity, study.gravity_m_s2)?;
    pairs.truncate(first_of(study));
    notes.extend(alike(&pairs));
    notes.extend(of_unusual_peak(&pairs, study.gravity_m_s2));
    notes.extend(of_unequal_length(&pairs, study));
    let kind = if synthetic { "synthetic" } else { "recorded" };
    let noun = if pairs.len() == 1 { "pair" } else { "pairs" };
    let chosen = &study.records.select;
    let chosen = if chosen.is_empty() { String::new() } else { format!(", {chosen}") };
    let description =
        format!("{} {kind} {noun} ({source}{chosen}), component {}", pairs.len(), study.records.component);
    Ok(RecordSet { description, synthetic, records: analysis_records(pairs, study, further, kept)?, notes })
}

/// Whether the program made the pair itself: it stays synthetic, whichever way it comes back.
pub(super) fn is_made((pair, _): &CheckedPair) -> bool {
    let said = |key: &str| pair.metadata.get(key).map(|text| text.to_lowercase()).unwrap_or_default();
    said("event").starts_with("synthetic") || said("set_tags").split([';', ' ', ',']).any(|word| word == "synthetic")
}

/// Records that may not be synchronised, where that matters.
fn of_unequal_length(pairs: &[CheckedPair], study: &UniformRiskStudy) -> Option<String> {
    let unequal: Vec<&str> =
        pairs.iter().filter(|(pair, _)| pair.h1.len() != pair.h2.len()).map(|(pair, _)| pair.id.as_str()).collect();
    let matters = study.records.intensity != Combination::GeometricMean && !unequal.is_empty();
    matters.then(|| {
        format!(
            "{} of {} records have components of different length ({}{}): if these do not begin together, their {} is \
             wrong",
            unequal.len(),
            pairs.len(),
            unequal.iter().take(5).copied().collect::<Vec<_>>().join(", "),
            if unequal.len() > 5 { ", …" } else { "" },
            study.records.intensity
        )
    })
}

/// Records whose unit is probably not what it is taken for.
pub(super) fn of_unusual_peak(pairs: &[CheckedPair], gravity_m_s2: f64) -> Option<String> {
    let told = |(pair, _): &CheckedPair| {
        let pga_g = pair.h1.pga_m_s2().max(pair.h2.pga_m_s2()) / gravity_m_s2;
        unusual_peak(pga_g).map(|_| format!("{}: {pga_g:.3} g", pair.id))
    };
    let unusual: Vec<String> = pairs.iter().filter_map(told).collect();
    (!unusual.is_empty()).then(|| {
        format!(
            "{} of {} records have a PGA that the ground hardly has ({}{}): is their unit right, cm/s2 taken for g \
             perhaps?",
            unusual.len(),
            pairs.len(),
            unusual.iter().take(5).cloned().collect::<Vec<_>>().join(", "),
            if unusual.len() > 5 { ", …" } else { "" }
        )
    })
}

/// Records both components of which are the same numbers.
pub(super) fn alike(pairs: &[CheckedPair]) -> Vec<String> {
    let alike: Vec<&str> =
        pairs.iter().filter(|(pair, _)| pair.h1 == pair.h2).map(|(pair, _)| pair.id.as_str()).collect();
    let shown = alike.iter().take(5).copied().collect::<Vec<_>>().join(", ");
    match alike.len() {
        0 => Vec::new(),
        count => vec![format!(
            "{count} of {} records have the same motion as both components ({shown}{}): the intensity is then that of \
             the component, not a geometric mean",
            pairs.len(),
            if count > 5 { ", …" } else { "" }
        )],
    }
}

/// Memory of a synthetic pair with its integrals and extremes, bytes: 8600 samples on the average.
const SYNTHETIC_PAIR_BYTES: u64 = 500_000;

/// The synthetic pairs, where the machine has the memory for them.
pub(super) fn synthetic_pairs((pairs, seed): (u64, u64), events: &dyn Events) -> Result<Vec<CheckedPair>, UpliftError> {
    let memory_bytes = PROGRAM_BYTES + pairs.saturating_mul(SYNTHETIC_PAIR_BYTES);
    let needs = Needs { memory_bytes, disk_bytes: 0, disk_least_bytes: 0 };
    // the whole plan is looked at once they are there
    needs.room(Path::new(".")).refuse(&Silent)?;
    let pairs = usize::try_from(pairs).unwrap_or(usize::MAX);
    let options = SyntheticSetOptions { seed, pairs, ..SyntheticSetOptions::default() };
    let set = cache::synthetic_set(&options, events)?;
    Ok(set
        .into_iter()
        .map(|pair| {
            let sums = [&pair.h1, &pair.h2].map(|component| {
                let bytes: Vec<u8> = component.acceleration_m_s2().iter().flat_map(|a| a.to_le_bytes()).collect();
                checksum(&bytes)
            });
            (pair, sums)
        })
        .collect())
}

fn manifest_pairs(
    manifest: &Path,
    tag: Option<&str>,
    study: &UniformRiskStudy,
) -> Result<Vec<CheckedPair>, UpliftError> {
    let mut rows = manifest::read(manifest, tag).map_err(UpliftError::Inputs)?;
    // nothing is read in vain
    if study.records.select.is_empty() {
        rows.truncate(first_of(study));
    }
    pairs::read(rows, study.gravity_m_s2).map_err(UpliftError::Inputs)
}

/// How many of the selected records are used at most.
fn first_of(study: &UniformRiskStudy) -> usize {
    study.records.first.map_or(usize::MAX, |first| usize::try_from(first).unwrap_or(usize::MAX))
}

/// The components that a study analyses, each with the intensities of its pair; the pairs themselves go to `kept`.
fn analysis_records(
    pairs: Vec<CheckedPair>,
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    mut kept: Option<&mut Vec<RecordPair>>,
) -> Result<Vec<Record>, UpliftError> {
    let component = study.records.component;
    let mut records = Vec::new();
    let mut mistakes = Vec::new();
    let further_of = |(pair, _): &CheckedPair| -> Result<BTreeMap<IntensityMeasure, f64>, MotionError> {
        let of_pair = |&measure: &IntensityMeasure| {
            Ok((measure, measure.of_combined(study.records.intensity, pair, study.gravity_m_s2)?))
        };
        further.iter().map(of_pair).collect()
    };
    let measured: Vec<_> = pairs.par_iter().map(further_of).collect();
    for ((pair, sums), measured) in pairs.into_iter().zip(measured) {
        if study.records.intensity != Combination::GeometricMean
            && let Some(apart_s) = pair.metadata.get(pairs::START_APART)
        {
            mistakes.push(format!(
                "record {}: its components begin {apart_s} s apart, and a measure over all directions needs them \
                 together: use records.intensity = \"geometric-mean\", cut them to a common start, or leave the record \
                 out",
                pair.id
            ));
            continue;
        }
        let peaks = match study.records.intensity.peaks_of(&pair) {
            Ok(peaks) => peaks,
            Err(error) => {
                mistakes.push(format!("record {}: {error}; or use records.intensity = \"geometric-mean\"", pair.id));
                continue;
            }
        };
        let (pga_g, pgv_cm_s) = (peaks.pga_g(study.gravity_m_s2), peaks.pgv_cm_s());
        if !(pga_g > 0.0 && pgv_cm_s > 0.0) {
            mistakes.push(format!(
                "record {}: a component does not move (PGA {pga_g} g, PGV {pgv_cm_s} cm/s), so it cannot be scaled; \
                 leave the record out",
                pair.id
            ));
            continue;
        }
        let measured = measured?;
        for (which, accelerogram) in pair.components(component, drawn(study.seed, &pair.id)) {
            let id = if component == Component::Both { format!("{}:{which}", pair.id) } else { pair.id.clone() };
            let [sum1, sum2] = &sums;
            records.push(Record {
                id,
                component: which,
                accelerogram: accelerogram.clone(),
                pga_g,
                pgv_cm_s,
                further: measured.clone(),
                metadata: pair.metadata.clone(),
                checksum: if which == Horizontal::H1 { sum1.clone() } else { sum2.clone() },
            });
        }
        if let Some(kept) = &mut kept {
            kept.push(pair);
        }
    }
    if mistakes.is_empty() { Ok(records) } else { Err(UpliftError::Inputs(mistakes)) }
}

/// The component that `component = "random"` gives the pair `id`: from the study's seed and its name alone, so that it
/// depends on neither threads nor the other pairs.
fn drawn(seed: u64, id: &str) -> Horizontal {
    let key = Sha256::new().chain_update(seed.to_le_bytes()).chain_update(id).finalize();
    if key[0] & 1 == 0 { Horizontal::H1 } else { Horizontal::H2 }
}

#[cfg(test)]
mod tests {
    use super::*;

    // A random component must be the same for ever, and fair.
    #[test]
    fn drawn_components_are_pinned_and_fair() {
        let of = |seed: u64, index: usize| drawn(seed, &format!("SYN{index:03}"));
        let first: String = (0..16).map(|index| if of(1, index) == Horizontal::H1 { '1' } else { '2' }).collect();
        assert_eq!(first, "2112221112121221");
        let ones = (0..10_000).filter(|&index| of(7, index) == Horizontal::H1).count();
        assert!((4_800..5_200).contains(&ones), "{ones}");
    }
}
