//! `uplift spectrum`: displacements at any strength and return period, with their confidence bands.

use clap::Args;
use uplift::spectrum::spectrum as read;
use uplift::uniform_risk::DisplacementOptions;

use crate::command::arguments::{Numbers, ResultArguments, all_numbers, numbers};
use crate::error::CommandError;
use crate::show::{print_answer_json, print_spectrum, print_spectrum_csv};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift spectrum results/quick.h5\n  \
    uplift spectrum results/quick.h5 --strength 0.13 --return-period 475\n  \
    uplift spectrum results/quick.h5 --site Athens --poe 10%,2% --csv")]
pub(crate) struct SpectrumArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Uplift strengths [default: about 0.1, 0.2 and 0.4]
    #[arg(
        long,
        value_name = "STRENGTH[,…]",
        allow_negative_numbers = true,
        value_parser = numbers
    )]
    strength: Vec<Numbers>,
    #[command(flatten)]
    options: DisplacementOptions,
    /// Print JSON
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print CSV
    #[arg(long)]
    csv: bool,
}

pub(crate) fn spectrum(arguments: &SpectrumArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let result = arguments.result.find_to_read(terminal)?;
    let strengths = all_numbers(&arguments.strength);
    let asked = DisplacementOptions { strengths, ..arguments.options.clone() };
    let report = read(&result, &asked)?;
    match (arguments.json, arguments.csv) {
        (true, _) => print_answer_json(&report, &result),
        (_, true) => print_spectrum_csv(&report, &result, terminal),
        _ => print_spectrum(&report, &result, terminal),
    }
}
