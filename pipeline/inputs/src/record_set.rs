//! The record set of a study: which ground motions shake the oscillators, and with what intensity.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use rayon::prelude::*;
use sha2::{Digest, Sha256};
use uplift_job::JobError;
use uplift_job::checksum::checksum;
use uplift_job::events::{Events, Silent};
use uplift_job::machine::{Needs, PROGRAM_BYTES};
use uplift_job::text::counted;
use uplift_motion::synthetic::SyntheticSetOptions;
use uplift_motion::{Combination, Component, Direction, Drawn, Horizontal, IntensityMeasure, MotionError, RecordPair};
use uplift_study::{RecordSource, UniformRiskStudy};

use super::duplicates::Places;
use super::manifest::Row;
use super::pairs::{self, CheckedPair};
use super::record::Record;
use super::shaken_structures::{STRUCTURE, shaking_structures};
use super::third_component::{ThirdComponents, Vertical};
use super::{AtLevel, at_level, cache, manifest, selection};
use crate::error::InputsError;
use crate::import::unusual_peaks;

/// The records of a study.
#[derive(Debug, Clone)]
pub struct RecordSet {
    /// Where they come from, in a line.
    pub description: String,
    /// True for motions made by the program; said wherever results are shown.
    pub synthetic: bool,
    /// The records, in the order of the result file.
    pub records: Vec<Record>,
    /// Which of them is run at which level; none where every record is, scaled to it.
    pub at_level: Option<AtLevel>,
    /// What is allowed but probably not meant.
    pub notes: Vec<String>,
}

impl RecordSet {
    /// The same motions, each once, whatever structures they shake.
    #[must_use]
    pub fn without_structures(mut self) -> Self {
        let number = |record: &Record| record.structure.as_ref().map(|structure| structure.number);
        // a single structure of each motion has no number in its name
        let is_numbered = self.records.iter().any(|record| number(record) > Some(1));
        self.records.retain(|record| number(record).is_none_or(|number| number == 1));
        for record in &mut self.records {
            let first = format!("{STRUCTURE}1");
            if record.structure.take().is_some()
                && let Some(motion) = is_numbered.then(|| record.id.strip_suffix(&first)).flatten()
            {
                record.id = motion.to_owned();
            }
        }
        self
    }
}

/// Read or make the records of `study`.
///
/// # Errors
/// Everything that is wrong with the manifest or the record files, at once; [`JobError::Interrupted`] where `events`
/// say so.
pub fn read_records(study: &UniformRiskStudy, events: &dyn Events) -> Result<RecordSet, InputsError> {
    read_measured(study, &study.further_measures(), events)
}

/// The same with the measures `further` beside PGV and PGA, whatever the study asks for.
///
/// # Errors
/// As [`read_records`].
pub fn read_measured(
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    events: &dyn Events,
) -> Result<RecordSet, InputsError> {
    read_set(study, further, None, events)
}

/// The same with the pairs that the records are components of, in their order: one or two records each, as
/// `records.component` says.
///
/// # Errors
/// As [`read_records`].
pub fn read_with_pairs(
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    events: &dyn Events,
) -> Result<(RecordSet, Vec<RecordPair>), InputsError> {
    let mut pairs = Vec::new();
    let set = read_set(study, further, Some(&mut pairs), events)?;
    Ok((set, pairs))
}

fn read_set(
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    kept: Option<&mut Vec<RecordPair>>,
    events: &dyn Events,
) -> Result<RecordSet, InputsError> {
    let table = match (&study.records.at_level, study.measures.first()) {
        (Some(path), Some(plan)) => Some((at_level::read(path, plan.measure).map_err(JobError::Inputs)?, plan)),
        _ => None,
    };
    let named = table.as_ref().map(|(table, _)| table.names());
    let (pairs, OfRows { third, places }, source, synthetic) = match &study.records.source {
        RecordSource::Synthetic { pairs, seed } => {
            let none = OfRows::new(&[], study.gravity_m_s2);
            (synthetic_pairs((*pairs, *seed), events)?, none, format!("seed {seed}"), true)
        }
        RecordSource::Manifest { manifest, tag } => {
            let name = manifest.file_name().unwrap_or(manifest.as_os_str()).to_string_lossy();
            let tag_note = tag.as_ref().map_or_else(String::new, |tag| format!(", tag {tag}"));
            let (pairs, of_rows) = manifest_pairs((manifest, tag.as_deref()), named.as_ref(), study, events)?;
            (pairs, of_rows, format!("{name}{tag_note}"), false)
        }
    };
    let synthetic = synthetic || pairs.iter().any(is_made);
    let is_named = |pair: &CheckedPair| named.as_ref().is_none_or(|named| named.contains(pair.0.id.as_str()));
    let pairs: Vec<CheckedPair> = pairs.into_iter().filter(is_named).collect();
    let (mut pairs, mut notes) =
        selection::select(pairs, &study.records.select, study.records.intensity, study.gravity_m_s2)?;
    pairs.truncate(most(study.records.first));
    notes.extend(alike(&pairs));
    let twice = places.note(&pairs, study.records.duplicates);
    notes.extend(twice.iter().flatten().cloned());
    notes.extend(unusual_peak(&pairs, study.gravity_m_s2));
    notes.extend(unequal_length(&pairs, study));
    let of_pairs = |pair| counted(pairs.len(), pair);
    let pairs_in_words = match pairs.iter().filter(|pair| is_made(pair)).count() {
        made if made == pairs.len() || (made == 0 && synthetic) => of_pairs("synthetic pair"),
        0 => of_pairs("recorded pair"),
        made => format!("{}, {made} of them synthetic,", of_pairs("pair")),
    };
    let chosen = &study.records.select;
    let chosen = if chosen.is_empty() { String::new() } else { format!(", {chosen}") };
    let mut description = format!("{pairs_in_words} ({source}{chosen}), component {}", study.records.component);
    let mut verticals = None;
    if study.records.vertical {
        description.push_str(", with the vertical one");
        verticals = Some(third.read(&pairs).map_err(JobError::Inputs)?);
    }
    let mistakes = twice.err().unwrap_or_default();
    let mut records = analysis_records((pairs, verticals), study, further, (kept, mistakes))?;
    let mut at_level = None;
    if let Some(uncertainty) = &study.uncertainty {
        (records, description) = shaking_structures(records, uncertainty, (study, description))?;
    }
    if let Some((table, plan)) = &table {
        let (own, found, told) = table.select(records, plan).map_err(JobError::Inputs)?;
        records = own;
        notes.extend(told);
        let levels = plan.levels.len();
        description = format!("{description}, a set for each of {levels} levels ({})", found.words(levels));
        at_level = Some(found);
    }
    Ok(RecordSet { description, synthetic, records, at_level, notes })
}

/// What the rows of a manifest say of pairs besides their horizontal components.
pub(super) struct OfRows {
    pub(super) third: ThirdComponents,
    pub(super) places: Places,
}

impl OfRows {
    pub(super) fn new(rows: &[Row], gravity_m_s2: f64) -> Self {
        Self { third: ThirdComponents::from_rows(rows, gravity_m_s2), places: Places::from_rows(rows) }
    }
}

/// Whether the program made the pair itself: it stays synthetic, whichever way it comes back.
pub(super) fn is_made((pair, _): &CheckedPair) -> bool {
    let said = |key: &str| pair.metadata.get(key).map(|text| text.to_lowercase()).unwrap_or_default();
    said("event").starts_with("synthetic") || said("set_tags").split([';', ' ', ',']).any(|word| word == "synthetic")
}

/// What of a study adds the components of a pair, sample by sample; none where nothing does.
struct Added {
    what: &'static str,
    /// What is wrong where they do not begin together.
    wrong: String,
    /// What would not add them.
    instead: &'static str,
}

fn added(study: &UniformRiskStudy) -> Option<Added> {
    let intensity = study.records.intensity;
    if intensity != Combination::GeometricMean {
        return Some(Added {
            what: "a measure over all directions",
            wrong: intensity.to_string(),
            instead: "records.intensity = \"geometric-mean\"",
        });
    }
    matches!(study.records.component, Component::Rotated(_)).then(|| Added {
        what: "what is seen from an azimuth",
        wrong: "motion from another azimuth".to_owned(),
        instead: "records.component = \"h1\"",
    })
}

/// Records that may not be synchronised, where that matters.
fn unequal_length(pairs: &[CheckedPair], study: &UniformRiskStudy) -> Option<String> {
    let Added { wrong, .. } = added(study)?;
    let unequal: Vec<&str> =
        pairs.iter().filter(|(pair, _)| pair.h1.len() != pair.h2.len()).map(|(pair, _)| pair.id.as_str()).collect();
    (!unequal.is_empty()).then(|| {
        format!(
            "{} of {} records have components of different length ({}{}): if these do not begin together, their \
             {wrong} is wrong",
            unequal.len(),
            pairs.len(),
            unequal.iter().take(5).copied().collect::<Vec<_>>().join(", "),
            if unequal.len() > 5 { ", …" } else { "" }
        )
    })
}

/// Records whose unit is probably not what it is taken for: the first, and how many more.
pub(super) fn unusual_peak(pairs: &[CheckedPair], gravity_m_s2: f64) -> Option<String> {
    let told = |(pair, _): &CheckedPair| {
        let motions = [&pair.h1, &pair.h2];
        let pga_g = motions.map(|motion| motion.pga_m_s2() / gravity_m_s2);
        let told = unusual_peaks(&pga_g, &motions.map(|motion| 100.0 * motion.pgv_m_s()))?;
        Some(format!("{}: {told}", pair.id))
    };
    let unusual: Vec<String> = pairs.iter().filter_map(told).collect();
    let more = match unusual.len() {
        0 | 1 => String::new(),
        count => format!(" ({} more of {} records)", count - 1, pairs.len()),
    };
    Some(format!("{}{more}", unusual.first()?))
}

/// Records both components of which are the same numbers.
pub(super) fn alike(pairs: &[CheckedPair]) -> Vec<String> {
    let alike: Vec<&str> =
        pairs.iter().filter(|(pair, _)| pair.h1 == pair.h2).map(|(pair, _)| pair.id.as_str()).collect();
    let shown = alike.iter().take(5).copied().collect::<Vec<_>>().join(", ");
    match alike.len() {
        0 => Vec::new(),
        count => vec![format!(
            "{count} of {} records have the same motion as both components ({shown}{}): their intensity is that of \
             the component, not a geometric mean",
            pairs.len(),
            if count > 5 { ", …" } else { "" }
        )],
    }
}

/// Memory of a synthetic pair with its integrals and extremes, bytes: 8600 samples on the average.
const SYNTHETIC_PAIR_BYTES: u64 = 500_000;

/// The synthetic pairs, where the machine has the memory for them.
pub(super) fn synthetic_pairs((pairs, seed): (u64, u64), events: &dyn Events) -> Result<Vec<CheckedPair>, InputsError> {
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
    (manifest, tag): (&Path, Option<&str>),
    named: Option<&BTreeSet<&str>>,
    study: &UniformRiskStudy,
    events: &dyn Events,
) -> Result<(Vec<CheckedPair>, OfRows), InputsError> {
    let mut rows = manifest::read(manifest, tag).map_err(JobError::Inputs)?;
    // nothing is read in vain
    rows.retain(|row| named.is_none_or(|named| named.contains(row.id.as_str())));
    if study.records.select.is_empty() {
        rows.truncate(most(study.records.first));
    }
    let of_rows = OfRows::new(&rows, study.gravity_m_s2);
    Ok((pairs::read(rows, study.gravity_m_s2, events)?, of_rows))
}

/// How many of the selected records are used at most, where the key `first` says this.
pub(super) fn most(first: Option<u64>) -> usize {
    first.map_or(usize::MAX, |first| usize::try_from(first).unwrap_or(usize::MAX))
}

/// The records that a study analyses, each with the intensities of its pair and its vertical component if there are
/// such; the pairs themselves go to `kept`. What is wrong with them is added to the `mistakes` found before.
fn analysis_records(
    (pairs, verticals): (Vec<CheckedPair>, Option<Vec<Vertical>>),
    study: &UniformRiskStudy,
    further: &[IntensityMeasure],
    (mut kept, mut mistakes): (Option<&mut Vec<RecordPair>>, Vec<String>),
) -> Result<Vec<Record>, InputsError> {
    let component = study.records.component;
    let mut records = Vec::new();
    let further_of = |(pair, _): &CheckedPair| -> Result<BTreeMap<IntensityMeasure, f64>, MotionError> {
        let of_pair = |&measure: &IntensityMeasure| {
            Ok((measure, measure.combined_value(study.records.intensity, pair, study.gravity_m_s2)?))
        };
        further.iter().map(of_pair).collect()
    };
    let measured: Vec<_> = pairs.par_iter().map(further_of).collect();
    let mut verticals = verticals.map(Vec::into_iter);
    for ((pair, sums), measured) in pairs.into_iter().zip(measured) {
        let vertical = verticals.as_mut().and_then(Iterator::next);
        if let (Some(Added { what, instead, .. }), Some(apart_s)) =
            (added(study), pair.metadata.get(pairs::START_APART))
        {
            mistakes.push(format!(
                "record {}: its components begin {apart_s} s apart, and {what} needs them together: use {instead}, \
                 cut them to a common start, or leave the record out",
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
        let directions = component.directions(drawn(study.seed, &pair.id));
        for direction in &directions {
            let id = if directions.len() > 1 { format!("{}:{direction}", pair.id) } else { pair.id.clone() };
            let mut motions = match pair.along(*direction) {
                Ok(motions) => motions,
                Err(error) => {
                    mistakes.push(format!("record {}: {error}; or use records.component = \"h1\"", pair.id));
                    break;
                }
            };
            let [sum1, sum2] = &sums;
            records.push(Record {
                id,
                direction: *direction,
                accelerogram: motions.remove(0),
                other_azimuths: motions,
                vertical: vertical.clone(),
                pga_g,
                pgv_cm_s,
                further: measured.clone(),
                metadata: pair.metadata.clone(),
                checksum: match direction {
                    Direction::Component(Horizontal::H1) => sum1.clone(),
                    Direction::Component(Horizontal::H2) => sum2.clone(),
                    Direction::Azimuth(_) | Direction::Percentile { .. } => {
                        checksum(format!("{sum1} {sum2}").as_bytes())
                    }
                },
                structure: None,
            });
        }
        if let Some(kept) = &mut kept {
            kept.push(pair);
        }
    }
    if mistakes.is_empty() { Ok(records) } else { Err(JobError::Inputs(mistakes).into()) }
}

/// What chance gives the pair `id`: from the study's seed and its name alone, so that it depends on neither threads nor
/// the other pairs. Azimuths have two decimals, so that a table holds them whole.
fn drawn(seed: u64, id: &str) -> Drawn {
    let key = Sha256::new().chain_update(seed.to_le_bytes()).chain_update(id).finalize();
    let horizontal = if key[0] & 1 == 0 { Horizontal::H1 } else { Horizontal::H2 };
    // of 2⁶⁴ numbers, so that no hundredth of a degree is favoured by more than 1e-15
    let number = key[1..9].iter().fold(0_u64, |number, byte| number << 8 | u64::from(*byte));
    Drawn { horizontal, azimuth_deg: (number % 18_000) as f64 / 100.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    // A random component must be the same for ever, and fair.
    #[test]
    fn drawn_components_are_pinned_and_fair() {
        let of = |seed: u64, index: usize| drawn(seed, &format!("SYN{index:03}")).horizontal;
        let first: String = (0..16).map(|index| if of(1, index) == Horizontal::H1 { '1' } else { '2' }).collect();
        assert_eq!(first, "2112221112121221");
        let ones = (0..10_000).filter(|&index| of(7, index) == Horizontal::H1).count();
        assert!((4_800..5_200).contains(&ones), "{ones}");
    }

    // So must an azimuth.
    #[test]
    fn drawn_azimuths_are_pinned_and_even() {
        let of = |seed: u64, index: usize| drawn(seed, &format!("SYN{index:03}")).azimuth_deg;
        assert_eq!([0, 1, 2].map(|index| of(1, index)), [1.48, 155.24, 127.33]);
        let mut in_sextant = [0; 6];
        for azimuth in (0..12_000).map(|index| of(7, index)) {
            assert!((0.0..180.0).contains(&azimuth));
            in_sextant[(0..6).rposition(|sextant| azimuth >= 30.0 * f64::from(sextant)).unwrap_or_default()] += 1;
        }
        assert!(in_sextant.iter().all(|count| (1_850..2_150).contains(count)), "{in_sextant:?}");
    }
}
