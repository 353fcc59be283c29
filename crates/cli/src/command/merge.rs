//! `uplift merge`: the shards of a run joined into its result.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;

use super::run::{MOST_SHARDS, Work, print_outcome, run_study_from};
use super::{Terminal, StudyArguments};
use uplift::UpliftError;
use uplift::inputs::read_records;
use uplift::checkpoint::{KeptPieces, PieceFile, PieceFileHead};
use uplift_ida::Part;

/// Shards named in a message.
const NAMED: usize = 10;

#[derive(Debug, Args)]
pub(super) struct MergeArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Every shard of the run, as `uplift run STUDY --shard I/N` wrote them
    #[arg(required = true, value_name = "SHARD")]
    shards: Vec<PathBuf>,
    /// Result file, instead of the study's output.file
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn merge(arguments: &MergeArguments, session: &Terminal) -> Result<(), UpliftError> {
    let study = arguments.study.load()?;
    let records = read_records(&study)?;
    let work = Work::new(&study, &records)?;
    let kept = join(&arguments.shards, &work)?;
    drop(work);
    drop(records);
    session.remark("merged", &format!(
"{} pieces of {} shards", kept.len(), arguments.shards.len()));
    let path = arguments.output.clone().unwrap_or_else(|| study.output.file.clone());
    run_study_from(&study, &arguments.study.study, &path, kept, session, |outcome, files, seconds| {
        print_outcome(arguments.json, session, outcome, files, seconds)
    })
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
