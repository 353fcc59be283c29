//! `uplift run`: the main job, end to end.

use std::path::PathBuf;

use clap::Args;
use uplift::analysis::shard_path;
use uplift::{RunOptions, run_shard};
use uplift_ida::Shard;
use uplift_study::SiteSlice;

use crate::command::arguments::{Overwriting, StudyArguments, shard};
use crate::error::CommandError;
use crate::show::{print_run, print_run_json, print_shard};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift run study.toml\n  \
                  uplift run study.toml --set records.first=20 -o results/twenty.h5")]
pub(crate) struct RunArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Result file [default: the study's output.file]
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: Overwriting,
    /// Compute only shard I of N
    #[arg(
        long,
        value_name = "I/N",
        value_parser = shard
    )]
    shard: Option<Shard>,
    /// Compute only slice I of N of the table of sites
    #[arg(long, value_name = "I/N", conflicts_with = "shard")]
    sites: Option<SiteSlice>,
    /// Compute the result again, even if it exists
    #[arg(long)]
    again: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &RunArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let output = arguments.output.as_deref();
    let (study, options) = arguments.study.load_slice(arguments.sites, output, arguments.overwriting.force)?;
    if let Some(shard) = arguments.shard {
        let path = arguments.output.clone().unwrap_or_else(|| shard_path(&study.output().file, shard));
        if path.extension().is_some_and(|ending| ending == "h5") {
            return Err(CommandError::Usage(format!(
                "{}: a shard is not yet a result, so its name must not end in .h5: write -o {}, and join the \
                 shards by `uplift merge`",
                path.display(),
                shard_path(&path, shard).display()
            )));
        }
        return print_shard(&run_shard(&study, &path, shard, None, terminal)?, terminal);
    }
    let options = RunOptions { again: arguments.again, ..options };
    let report = uplift::run(&study, &options, terminal)?;
    if arguments.json { print_run_json(&report) } else { print_run(&report, terminal) }
}
