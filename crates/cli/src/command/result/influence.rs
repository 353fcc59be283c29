//! `uplift influence`: which records carry the spectra, and which intensities.

use clap::Args;
use uplift::influence::{InfluenceOptions, influence as run};

use crate::command::arguments::ResultArguments;
use crate::error::CommandError;
use crate::show::{print_influence, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift influence results/study.h5")]
pub(crate) struct InfluenceArguments {
    #[command(flatten)]
    result: ResultArguments,
    #[command(flatten)]
    options: InfluenceOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn influence(arguments: &InfluenceArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let found = arguments.result.find(terminal)?;
    let options = InfluenceOptions { force: arguments.result.force(), ..arguments.options };
    let report = run(&found.path, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_influence(&report, terminal) }
}
