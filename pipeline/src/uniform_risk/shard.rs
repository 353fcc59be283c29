//! The analyses of a study shared among machines: shards, and the joining of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_ida::Part;
use uplift_study::{AnyStudy, ResolvedStudy};

use super::{Work, open, site_table};
use crate::checkpoint::{KeptPieces, PieceFile, PieceFileHead};
use crate::error::UpliftError;
use crate::events::Events;
use crate::inputs::{read_hazard, read_records};
use crate::result::{ResultLock, check_target};
use crate::run::{RunOptions, RunReport, run_with};

/// Most parts that a run is cut into.
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

/// Where one part of the analyses of the result at `result` is kept.
pub fn shard_path(result: &Path, Part { index, count }: Part) -> PathBuf {
    let width = count.to_string().len();
    result.with_extension(format!("shard-{:0width$}-of-{count}", index + 1))
}

/// Carries out one part of the analyses of a study into the file `path`, but for what is known from an `earlier` result.
///
/// # Errors
/// As [`run`](crate::run()).
pub fn run_shard(
    study: &ResolvedStudy,
    path: &Path,
    part: Part,
    earlier: Option<&Path>,
    events: &dyn Events,
) -> Result<ShardReport, UpliftError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .map_err(|error| UpliftError::input(format!("{} cannot be made: {error}", folder.display())))?;
    }
    let _lock = ResultLock::acquire(path)?;
    // a mistake in the hazard is found before, not when the shards are joined
    read_hazard(study)?;
    let records = read_records(study)?;
    events.remark("records", &records.description);
    let work = Work::new(study, &records)?;
    let head = work.head(part);
    let (file, known) = open(path, &head, earlier)?;
    events.kept_in(path);
    work.carry_out(&known, &file, part, events)?;
    Ok(ShardReport { shard: part.index + 1, shards: part.count, rows: head.pieces, file: path.to_owned() })
}

/// Looks at everything that shards of a study share before machines begin with theirs, so that a mistake is said once: the
/// place of the result at `path`, the hazard, the table of sites.
///
/// # Errors
/// As [`run`](crate::run()).
pub fn check_shards(study: &ResolvedStudy, path: &Path, events: &dyn Events) -> Result<(), UpliftError> {
    check_target(path)?;
    read_hazard(study)?;
    site_table::read(study, path, events)?;
    Ok(())
}

/// Joins the `shards` of a run into its result.
///
/// # Errors
/// Every shard that is missing, there twice, unfinished or of other work, at once; else as [`run`](crate::run()).
pub fn merge(
    study: &ResolvedStudy,
    shards: &[PathBuf],
    options: &RunOptions,
    events: &dyn Events,
) -> Result<RunReport, UpliftError> {
    let records = read_records(study)?;
    let work = Work::new(study, &records)?;
    let known = join(shards, &work)?;
    drop(work);
    drop(records);
    events.remark("merged", &format!("{} pieces of {} shards", known.len(), shards.len()));
    run_with(&AnyStudy::UniformRisk(Box::new(study.clone())), options, known, events)
}

/// The pieces of all shards of `work`.
///
/// # Errors
/// Every shard that is missing, there twice, unfinished or of other work, at once.
fn join(paths: &[PathBuf], work: &Work<'_>) -> Result<KeptPieces, UpliftError> {
    let head = work.head(Part::WHOLE);
    let mut mistakes = Vec::new();
    let mut kept = KeptPieces::default();
    let mut found: BTreeMap<u64, &Path> = BTreeMap::new();
    let mut count: Option<(u64, &Path)> = None;
    for path in paths {
        let name = path.display();
        let finding = match PieceFile::read(path) {
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
        let PieceFileHead { shard, shards, .. } = finding.head;
        if !(1..=MOST_SHARDS).contains(&shards) || !(1..=shards).contains(&shard) {
            mistakes.push(format!("{name}: claims to be shard {shard} of {shards}: the file is damaged"));
            continue;
        }
        if finding.head.work != head.work {
            mistakes.push(format!(
                "{name}: is a shard of other work ({:?}): another study, other records, or another version of the program",
                finding.head.title
            ));
            continue;
        }
        let (shards_before, first) = *count.get_or_insert((shards, path));
        if shards != shards_before {
            mistakes.push(format!(
                "{name}: is shard {shard} of {shards}, and {} is of {shards_before}: merge the shards of one division",
                first.display()
            ));
            continue;
        }
        if let Some(other) = found.insert(shard, path) {
            mistakes.push(format!("{name}: is shard {shard} of {shards}, which {} is too", other.display()));
        }
        let [has, pieces] = work.share_of(Part { index: shard - 1, count: shards }, &finding.kept);
        if has < pieces {
            mistakes.push(format!(
                "{name}: has {has} of its {pieces} pieces: run --shard {shard}/{shards} again, it goes on where it stopped"
            ));
        }
        kept.extend(finding.kept);
    }
    if let Some((shards, _)) = count {
        let missing: Vec<u64> = (1..=shards).filter(|shard| !found.contains_key(shard)).collect();
        let named: Vec<String> = missing.iter().take(NAMED).map(|shard| format!("{shard}/{shards}")).collect();
        if !missing.is_empty() {
            let more = if missing.len() > NAMED { ", …" } else { "" };
            mistakes.push(format!("{} shard(s) missing: {}{more}", missing.len(), named.join(", ")));
        }
    }
    if mistakes.is_empty() { Ok(kept) } else { Err(UpliftError::Inputs(mistakes)) }
}
