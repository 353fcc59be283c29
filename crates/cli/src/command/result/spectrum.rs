//! `uplift spectrum`: displacements at any strength and return period, with their confidence bands.

use clap::Args;
use uplift::result::AskedRisk;
use uplift::spectrum::spectrum as read;
use uplift::uniform_risk::DisplacementOptions;
use uplift_motion::IntensityMeasure;

use crate::command::arguments::{Numbers, ResultArguments, number, numbers};
use crate::error::CommandError;
use crate::show::{print_json, print_spectrum, print_spectrum_csv};
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
    risk: AskedRisk,
    /// Sites [default: all]
    #[arg(long, value_name = "SITE[,…]", value_delimiter = ',')]
    site: Vec<String>,
    /// Intensity measure that records are scaled by [default: pgv]
    #[arg(long, alias = "im", value_name = "pgv|pga|sa_1s|...")]
    measure: Option<IntensityMeasure>,
    /// Displacement capacity, m: stiffness is negative after uplift (equal energy)
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    capacity_m: Option<f64>,
    /// Read the spectra repaired for hazard consistency
    #[arg(long)]
    repaired: bool,
    /// Print JSON
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print CSV
    #[arg(long)]
    csv: bool,
}

pub(crate) fn spectrum(arguments: &SpectrumArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let found = arguments.result.find(terminal)?;
    let asked = DisplacementOptions {
        strengths: arguments.strength.iter().flat_map(|Numbers(all)| all.iter().copied()).collect(),
        risk: arguments.risk.clone(),
        sites: arguments.site.clone(),
        measure: arguments.measure,
        capacity_m: arguments.capacity_m,
        repaired: arguments.repaired,
        ..DisplacementOptions::default()
    };
    let report = read(&found.path, &asked)?;
    match (arguments.json, arguments.csv) {
        (true, _) => print_json(&report),
        (_, true) => print_spectrum_csv(&report.found),
        _ => print_spectrum(&report, &found.path, terminal),
    }
}
