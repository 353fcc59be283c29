//! `uplift measures`: which intensity measure to trust.

use clap::Args;
use uplift::efficiency::{EfficiencyOptions, efficiency, usual_measures};
use uplift_motion::IntensityMeasure;

use crate::command::arguments::ResultArguments;
use crate::error::CommandError;
use crate::show::{print_efficiency, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift measures results/study.h5")]
pub(crate) struct MeasuresArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Measure to compare; repeat for several [default: ten usual ones]
    #[arg(long = "measure", value_name = "MEASURE")]
    measures: Vec<IntensityMeasure>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn measures(arguments: &MeasuresArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let found = arguments.result.find(terminal)?;
    let measures = if arguments.measures.is_empty() { usual_measures() } else { arguments.measures.clone() };
    let options = EfficiencyOptions { measures, force: arguments.result.force() };
    let report = efficiency(&found.path, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_efficiency(&report, terminal) }
}
