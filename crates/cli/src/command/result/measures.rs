//! `uplift measures`: which intensity measure to trust.

use clap::Args;
use uplift::efficiency::{EfficiencyOptions, efficiency};

use crate::command::arguments::ResultArguments;
use crate::error::CommandError;
use crate::show::{print_efficiency, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift measures results/study.h5")]
pub(crate) struct MeasuresArguments {
    #[command(flatten)]
    result: ResultArguments,
    #[command(flatten)]
    options: EfficiencyOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn measures(arguments: &MeasuresArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let found = arguments.result.find(terminal)?;
    let options = EfficiencyOptions { force: arguments.result.force(), ..arguments.options.clone() };
    let report = efficiency(&found.path, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_efficiency(&report, terminal) }
}
