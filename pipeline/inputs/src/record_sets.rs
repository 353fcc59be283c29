//! The record sets of a study of displacement spectra: every component of every record a motion of its own.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::text::counted;
use uplift_motion::{Combination, RecordPair};
use uplift_spectra::{MotionSet, RecordOfSet};
use uplift_study::{DisplacementStudy, RecordSource, SetPlan, SetRecords};

use super::manifest::{self, Row};
use super::pairs::{self, CheckedPair};
use super::record_set::{OfRows, alike, is_made, most, synthetic_pairs};
use super::selection;
use super::third_component::Vertical;
use crate::error::InputsError;

/// Name of the set where a study names none.
const ALL_RECORDS: &str = "all records";
/// Name of the set of synthetic records.
const SYNTHETIC: &str = "synthetic";

/// A record with both components.
#[derive(Debug, Clone)]
pub struct SetRecord {
    /// Its components, and what is known of it.
    pub pair: RecordPair,
    /// SHA-256 of the file of each component; of the samples of a synthetic one.
    pub checksums: [String; 2],
    /// The vertical component, where the study asks for it.
    pub vertical: Option<Vertical>,
}

impl SetRecord {
    /// SHA-256 of each component by its name.
    pub fn named_checksums(&self) -> Vec<(String, String)> {
        let [h1, h2] = &self.checksums;
        let vertical = self.vertical.as_ref().map(|vertical| ("vertical", &vertical.checksum));
        let named = [("h1", h1), ("h2", h2)].into_iter().chain(vertical);
        named.map(|(which, checksum)| (format!("record {} {which}", self.pair.id), checksum.clone())).collect()
    }

    /// A number that the manifest says under `key`; NaN where it says none.
    pub fn number(&self, key: &str) -> f64 {
        self.pair.metadata.get(key).and_then(|text| text.parse().ok()).unwrap_or(f64::NAN)
    }
}

/// A set, and which records are in it.
#[derive(Debug, Clone)]
pub struct NamedSet {
    /// Its name.
    pub name: String,
    /// Tag of its rows in the manifest, empty for all rows.
    pub tag: String,
    /// Positions of its records.
    pub members: Vec<usize>,
}

/// The record sets of a study.
#[derive(Debug, Clone)]
pub struct RecordSets {
    /// Where the records come from, in a line.
    pub description: String,
    /// True for motions made by the program; said wherever results are shown.
    pub synthetic: bool,
    /// The records of all sets, each once.
    pub records: Vec<SetRecord>,
    /// The sets.
    pub sets: Vec<NamedSet>,
    /// What is allowed but probably not meant.
    pub notes: Vec<String>,
}

impl RecordSets {
    /// The records of a set.
    pub fn records_of<'a>(&'a self, set: &'a NamedSet) -> impl Iterator<Item = &'a SetRecord> {
        set.members.iter().map(|&member| &self.records[member])
    }

    /// The motions of every set, with the peaks that scaling refers to.
    ///
    /// # Errors
    /// Every component that does not move, so that it cannot be scaled.
    pub fn motions(&self, gravity_m_s2: f64) -> Result<Vec<MotionSet<'_>>, InputsError> {
        let mut mistakes = Vec::new();
        let mut sets = Vec::new();
        for set in &self.sets {
            let records = self
                .records_of(set)
                .map(|SetRecord { pair, .. }| RecordOfSet { id: &pair.id, components: [&pair.h1, &pair.h2] });
            match MotionSet::new(&set.name, records, gravity_m_s2) {
                Ok(motions) => {
                    let verticals = self.records_of(set).filter_map(|record| record.vertical.as_ref());
                    sets.push(motions.upwards(verticals.map(|vertical| &vertical.accelerogram)));
                }
                Err(error) => mistakes.push(error.to_string()),
            }
        }
        if mistakes.is_empty() { Ok(sets) } else { Err(JobError::Inputs(mistakes).into()) }
    }
}

/// Read or make the records of `study`, and put them into its sets.
///
/// # Errors
/// Everything that is wrong with the manifest, the sets or the record files, at once; [`JobError::Interrupted`]
/// where `events` say so.
pub fn read_record_sets(study: &DisplacementStudy, events: &dyn Events) -> Result<RecordSets, InputsError> {
    read_sets(&study.records, &study.record_sets, study.gravity_m_s2, events)
}

/// The same of `records` in sets by these `plans`; in one where there are none.
///
/// # Errors
/// As [`read_record_sets`].
pub fn read_sets(
    records: &SetRecords,
    plans: &[SetPlan],
    gravity_m_s2: f64,
    events: &dyn Events,
) -> Result<RecordSets, InputsError> {
    let most = most(records.first);
    let mut of_rows = OfRows::new(&[], gravity_m_s2);
    let (pairs, chosen, source, mut notes) = match &records.source {
        &RecordSource::Synthetic { pairs, seed } => {
            let named = plans.len();
            let unused = (named > 0).then(|| {
                format!(
                    "no manifest, so the {named} record sets of the study are not used: all synthetic records are \
                         one set"
                )
            });
            let pairs = synthetic_pairs((pairs, seed), events)?;
            let ids = pairs.iter().map(|(pair, _)| pair.id.clone()).collect();
            let plan = Chosen { name: SYNTHETIC.to_owned(), tag: String::new(), ids };
            (pairs, vec![plan], format!("seed {seed}"), Vec::from_iter(unused))
        }
        RecordSource::Manifest { manifest, .. } => {
            let RowsOfSets { rows, chosen, notes } = rows_of_sets(manifest, records, plans)?;
            let name = manifest.file_name().unwrap_or(manifest.as_os_str()).to_string_lossy().into_owned();
            of_rows = OfRows::new(&rows, gravity_m_s2);
            (pairs::read(rows, gravity_m_s2, events)?, chosen, name, notes)
        }
    };
    let synthetic = records.manifest().is_none() || pairs.iter().any(is_made);
    let select = &records.select;
    let (pairs, lacking) = selection::select(pairs, select, Combination::GeometricMean, gravity_m_s2)?;
    notes.extend(lacking);
    notes.extend(alike(&pairs));

    let position: BTreeMap<&str, usize> =
        pairs.iter().enumerate().map(|(index, (pair, _))| (pair.id.as_str(), index)).collect();
    let mut mistakes = Vec::new();
    let mut sets = Vec::new();
    for Chosen { name, tag, ids } in chosen {
        let members: Vec<usize> = ids.iter().filter_map(|id| position.get(id.as_str()).copied()).take(most).collect();
        if members.is_empty() {
            let selected = if select.is_empty() { String::new() } else { format!(" with {select}") };
            mistakes.push(format!("record set {name:?} has no record{selected}: widen it, or leave the set out"));
        }
        // one motion under two names in two sets is counted once in each
        match of_rows.places.note(members.iter().map(|&member| &pairs[member]), records.duplicates) {
            Ok(note) => notes.extend(note.filter(|note| !notes.contains(note)).into_iter().collect::<Vec<_>>()),
            Err(twice) => {
                mistakes.extend(twice.into_iter().filter(|line| !mistakes.contains(line)).collect::<Vec<_>>());
            }
        }
        sets.push(NamedSet { name, tag, members });
    }
    if !mistakes.is_empty() {
        return Err(JobError::Inputs(mistakes).into());
    }
    // what belongs to no set any more is not kept
    let used: BTreeSet<usize> = sets.iter().flat_map(|set| set.members.iter().copied()).collect();
    let place: BTreeMap<usize, usize> = used.iter().enumerate().map(|(new, &old)| (old, new)).collect();
    for member in sets.iter_mut().flat_map(|set| &mut set.members) {
        *member = place[member];
    }
    let pairs: Vec<CheckedPair> =
        pairs.into_iter().enumerate().filter(|(index, _)| used.contains(index)).map(|(_, pair)| pair).collect();
    let with_vertical = records.vertical;
    let mut verticals = Vec::new().into_iter();
    if with_vertical {
        verticals = of_rows.third.read(&pairs).map_err(JobError::Inputs)?.into_iter();
    }
    let records: Vec<SetRecord> = (pairs.into_iter())
        .map(|(pair, checksums)| SetRecord { pair, checksums, vertical: verticals.next() })
        .collect();
    let kind = if synthetic { "synthetic" } else { "recorded" };
    let pairs = counted(records.len(), &format!("{kind} pair"));
    let into = if sets.len() == 1 { "one set".to_owned() } else { format!("{} sets", sets.len()) };
    let chosen = if select.is_empty() { String::new() } else { format!(", {select}") };
    let description = format!("{pairs} ({source}{chosen}) in {into}, both components");
    let description = if with_vertical { format!("{description}, with the vertical one") } else { description };
    Ok(RecordSets { description, synthetic, records, sets, notes })
}

/// A set by the identifiers of its records.
struct Chosen {
    name: String,
    tag: String,
    ids: Vec<String>,
}

/// The rows of a manifest that are in a set, each once; the sets; and notes.
struct RowsOfSets {
    rows: Vec<Row>,
    chosen: Vec<Chosen>,
    notes: Vec<String>,
}

fn rows_of_sets(path: &Path, records: &SetRecords, plans: &[SetPlan]) -> Result<RowsOfSets, InputsError> {
    let everything = [SetPlan { name: ALL_RECORDS.to_owned(), tag: None, leave_out: Vec::new() }];
    let plans = if plans.is_empty() { &everything[..] } else { plans };
    let mut rows: Vec<Row> = Vec::new();
    let mut known = BTreeSet::new();
    let (mut chosen, mut notes, mut mistakes) = (Vec::new(), Vec::new(), Vec::new());
    for plan in plans {
        let mut of_set = match manifest::read(path, plan.tag.as_deref()) {
            Ok(of_set) => of_set,
            Err(found) => {
                mistakes.extend(found.into_iter().filter(|mistake| !mistakes.contains(mistake)).collect::<Vec<_>>());
                continue;
            }
        };
        for left_out in &plan.leave_out {
            let before = of_set.len();
            of_set.retain(|row| !has_name(&row.id, &row.metadata, left_out));
            if of_set.len() == before {
                notes.push(format!("record set {:?}: {left_out}, which is left out, is not in it", plan.name));
            }
        }
        if records.select.is_empty() {
            of_set.truncate(most(records.first)); // nothing is read in vain
        }
        chosen.push(Chosen {
            name: plan.name.clone(),
            tag: plan.tag.clone().unwrap_or_default(),
            ids: of_set.iter().map(|row| row.id.clone()).collect(),
        });
        rows.extend(of_set.into_iter().filter(|row| known.insert(row.id.clone())));
    }
    if mistakes.is_empty() { Ok(RowsOfSets { rows, chosen, notes }) } else { Err(JobError::Inputs(mistakes).into()) }
}

/// Whether the record has this identifier or record sequence number.
pub fn is_numbered(record: &SetRecord, name: &str) -> bool {
    has_name(&record.pair.id, &record.pair.metadata, name)
}

/// The same of a row of a manifest, too.
fn has_name(id: &str, metadata: &BTreeMap<String, String>, name: &str) -> bool {
    let number = |text: &str| text.strip_prefix("RSN").unwrap_or(text).parse::<u64>().ok();
    let of_id = id.split('_').next().filter(|word| word.starts_with("RSN")).and_then(number);
    let of_row = metadata.get("rsn").and_then(|text| number(text)).or(of_id);
    id == name || (of_row.is_some() && of_row == number(name))
}
