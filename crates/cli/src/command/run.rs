//! `uplift run`: the main job, end to end.

#[cfg(feature = "mpi")]
mod mpi;

use std::io::Write;
use std::path::PathBuf;

use crate::error::CommandError;
use clap::Args;
use uplift::analysis::{MOST_SHARDS, ShardReport, shard_path};
use uplift::{RunOptions, run_shard};
use uplift_ida::Shard;

use super::StudyArguments;
use crate::show::{print_json, print_run, shown_path};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct RunArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Result file, instead of the study's output.file
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    /// Compute only shard I of N of the analyses, into a file of its own; `uplift merge` joins the shards
    #[arg(
        long,
        value_name = "I/N",
        value_parser = shard,
        help = "Compute only shard I of N of the analyses, into a file of its own (-o names it); uplift merge joins \
                the shards"
    )]
    shard: Option<Shard>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text
        .split_once('/')
        .and_then(|(index, count)| Some((index.trim().parse::<u64>().ok()?, count.trim().parse::<u64>().ok()?)));
    match numbers {
        Some((index, count)) if index >= 1 && index <= count && count <= MOST_SHARDS => {
            Ok(Shard { index: index - 1, count })
        }
        _ => Err(format!("write 1/8 for the first of eight shards; at most {MOST_SHARDS}")),
    }
}

pub(super) fn run(arguments: &RunArguments, terminal: &Terminal) -> Result<(), CommandError> {
    #[cfg(feature = "mpi")]
    if let Some(outcome) = mpi::run(arguments, terminal) {
        return outcome;
    }
    let study = arguments.study.load_any()?;
    if let Some(shard) = arguments.shard {
        let path = arguments.output.clone().unwrap_or_else(|| shard_path(&study.output().file, shard));
        return print_shard(&run_shard(&study, &path, shard, None, terminal)?);
    }
    let options = run_options(&arguments.study, arguments.output.clone());
    let report = uplift::run(&study, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_run(&report, terminal) }
}

/// Which shard was computed, and where it is.
pub(super) fn print_shard(report: &ShardReport) -> Result<(), CommandError> {
    let ShardReport { shard, shards, rows, file } = report;
    let file = shown_path(file).display();
    Ok(writeln!(std::io::stdout(), "shard {shard} of {shards}, {rows} analysis rows: {file}")?)
}

/// The options of a run that was typed.
pub(super) fn run_options(study: &StudyArguments, output: Option<PathBuf>) -> RunOptions {
    RunOptions { study_file: study.study.clone(), output, command: super::command_line() }
}
