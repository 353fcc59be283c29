//! `uplift measures`: which intensity measure to trust.

use clap::Args;
use uplift::efficiency::{EfficiencyOptions, efficiency, usual_measures};
use uplift_motion::IntensityMeasure;

use crate::command::arguments::ResultArguments;
use crate::error::CommandError;
use crate::show::{print_efficiency, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(crate) struct MeasuresArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Measures to compare beside those of the stripes, given several times [default: ten with PGV, PGA, SA(0.5),
    /// SA(1), SA(2), AvgSA(0.2-2), PGD, CAV, Arias intensity and spectrum intensity]
    #[arg(long = "measure", value_name = "MEASURE")]
    measures: Vec<IntensityMeasure>,
    /// Print the rows as JSON
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
