//! `uplift merge`: the shards of a run joined into its result.

use std::path::PathBuf;

use clap::Args;

use crate::command::arguments::{ForceArgument, StudyArguments, run_options};
use crate::error::CommandError;
use crate::show::{print_json, print_run};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift merge study.toml results/*.part")]
pub(crate) struct MergeArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// All shards of the run, from uplift run STUDY --shard I/N
    #[arg(required = true, value_name = "SHARD")]
    shards: Vec<PathBuf>,
    /// Result file [default: the study's output.file]
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: ForceArgument,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn merge(arguments: &MergeArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let study = arguments.study.load_any()?;
    let options = run_options(&arguments.study, arguments.output.clone(), arguments.overwriting.force);
    let report = uplift::merge(&study, &arguments.shards, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_run(&report, terminal) }
}
