//! Files are found, read, paired and measured.
//!
//! Every file is read twice: first for what its head says, by which components are paired, then with its partner
//! to be measured. So memory holds a pair a thread, however large the folder.

use std::collections::HashMap;
use std::path::Path;

use uplift_job::checksum::checksum;
use uplift_job::events::{Events, each};
use uplift_motion::{AccelerationUnit, MotionError, ReadOptions, RecordPair, read_auto, read_record, record_bytes};

use super::component::Component;
use super::group::{self, Candidate};
use super::measured::PairMeasures;
use super::name::RecordName;
use super::scan::scan;
use super::search_results::{Entry, SearchResults};
use super::warnings::{self, Warning};
use crate::FileOptions;
use crate::error::InputsError;

/// A pair ready for a row of a manifest.
#[derive(Debug, Clone)]
pub(super) struct ImportedPair {
    pub(super) id: String,
    pub(super) components: [Component; 2],
    pub(super) vertical: Option<Component>,
    pub(super) measures: PairMeasures,
    pub(super) search: Option<Entry>,
    pub(super) warnings: Vec<Warning>,
}

#[derive(Debug, Clone)]
pub(super) struct Imported {
    pub(super) pairs: Vec<ImportedPair>,
    /// What deserves a look, each with the record's or the file's name.
    pub(super) warnings: Vec<Warning>,
    /// Files that are no records, a line each with the reason.
    pub(super) passed_over: Vec<String>,
    /// Number of files read.
    pub(super) files: usize,
    /// Number of components in them.
    pub(super) components: usize,
}

/// Finds, reads, pairs and measures the records in `folder` and the folders in it; `pulses` tells whether velocity
/// pulses are sought.
///
/// # Errors
/// A folder that cannot be read, and an interruption; what is wrong with single files is among the warnings.
pub(super) fn find_pairs(
    folder: &Path,
    options: FileOptions,
    pulses: bool,
    events: &dyn Events,
) -> Result<Imported, InputsError> {
    let found = scan(folder)?;
    let mut warnings = Vec::new();
    let search = SearchResults::read(&found.search_results, &mut warnings);

    let files = found.files.len();
    let read = each(events, ("reading", "files"), found.files, |path| components_of(&path, options))?;
    let mut components = Vec::new();
    let mut passed_over = Vec::new();
    for outcome in read {
        match outcome {
            Ok(found) => components.extend(found),
            Err(reason) => passed_over.push(reason),
        }
    }
    let count = components.len();
    warnings.extend(options.unit.into_iter().flat_map(|given| stated_units(&components, given)));
    let components = without_duplicates(components, &search, &mut warnings);
    let candidates = group::pairs(components, &search, &mut warnings);
    warnings.extend(search.missing(candidates.iter().filter_map(|candidate| candidate.rsn)));

    let measured = each(events, ("measuring", "pairs"), candidates, |candidate| measured(candidate, options, pulses))?;
    let mut pairs = Vec::new();
    for outcome in measured {
        match outcome {
            Ok(pair) => {
                warnings.extend(pair.warnings.iter().cloned());
                pairs.push(pair);
            }
            Err(reason) => passed_over.push(reason),
        }
    }
    Ok(Imported { pairs, warnings, passed_over, files, components: count })
}

/// The components of a file.
///
/// # Errors
/// Why it is not read.
fn components_of(path: &Path, options: FileOptions) -> Result<Vec<Component>, String> {
    let bytes = record_bytes(path).map_err(|error| error.to_string())?;
    let name = path.display().to_string();
    let read = |unit| read_record(&bytes, &name, &ReadOptions { unit, ..options.read_options(None) });
    let (file, given_unit) = match (read(None), options.unit) {
        (Err(MotionError::MissingUnit { .. } | MotionError::MissingUnitAndTimeStep { .. }), Some(given)) => {
            (read(Some(given)), Some(given))
        }
        (stated, _) => (stated, None),
    };
    let file = file.map_err(|error| error.to_string())?;
    let file_sha256 = checksum(&bytes);
    let several = file.recordings.len() > 1;
    let named = RecordName::from_path(path).orientation;
    let components = file.recordings.into_iter().enumerate().map(|(index, mut recording)| {
        // what the head does not say, the name may
        recording.description.orientation = recording.description.orientation.or(named);
        let samples = recording.accelerogram.acceleration_m_s2();
        let bytes: Vec<u8> = samples.iter().flat_map(|a| a.to_le_bytes()).collect();
        Component {
            path: path.to_owned(),
            channel: several.then_some(index + 1),
            format: file.format,
            unit: recording.unit,
            given_unit,
            dt_s: recording.accelerogram.dt_s(),
            points: samples.len(),
            file_sha256: file_sha256.clone(),
            samples_sha256: checksum(&bytes),
            description: recording.description,
        }
    });
    Ok(components.collect())
}

/// Reads and measures both components of a candidate.
///
/// # Errors
/// A file that could be read before and no longer can, or has changed.
fn measured(candidate: Candidate, options: FileOptions, pulses: bool) -> Result<ImportedPair, String> {
    let read = |component: &Component| {
        let bytes = record_bytes(&component.path).map_err(|error| error.to_string())?;
        if checksum(&bytes) != component.file_sha256 {
            return Err(format!("{}: changed while it was imported; import again", component.path.display()));
        }
        let name = component.path.display().to_string();
        read_auto(&bytes, &name, &options.read_options(component.channel)).map_err(|error| error.to_string())
    };
    let Candidate { id, rsn: _, components, vertical, search } = candidate;
    let [first, second] = &components;
    let pair = RecordPair { id, h1: read(first)?, h2: read(second)?, metadata: std::collections::BTreeMap::new() };
    let mut measures = PairMeasures::from_pair(&pair, options.gravity_m_s2, pulses);
    if !warnings::are_together([&first.description, &second.description], pair.h1.dt_s()) {
        // all but the geometric mean would be wrong
        measures.peaks[1..].fill(None);
        (measures.pulse, measures.pulse_like) = (None, None);
    }
    let mut warnings =
        warnings::pair_warnings(&pair, [&first.description, &second.description], &measures, options.gravity_m_s2);
    let stated_s = search.as_ref().and_then(|entry| entry.d5_95_s);
    warnings.extend(stated_s.and_then(|stated_s| warnings::duration_warning(&pair, measures.durations_s[1], stated_s)));
    Ok(ImportedPair { id: pair.id, components, vertical, measures, search, warnings })
}

/// Remarks on components whose files state another unit than the one `given`.
fn stated_units(components: &[Component], given: AccelerationUnit) -> impl Iterator<Item = Warning> {
    let others = components.iter().filter(move |component| component.unit != given);
    others.map(move |component| Warning {
        kind: "another unit",
        text: format!(
            "{}: states {}, which is used; --unit is {}",
            component.place(),
            component.unit.symbol(),
            given.symbol()
        ),
    })
}

/// Keeps one of equal motions, and says which are left out: one that the search results list comes first, then one with
/// a record sequence number, then the first.
fn without_duplicates(
    components: Vec<Component>,
    search: &SearchResults,
    warnings: &mut Vec<Warning>,
) -> Vec<Component> {
    let rank = |component: &Component| {
        let rsn = RecordName::from_path(&component.path).rsn;
        (search.find(rsn).is_none(), rsn.is_none())
    };
    let mut best = HashMap::new();
    for (index, component) in components.iter().enumerate() {
        let own = (rank(component), index);
        best.entry(component.samples_sha256.clone()).and_modify(|kept| *kept = own.min(*kept)).or_insert(own);
    }
    let kept: Vec<usize> = components.iter().map(|component| best[&component.samples_sha256].1).collect();
    let left_out = kept.iter().enumerate().filter(|(index, kept)| index != *kept);
    warnings.extend(left_out.map(|(index, &kept)| {
        let [place, same] = [index, kept].map(|index| components[index].place());
        Warning { kind: "duplicate", text: format!("{place}: the same motion as {same}; left out") }
    }));
    let numbered = components.into_iter().enumerate();
    numbered.filter(|(index, _)| kept[*index] == *index).map(|(_, component)| component).collect()
}
