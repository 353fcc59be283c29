//! `uplift run`: the main job, end to end.

#[cfg(feature = "mpi")]
mod mpi;

use std::io::Write;
use std::path::PathBuf;

use crate::error::CommandError;
use clap::Args;
use uplift::RunOptions;
use uplift::uniform_risk::{MOST_SHARDS, run_shard, shard_path};
use uplift_ida::Part;
use uplift_study::AnyStudy;

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
    /// Compute only part I of N of the stripes, into a file of its own; `uplift merge` joins the parts
    #[arg(
        long,
        value_name = "I/N",
        value_parser = shard,
        help = "Compute only part I of N of the stripes, into a file of its own (-o names it); uplift merge joins the \
                parts"
    )]
    shard: Option<Part>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

fn shard(text: &str) -> Result<Part, String> {
    let numbers = text
        .split_once('/')
        .and_then(|(index, count)| Some((index.trim().parse::<u64>().ok()?, count.trim().parse::<u64>().ok()?)));
    match numbers {
        Some((index, count)) if index >= 1 && index <= count && count <= MOST_SHARDS => {
            Ok(Part { index: index - 1, count })
        }
        _ => Err(format!("write 1/8 for the first of eight parts; at most {MOST_SHARDS}")),
    }
}

pub(super) fn run(arguments: &RunArguments, terminal: &Terminal) -> Result<(), CommandError> {
    #[cfg(feature = "mpi")]
    if let Some(outcome) = mpi::run(arguments, terminal) {
        return outcome;
    }
    let study = arguments.study.load_any()?;
    if let Some(part) = arguments.shard {
        let AnyStudy::UniformRisk(study) = study else {
            return Err(CommandError::Usage(
                "--shard cuts the stripes of a study of uniform risk; this one is of displacement spectra, a matter of \
                 minutes: run it as a whole"
                    .to_owned(),
            ));
        };
        let path = arguments.output.clone().unwrap_or_else(|| shard_path(&study.output.file, part));
        let report = run_shard(&study, &path, part, None, terminal)?;
        let file = shown_path(&report.file).display();
        writeln!(std::io::stdout(), "shard {} of {}, {} pieces: {file}", report.shard, report.shards, report.rows)?;
        return Ok(());
    }
    let options = run_options(&arguments.study, arguments.output.clone());
    let report = uplift::run(&study, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_run(&report, terminal) }
}

/// The options of a run that was typed.
pub(super) fn run_options(study: &StudyArguments, output: Option<PathBuf>) -> RunOptions {
    RunOptions { study_file: study.study.clone(), output, command: super::command_line() }
}
