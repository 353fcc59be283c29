//! `uplift merge`: the shards of a run, or the slices of its table of sites, joined into its result.

use std::path::PathBuf;

use clap::Args;
use uplift_study::SiteSlice;

use crate::command::arguments::{Overwriting, RARE, StudyArguments};
use crate::error::CommandError;
use crate::show::{print_run, print_run_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift merge study.toml results/study.shard-*\n  \
                  uplift merge study.toml results/study.slice-*-of-1000.h5")]
pub(crate) struct MergeArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// All shards or slices, from uplift run STUDY --shard or --sites I/N
    #[arg(required = true, value_name = "SHARD")]
    shards: Vec<PathBuf>,
    /// Of shards: join only slice I of N of the table of sites
    #[arg(long, value_name = "I/N", help_heading = RARE)]
    sites: Option<SiteSlice>,
    /// Result file [default: the study's output.file]
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: Overwriting,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn merge(arguments: &MergeArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let output = arguments.output.as_deref();
    let (study, options) = arguments.study.load_slice(arguments.sites, output, arguments.overwriting.force)?;
    let report = uplift::merge(&study, &arguments.shards, &options, terminal)?;
    if arguments.json { print_run_json(&report) } else { print_run(&report, terminal) }
}
