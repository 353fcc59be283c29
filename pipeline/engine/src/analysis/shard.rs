//! The work shared among machines: shards, and the joining of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_ida::Shard;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::lock::ResultLock;
use uplift_job::outputs::{beside, provide_folder};
use uplift_job::text::counted;

use super::Work;
use crate::checkpoint::{Checkpoint, FinishedRows, RowFile, RowFileHead, in_brackets};
use crate::error::EngineError;

/// Most shards that a work is cut into.
pub const MOST_SHARDS: u64 = 100_000;
/// Shards named in a message.
const NAMED: usize = 10;

/// What computing a shard tells.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ShardReport {
    /// Which, from 1.
    pub shard: u64,
    /// Of how many.
    pub shards: u64,
    /// Its rows of the analysis.
    pub rows: u64,
    /// The file that holds them.
    pub file: PathBuf,
}

/// What the ending of a file with the rows of a shard begins with.
pub const SHARD: &str = "shard-";

/// The ending of the file with the rows of a shard.
pub(super) fn shard_ending(Shard { index, count }: Shard) -> String {
    let width = count.to_string().len();
    format!("{SHARD}{:0width$}-of-{count}", index + 1)
}

/// Where the rows of one shard of the analyses of the result at `result` are kept.
pub fn shard_path(result: &Path, shard: Shard) -> PathBuf {
    beside(result, &shard_ending(shard))
}

/// Makes the folder of the file of a shard, and keeps others off the file.
///
/// # Errors
/// A folder that cannot be made or written, another job that has the file.
pub fn hold(path: &Path) -> Result<ResultLock, EngineError> {
    if let Some(folder) = path.parent() {
        provide_folder(folder)?;
    }
    Ok(ResultLock::acquire(path)?)
}

/// Carries out one shard of `work` into the file `path`, and then whatever else of it `also` puts there.
///
/// # Errors
/// As [`Work::carry_out`]; a file that is a shard of other work.
pub fn carry_out_shard<E: From<EngineError>>(
    work: Work<'_>,
    (path, shard): (&Path, Shard),
    events: &dyn Events,
    also: &dyn Fn(&Checkpoint) -> Result<(), E>,
) -> Result<ShardReport, E> {
    let [_, rows] = work.share_of(shard, &FinishedRows::default());
    let checkpoint = work.open_checkpoint(path, shard)?;
    events.resumes_from(path);
    work.carry_out(&checkpoint, shard, events, &mut |_, _| Ok(()))?;
    also(&checkpoint)?;
    checkpoint.sync().map_err(EngineError::from)?;
    Ok(ShardReport { shard: shard.index + 1, shards: shard.count, rows, file: path.to_owned() })
}

/// Carries out one shard of `work`, asked of a result, into the file `path`.
///
/// # Errors
/// As [`Work::carry_out`]; a file that is a shard of other work, or that another job has.
pub fn run_shard(work: Work<'_>, path: &Path, shard: Shard, events: &dyn Events) -> Result<ShardReport, EngineError> {
    let _lock = hold(path)?;
    carry_out_shard(work, (path, shard), events, &|_| Ok(()))
}

/// The analysis rows of all shards of `work`.
///
/// # Errors
/// Every shard that is missing, there twice, unfinished or of other work, at once.
pub fn join(paths: &[PathBuf], work: &Work<'_>) -> Result<FinishedRows, EngineError> {
    let head = work.head(Shard::WHOLE);
    let mut mistakes = Vec::new();
    let mut rows = FinishedRows::default();
    let mut found: BTreeMap<u64, &Path> = BTreeMap::new();
    let mut count: Option<(u64, &Path)> = None;
    for path in paths {
        let name = path.display();
        let finding = match RowFile::read(path) {
            Ok(Some(finding)) => finding,
            Ok(None) => {
                mistakes.push(format!("{name}: there is no such file"));
                continue;
            }
            Err(error) => {
                mistakes.push(error.to_string());
                continue;
            }
        };
        let RowFileHead { shard, shards, .. } = finding.head;
        if !(1..=MOST_SHARDS).contains(&shards) || !(1..=shards).contains(&shard) {
            mistakes.push(format!("{name}: claims to be shard {shard} of {shards}: the file is damaged"));
            continue;
        }
        if finding.head.work != head.work {
            mistakes.push(format!(
                "{name}: is a shard of other work{}: of another study, of other records, or of another version of the \
                 program",
                in_brackets(&finding.head.title)
            ));
            continue;
        }
        let (shards_before, first) = *count.get_or_insert((shards, path));
        if shards != shards_before {
            mistakes.push(format!(
                "{name}: is shard {shard} of {shards}, but {} is one of {shards_before}: merge shards of the same \
                 number",
                first.display()
            ));
            continue;
        }
        if let Some(other) = found.insert(shard, path) {
            mistakes.push(format!("shard {shard} of {shards} is given twice: {} and {name}", other.display()));
        }
        let [has, of_shard] = work.share_of(Shard { index: shard - 1, count: shards }, &finding.rows);
        if has < of_shard {
            mistakes.push(format!(
                "{name}: has {has} of its {of_shard} analysis rows: run --shard {shard}/{shards} again to \
                 resume it"
            ));
        }
        rows.extend(finding.rows);
    }
    if let Some((shards, _)) = count {
        let missing: Vec<u64> = (1..=shards).filter(|shard| !found.contains_key(shard)).collect();
        let named: Vec<String> = missing.iter().take(NAMED).map(|shard| format!("{shard}/{shards}")).collect();
        if !missing.is_empty() {
            let more = if missing.len() > NAMED { ", …" } else { "" };
            mistakes.push(format!("{} missing: {}{more}", counted(missing.len(), "shard"), named.join(", ")));
        }
    }
    if mistakes.is_empty() { Ok(rows) } else { Err(JobError::Inputs(mistakes).into()) }
}
