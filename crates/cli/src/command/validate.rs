//! `uplift validate`: computed peaks beside measured ones.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use uplift::validate::{PRule, ValidateOptions, validate as compute};
use uplift_report::{check_figure_file, plot_validation, plot_validation_pairs};
use uplift_validation::BandRule;

use super::arguments::{ForceArgument, number};
use crate::error::CommandError;
use crate::show::{print_json, print_validation};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift validate measured.csv computed.csv --by group --plot peaks.svg\n\n\
                  A value may be inf or overturned for a collapse, >0.35 for a peak above a limit; a blank is \
                  ignored.\nMeaning of the tests: docs/validation.md")]
pub(super) struct ValidateArguments {
    /// Measured peaks: CSV with a header, or a shake table's result
    measured: PathBuf,
    /// Computed peaks: CSV with a header, or a shake table's result
    computed: PathBuf,
    /// Column of the peaks with its unit
    #[arg(long, value_name = "COLUMN", default_value = "u_m")]
    value: String,
    /// Columns that identify a motion [default: exc_id, if there]
    #[arg(long, value_name = "COLUMN[,…]", value_delimiter = ',')]
    key: Vec<String>,
    /// Columns to group by
    #[arg(long, value_name = "COLUMN[,…]", value_delimiter = ',')]
    by: Vec<String>,
    /// p-value of the Kolmogorov-Smirnov test (Table 6.2 has kstest2)
    #[arg(long, value_enum, default_value_t = Rule::Exact, help_heading = STATISTICS)]
    p: Rule,
    /// Add the p-value by permutations within pairs
    #[arg(long, help_heading = STATISTICS)]
    permutation: bool,
    /// Significance level of the power
    #[arg(
        long, value_name = "P", default_value_t = ValidateOptions::default().significance,
        allow_negative_numbers = true, value_parser = number, help_heading = STATISTICS
    )]
    significance: f64,
    /// Number of resamples and permutations
    #[arg(
        long, value_name = "N", default_value_t = ValidateOptions::default().replicates, help_heading = STATISTICS
    )]
    replicates: u32,
    /// Random seed
    #[arg(long, value_name = "N", default_value_t = ValidateOptions::default().seed, help_heading = STATISTICS)]
    seed: u64,
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
    overwriting: ForceArgument,
}

const STATISTICS: &str = "Statistics";
const OUTPUT: &str = "Output";

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Rule {
    /// Of all orders of the values
    Exact,
    /// By Kolmogorov's distribution
    Kolmogorov,
    /// By the formula of MATLAB's kstest2
    Kstest2,
}

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
    let inputs = [&arguments.measured, &arguments.computed];
    for figure in arguments.plot.iter().chain(&arguments.plot_pairs) {
        check_figure_file(figure, &inputs, force)?;
    }
    let options = ValidateOptions {
        measured: arguments.measured.clone(),
        computed: arguments.computed.clone(),
        value: arguments.value.clone(),
        key: arguments.key.clone(),
        by: arguments.by.clone(),
        p_rule: match arguments.p {
            Rule::Exact => PRule::Exact,
            Rule::Kolmogorov => PRule::Kolmogorov,
            Rule::Kstest2 => PRule::Kstest2,
        },
        significance: arguments.significance,
        replicates: arguments.replicates,
        seed: arguments.seed,
        permutation: arguments.permutation,
        band: match arguments.band {
            BandWord::Greenwood => BandRule::Greenwood,
            BandWord::Dkw => BandRule::Dkw,
            BandWord::Bootstrap => BandRule::Bootstrap,
        },
        table: arguments.output.clone(),
        force,
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
