//! From a folder of downloads to a manifest: files are found, read, paired and measured.
//!
//! Every file is read twice: first for what its head says, by which components are paired, then with its partner
//! to be measured. So memory holds a pair a thread, however large the folder.

mod group;
mod measured;
mod name;
mod search_results;
mod table;
mod warnings;

use std::io::Read;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use uplift_ida::Watch;
use uplift_motion::{
    AccelerationUnit, MotionError, ReadOptions, RecordFormat, RecordingDescription, read_record, record_bytes,
};

pub use measured::PairMeasures;
pub use table::manifest_columns;
pub use warnings::Warning;
pub use warnings::of_pair as warnings_of_pair;

use crate::checksum::checksum;
use crate::error::UpliftError;
use crate::events::{Events, Progress};
use search_results::SearchResults;

/// What the user says about files that do not say it themselves.
#[derive(Debug, Clone, Copy)]
pub struct ImportOptions {
    /// Layout of every file; none to tell each by its content.
    pub format: Option<RecordFormat>,
    /// Time step of files of one column, s.
    pub dt_s: Option<f64>,
    /// Unit of files that name none.
    pub unit: Option<AccelerationUnit>,
    /// Acceleration of gravity, m/s².
    pub gravity_m_s2: f64,
    /// Whether velocity pulses are sought.
    pub pulses: bool,
}

impl ImportOptions {
    fn read_options(&self, channel: Option<usize>) -> ReadOptions {
        ReadOptions { format: self.format, channel, dt_s: self.dt_s, unit: self.unit, gravity_m_s2: self.gravity_m_s2 }
    }
}

/// One component of a file, without its samples.
#[derive(Debug, Clone)]
pub struct Component {
    /// The file.
    pub path: PathBuf,
    /// Its number in a file with several.
    pub channel: Option<usize>,
    /// Its layout.
    pub format: RecordFormat,
    /// What its head says.
    pub description: RecordingDescription,
    /// Time step, s.
    pub dt_s: f64,
    /// Samples.
    pub points: usize,
    /// SHA-256 of the file.
    pub file_sha256: String,
    /// SHA-256 of the samples: the same motion in two files has one.
    samples_sha256: String,
}

/// A pair ready for a row of a manifest.
#[derive(Debug, Clone)]
pub struct ImportedPair {
    id: String,
    components: [Component; 2],
    measures: PairMeasures,
    search: Option<search_results::Entry>,
    warnings: Vec<Warning>,
}

/// What an import found.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The pairs, by name.
    pub pairs: Vec<ImportedPair>,
    /// What deserves a look, each with the record's or the file's name.
    pub warnings: Vec<Warning>,
    /// Files that are no records, a line each with the reason.
    pub passed_over: Vec<String>,
    /// Number of files read.
    pub files: usize,
    /// Number of components in them.
    pub components: usize,
}

/// Finds, reads, pairs and measures the records in `folder` and the folders in it.
///
/// # Errors
/// A folder that cannot be read, and an interruption; what is wrong with single files is among the warnings.
pub fn import(folder: &Path, options: &ImportOptions, events: &dyn Events) -> Result<Imported, UpliftError> {
    let found = scan(folder)?;
    let mut warnings = Vec::new();
    let search = SearchResults::read(&found.search_results, &mut warnings);

    let progress = Progress::begin(events, "reading", "files", found.files.len() as u64);
    let read: Vec<Result<Vec<Component>, MotionError>> = found
        .files
        .par_iter()
        .map(|path| {
            if progress.cancelled() {
                return Ok(Vec::new());
            }
            let components = components_of(path, options);
            progress.finished(1);
            components
        })
        .collect();
    drop(progress);
    if events.cancelled() {
        return Err(UpliftError::Interrupted);
    }
    let mut components = Vec::new();
    let mut passed_over = Vec::new();
    for outcome in read {
        match outcome {
            Ok(found) => components.extend(found),
            Err(error) => passed_over.push(error.to_string()),
        }
    }
    let count = components.len();
    let components = without_duplicates(components, &mut warnings);
    let candidates = group::pairs(components, &search, &mut warnings);
    warnings.extend(search.missing(&candidates));

    let progress = Progress::begin(events, "measuring", "pairs", candidates.len() as u64);
    let measured: Vec<Option<Result<ImportedPair, String>>> = candidates
        .into_par_iter()
        .map(|candidate| {
            if progress.cancelled() {
                return None;
            }
            let pair = measured::pair(candidate, options);
            progress.finished(1);
            Some(pair)
        })
        .collect();
    drop(progress);
    if events.cancelled() {
        return Err(UpliftError::Interrupted);
    }
    let mut pairs = Vec::new();
    for outcome in measured.into_iter().flatten() {
        match outcome {
            Ok(pair) => {
                warnings.extend(pair.warnings.iter().cloned());
                pairs.push(pair);
            }
            Err(reason) => passed_over.push(reason),
        }
    }
    Ok(Imported { pairs, warnings, passed_over, files: found.files.len(), components: count })
}

struct Scan {
    files: Vec<PathBuf>,
    search_results: Vec<PathBuf>,
}

/// Endings of files that come with downloads and hold no acceleration.
const NO_RECORDS: [&str; 20] = [
    "vt2", "dt2", "pdf", "zip", "tar", "md", "html", "htm", "json", "xml", "h5", "png", "jpg", "svg", "xlsx", "xls",
    "doc", "docx", "toml", "py",
];

/// The files of a folder and the folders in it, in order of their paths; links to folders are not followed, and what is
/// hidden is left out.
fn scan(folder: &Path) -> Result<Scan, UpliftError> {
    let mut scan = Scan { files: Vec::new(), search_results: Vec::new() };
    let hidden = |entry: &walkdir::DirEntry| {
        entry.depth() > 0 && entry.file_name().to_str().is_some_and(|name| name.starts_with('.'))
    };
    let walk = walkdir::WalkDir::new(folder).sort_by_file_name().into_iter().filter_entry(|entry| !hidden(entry));
    for entry in walk {
        let entry = entry.map_err(|error| UpliftError::input(format!("{}: {error}", folder.display())))?;
        let name = entry.file_name().to_string_lossy().to_lowercase();
        let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
        // a link to a file counts as the file
        if entry.file_type().is_dir() || !entry.path().is_file() {
            continue;
        }
        if ending == "csv" && name.contains("searchresults") {
            scan.search_results.push(entry.into_path());
            continue;
        }
        let manifest = ending == "csv" && is_manifest(entry.path());
        if !manifest && !NO_RECORDS.contains(&ending) {
            scan.files.push(entry.into_path());
        }
    }
    if scan.files.is_empty() {
        return Err(UpliftError::input(format!("{} holds no files that could be records", folder.display())));
    }
    Ok(scan)
}

/// Whether a table lists records, as an import writes it.
fn is_manifest(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(1 << 14).read_to_end(&mut head));
    read.is_ok() && head.windows(10).any(|word| word == b"record_id,".as_slice() || word == b"record_id;".as_slice())
}

/// The components of a file.
fn components_of(path: &Path, options: &ImportOptions) -> Result<Vec<Component>, MotionError> {
    let bytes = record_bytes(path)?;
    let file = read_record(&bytes, &path.display().to_string(), &options.read_options(None))?;
    let file_sha256 = checksum(&bytes);
    let several = file.recordings.len() > 1;
    let named = name::of(path).orientation;
    let components = file.recordings.into_iter().enumerate().map(|(index, mut recording)| {
        // what the head does not say, the name may
        recording.description.orientation = recording.description.orientation.or(named);
        let samples = recording.accelerogram.acceleration_m_s2();
        let bytes: Vec<u8> = samples.iter().flat_map(|a| a.to_le_bytes()).collect();
        Component {
            path: path.to_owned(),
            channel: several.then_some(index + 1),
            format: file.format,
            dt_s: recording.accelerogram.dt_s(),
            points: samples.len(),
            file_sha256: file_sha256.clone(),
            samples_sha256: checksum(&bytes),
            description: recording.description,
        }
    });
    Ok(components.collect())
}

/// Leaves out what is there already, and says so.
fn without_duplicates(components: Vec<Component>, warnings: &mut Vec<Warning>) -> Vec<Component> {
    let mut seen = std::collections::HashMap::new();
    let mut kept: Vec<Component> = Vec::new();
    for component in components {
        let first = *seen.entry(component.samples_sha256.clone()).or_insert(kept.len());
        match kept.get(first) {
            Some(same) => warnings.push(Warning {
                kind: "duplicate",
                text: format!("{}: the same motion as {}; left out", component.path.display(), same.path.display()),
            }),
            None => kept.push(component),
        }
    }
    kept
}
