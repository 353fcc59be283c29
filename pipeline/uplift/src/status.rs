//! How far a run is, and what a result holds.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_atomic_file::folder_of;
use uplift_engine::analysis::SHARD;
use uplift_engine::checkpoint::{Finding, RowFile, checkpoint_path};
use uplift_job::JobError;
use uplift_job::lock::ResultLock;
use uplift_job::outputs::SITE_ARRAYS;
use uplift_questions::bootstrap::{Interrupted, interrupted, part_path};
use uplift_result::earlier::made_of;
use uplift_result::{Overview, ResultFile, StoredFinding, is_hdf5};
use uplift_studies::uniform_risk::site_table::SLICE;
use uplift_study::Study;

use crate::error::UpliftError;
use crate::sweep::{comparison, sweep_beside};

/// What is there of a run: at least one of its parts.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct StatusReport {
    /// The result, where it is finished.
    pub result: Option<ResultStatus>,
    /// Files of finished rows: the checkpoint of an unfinished run, and shards.
    pub unfinished: Vec<UnfinishedStatus>,
    /// Slices of its table of sites.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub slices: Vec<SlicesStatus>,
    /// Its sweep; or what is in the folder that was asked about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep: Option<SweepStatus>,
    /// What an interrupted bootstrap of the result has finished.
    pub bootstrap: Option<BootstrapStatus>,
    /// Who is writing the result now.
    pub written_by: Option<String>,
}

/// The slices of a table of sites that was cut into so many.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SlicesStatus {
    /// How many there are to be.
    pub count: usize,
    /// Those that are computed, from 1, ascending.
    pub done: Vec<usize>,
}

/// A folder of results: of a sweep, or of anything.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SweepStatus {
    /// The folder.
    pub folder: PathBuf,
    /// Its results.
    pub results: Vec<PathBuf>,
    /// Whether it is known to be one, by its name or by the command of a result in it.
    pub is_certain: bool,
    /// Whether a sweep lacks its comparison.
    pub lacks_comparison: bool,
    /// The checkpoints of unfinished runs.
    pub unfinished: Vec<UnfinishedStatus>,
}

/// The file of an interrupted bootstrap.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct BootstrapStatus {
    /// The file.
    pub file: PathBuf,
    /// Strengths that are finished, of all measures.
    pub strengths: u64,
    /// The command that resumes it, where it is known.
    pub command: Option<String>,
}

/// A finished result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResultStatus {
    /// The file.
    pub file: PathBuf,
    /// When it was finished.
    pub created: String,
    /// Version of the program.
    pub version: String,
    /// Commit that the program was built from.
    pub commit: String,
    /// The study file as it was given.
    pub study: String,
    /// Title of the study.
    pub title: String,
    /// What was changed of the study file for the run (`--set`).
    pub overrides: Vec<String>,
    /// By what its numbers are known in tables and figures.
    pub study_digest: String,
    /// Files beside it that were made of another result of this name.
    pub made_of_another: Vec<PathBuf>,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// What it holds.
    pub content: Overview,
    /// What structures were asked under it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub asked: Vec<AskedStatus>,
}

/// A question about a structure whose answer a result keeps.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct AskedStatus {
    /// Name of the structure.
    pub structure: String,
    /// The command and what it was asked for.
    pub question: String,
    /// When.
    pub created: String,
    /// Whether the structure file was another when the structure was last asked something.
    pub is_of_earlier_file: bool,
}

/// A file of finished rows of the analysis.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct UnfinishedStatus {
    /// The file.
    pub file: PathBuf,
    /// Title of the study.
    pub title: String,
    /// Which shard it is, from 1.
    pub shard: u64,
    /// Of how many; 1 for a run that is not cut.
    pub shards: u64,
    /// Analyses that are finished.
    pub done: u64,
    /// Analyses in all.
    pub analyses: u64,
    /// Whether all of them are finished, the result is there, and the file has analyses of other settings too.
    pub is_kept_for_others: bool,
    /// Bytes that were cut off or damaged; their rows are computed again.
    pub damaged_bytes: u64,
}

/// Looks what there is of a run.
///
/// * `input` — a result file, a study file, or a shard
///
/// # Errors
/// A study with mistakes, a file that is none of these or damaged, and where there is nothing at all; none where there
/// is anything to report, finished or not, so that a script that waits for a run sees no error when it ends.
pub fn status(input: &Path) -> Result<StatusReport, UpliftError> {
    if input.is_file() && !is_hdf5(input) {
        if let Ok(Some(finding)) = RowFile::read(input) {
            let is_checkpoint = input.extension().is_some_and(|extension| extension == "part");
            let has_result = is_checkpoint && input.with_extension("").is_file();
            let unfinished = vec![UnfinishedStatus::from_finding(input, &finding, has_result)];
            return Ok(StatusReport { unfinished, ..StatusReport::default() });
        }
        if input.extension().is_some_and(|extension| extension == "h5") {
            return Err(JobError::input(format!("{} is not an HDF5 file", input.display())).into());
        }
    }
    if let Some(sweep) = SweepStatus::read(input) {
        return Ok(StatusReport { sweep: Some(sweep), ..StatusReport::default() });
    }
    if input.is_dir() {
        return Err(JobError::input(format!("{} is a folder: it has no results", input.display())).into());
    }
    if let Some(bootstrap) = BootstrapStatus::read(input.to_owned()) {
        return Ok(StatusReport { bootstrap: Some(bootstrap), ..StatusReport::default() });
    }
    let path = if input.extension().is_some_and(|extension| extension == "toml") {
        Study::load_any(input, &[])?.output().file.clone()
    } else {
        input.to_owned()
    };
    let result = path.is_file().then(|| ResultStatus::read(&path)).transpose()?;
    let checkpoint = checkpoint_path(&path);
    let mut unfinished = Vec::new();
    if let Some(finding) = RowFile::read(&checkpoint)? {
        unfinished.push(UnfinishedStatus::from_finding(&checkpoint, &finding, result.is_some()));
    }
    for shard in shards_of(&path) {
        if let Ok(Some(finding)) = RowFile::read(&shard) {
            unfinished.push(UnfinishedStatus::from_finding(&shard, &finding, false));
        }
    }
    let (slices, written_by) = (slices_of(&path), ResultLock::holder(&path));
    let sweep = SweepStatus::read(&sweep_beside(&path));
    if result.is_none() && unfinished.is_empty() && slices.is_empty() && sweep.is_none() && written_by.is_none() {
        return Err(
            JobError::input(format!("{}: no result, and no checkpoint of an unfinished run", path.display())).into()
        );
    }
    let bootstrap = BootstrapStatus::read(part_path(&path));
    Ok(StatusReport { result, unfinished, slices, sweep, bootstrap, written_by })
}

/// Files named as the shards of the result at `result`, and as the checkpoints and shards of what is asked of it.
fn shards_of(result: &Path) -> Vec<PathBuf> {
    let text = |name: Option<&OsStr>| name.unwrap_or(result.as_os_str()).to_string_lossy().into_owned();
    let (own, asked) = (format!("{}.{SHARD}", text(result.file_stem())), format!("{}.", text(result.file_name())));
    let of_question =
        |rest: &str| rest.rsplit_once('.').is_some_and(|(_, end)| end == "part" || end.starts_with(SHARD));
    let is_one = |name: &str| name.starts_with(&own) || name.strip_prefix(&asked).is_some_and(of_question);
    let mut shards: Vec<PathBuf> = neighbours(result).filter(|(name, _)| is_one(name)).map(|(_, path)| path).collect();
    shards.sort();
    shards
}

/// Slices by their names, `study.slice-3-of-8.h5`, of each number that a table was cut into.
fn slices_of(result: &Path) -> Vec<SlicesStatus> {
    let own = format!("{}.{SLICE}", result.file_stem().unwrap_or_default().to_string_lossy());
    let mut by_count: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (name, _) in neighbours(result) {
        let numbers = name.strip_prefix(&own).and_then(|rest| rest.strip_suffix(".h5")?.split_once("-of-"));
        if let Some((Ok(number), Ok(count))) = numbers.map(|(number, count)| (number.parse(), count.parse())) {
            by_count.entry(count).or_default().push(number);
        }
    }
    let sorted = |(count, mut done): (usize, Vec<usize>)| {
        done.sort_unstable();
        SlicesStatus { count, done }
    };
    by_count.into_iter().map(sorted).collect()
}

/// What is in the folder of a result, with the name of each.
fn neighbours(result: &Path) -> impl Iterator<Item = (String, PathBuf)> {
    in_folder(folder_of(result))
}

/// What is in a folder, with the name of each.
fn in_folder(folder: &Path) -> impl Iterator<Item = (String, PathBuf)> + use<> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| (entry.file_name().to_string_lossy().into_owned(), entry.path()))
}

/// The results in a folder.
fn results_in(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let is_result = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "h5");
    in_folder(folder).filter(|(name, _)| !name.ends_with(SITE_ARRAYS)).map(|(_, path)| path).filter(is_result)
}

/// The checkpoints of unfinished runs in a folder.
fn unfinished_in(folder: &Path) -> Vec<UnfinishedStatus> {
    let mut checkpoints: Vec<PathBuf> =
        in_folder(folder).filter(|(name, _)| name.ends_with(".h5.part")).map(|(_, path)| path).collect();
    checkpoints.sort();
    let read = |path: &PathBuf| {
        let has_result = path.with_extension("").is_file();
        Some(UnfinishedStatus::from_finding(path, &RowFile::read(path).ok()??, has_result))
    };
    checkpoints.iter().filter_map(read).filter(|unfinished| !unfinished.is_kept_for_others).collect()
}

impl SweepStatus {
    /// Of a `folder` with results or checkpoints.
    fn read(folder: &Path) -> Option<Self> {
        let mut results: Vec<PathBuf> = results_in(folder).collect();
        results.sort();
        let is_of_sweep = |path: &PathBuf| {
            let head = ResultFile::open(path).and_then(|file| file.head());
            head.is_ok_and(|head| head.command.contains(" sweep "))
        };
        let is_named = folder.extension().is_some_and(|extension| extension == "sweep");
        let is_certain = is_named || results.iter().any(is_of_sweep);
        let unfinished = unfinished_in(folder);
        let lacks_comparison = is_certain && !comparison(folder).exists();
        let is_empty = results.is_empty() && unfinished.is_empty();
        let folder = folder.to_owned();
        (!is_empty).then_some(Self { folder, results, is_certain, lacks_comparison, unfinished })
    }
}

impl BootstrapStatus {
    fn read(file: PathBuf) -> Option<Self> {
        let Interrupted { strengths, command } = interrupted(&file)?;
        Some(Self { file, strengths, command })
    }
}

impl ResultStatus {
    fn read(path: &Path) -> Result<Self, UpliftError> {
        let file = ResultFile::open(path)?;
        let head = file.head()?;
        let study_digest = head.study_digest();
        Ok(Self {
            file: path.to_owned(),
            made_of_another: made_of(path, &study_digest),
            study_digest,
            overrides: head.overrides.unwrap_or_default(),
            created: head.created,
            version: head.version,
            commit: head.commit,
            study: head.study_file,
            title: head.title,
            record_set: head.record_set,
            content: file.overview()?,
            asked: file.findings()?.into_iter().map(AskedStatus::from_finding).collect(),
        })
    }
}

impl AskedStatus {
    fn from_finding(stored: StoredFinding) -> Self {
        let StoredFinding { finding, created, is_of_earlier_file, .. } = stored;
        Self { question: finding.question(), structure: finding.structure, created, is_of_earlier_file }
    }
}

impl UnfinishedStatus {
    fn from_finding(file: &Path, finding: &Finding, has_result: bool) -> Self {
        let head = &finding.head;
        Self {
            file: file.to_owned(),
            title: head.title.clone(),
            shard: head.shard,
            shards: head.shards,
            done: finding.analyses(),
            analyses: head.analyses,
            is_kept_for_others: has_result && finding.is_finished_with_others(),
            damaged_bytes: finding.damaged_bytes,
        }
    }
}
