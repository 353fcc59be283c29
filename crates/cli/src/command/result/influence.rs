//! `uplift influence`: which records carry the spectra, and which intensities.

use clap::Args;
use uplift::influence::{InfluenceOptions, influence as run};

use crate::command::arguments::{ResultArguments, number, probability};
use crate::error::CommandError;
use crate::show::{print_influence, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift influence results/study.h5")]
pub(crate) struct InfluenceArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Number of records shown for each site
    #[arg(long, value_name = "N", default_value_t = InfluenceOptions::default().top)]
    top: usize,
    /// Probability of exceedance, 0.1 or 10% [default: the smallest]
    #[arg(long, value_parser = probability)]
    poe: Option<f64>,
    /// Return period in years instead
    #[arg(long, value_name = "YEARS", conflicts_with = "poe", value_parser = number)]
    return_period: Option<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn influence(arguments: &InfluenceArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let found = arguments.result.find(terminal)?;
    let options = InfluenceOptions {
        poe: arguments.poe,
        return_period: arguments.return_period,
        top: arguments.top,
        force: arguments.result.force(),
    };
    let report = run(&found.path, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_influence(&report, terminal) }
}
