//! `uplift validate`: computed peaks beside measured ones.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use uplift::validate::{ValidateOptions, validate as compute};
use uplift_report::{check_figure_file, plot_validation, plot_validation_pairs};
use uplift_validation::BandRule;

use super::arguments::Overwriting;
use crate::error::CommandError;
use crate::show::{print_json, print_validation};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift validate measured.csv computed.csv --by group --plot peaks.svg\n\n\
                  A value may be inf or overturned for a collapse, >0.35 for a peak above a limit; a blank is \
                  ignored.\nMeaning of the tests: docs/validation.md")]
pub(super) struct ValidateArguments {
    #[command(flatten)]
    options: ValidateOptions,
    /// Write the statistics
    #[arg(short, long, value_name = "FILE.csv", help_heading = OUTPUT)]
    output: Option<PathBuf>,
    /// Draw the distributions
    #[arg(long, value_name = "FILE.svg|png", help_heading = OUTPUT)]
    plot: Option<PathBuf>,
    /// Band of the measured distribution
    #[arg(long, value_enum, default_value_t = BandWord::Greenwood, help_heading = OUTPUT)]
    band: BandWord,
    /// Draw computed over measured peaks
    #[arg(long, value_name = "FILE.svg|png", help_heading = OUTPUT)]
    plot_pairs: Option<PathBuf>,
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    json: bool,
    #[command(flatten, next_help_heading = OUTPUT)]
    overwriting: Overwriting,
}

const OUTPUT: &str = "Output";

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum BandWord {
    /// Pointwise, as MATLAB's ecdf
    Greenwood,
    /// Of the whole distribution at once
    Dkw,
    /// Pointwise, over resamples of the motions
    Bootstrap,
}

pub(super) fn validate(arguments: &ValidateArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let force = arguments.overwriting.force;
    let inputs = [&arguments.options.measured, &arguments.options.computed];
    for figure in arguments.plot.iter().chain(&arguments.plot_pairs) {
        check_figure_file(figure, &inputs, force)?;
    }
    let options = ValidateOptions {
        band: match arguments.band {
            BandWord::Greenwood => BandRule::Greenwood,
            BandWord::Dkw => BandRule::Dkw,
            BandWord::Bootstrap => BandRule::Bootstrap,
        },
        table: arguments.output.clone(),
        force,
        ..arguments.options.clone()
    };
    let mut report = compute(&options, terminal)?;
    if let Some(figure) = &arguments.plot {
        plot_validation(&report, figure)?;
        report.files.push(figure.clone());
    }
    if let Some(figure) = &arguments.plot_pairs {
        plot_validation_pairs(&report, figure)?;
        report.files.push(figure.clone());
    }
    if arguments.json { print_json(&report) } else { print_validation(&report, terminal) }
}
