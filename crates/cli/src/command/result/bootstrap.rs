//! `uplift bootstrap`: confidence bands (Section 4.5, Table 4.1).

use std::path::PathBuf;

use clap::Args;
use uplift::bootstrap::{BootstrapOptions, bootstrap as run, read_reference};
use uplift::spectrum::spectrum;
use uplift::uniform_risk::DisplacementOptions;
use uplift_bootstrap::{Interval, Unit};

use crate::command::arguments::{RARE, ResultArguments};
use crate::error::CommandError;
use crate::show::{print_bootstrap, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift bootstrap results/study.h5\n  \
                  uplift bootstrap results/study.h5 --sizes 20,40 --details")]
pub(crate) struct BootstrapArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Records in a resample, e.g. 20,40,60 [default: the study's, else 20,40,60,80 and all]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=100_000))]
    sizes: Option<Vec<u32>>,
    /// Number of resamples of each size [default: the study's, else 1000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    replicates: Option<u64>,
    /// Random seed [default: the study's]
    #[arg(long, help_heading = RARE, value_parser = clap::value_parser!(u64).range(..=i64::MAX as u64))]
    seed: Option<u64>,
    /// Method of the limits: percentile or bca
    #[arg(long, help_heading = RARE, value_parser = ["percentile", "bca"])]
    interval: Option<String>,
    /// Unit of a resample: record, pair or event (earthquake)
    #[arg(long, help_heading = RARE, value_parser = ["record", "pair", "event"], conflicts_with = "plan")]
    unit: Option<String>,
    /// Add simultaneous bands, which hold for whole spectra
    #[arg(long)]
    simultaneous: bool,
    /// Draw the same resamples as another result
    #[arg(long, help_heading = RARE, value_name = "RESULT.h5", conflicts_with_all = ["sizes", "replicates", "seed"])]
    plan: Option<PathBuf>,
    /// Table to compare with
    #[arg(long, help_heading = RARE, value_name = "FILE.csv")]
    reference: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn bootstrap(arguments: &BootstrapArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let reference = arguments.reference.as_deref().map(read_reference).transpose()?;
    let found = arguments.result.find(terminal)?;
    let interval = arguments.interval.as_deref();
    let options = BootstrapOptions {
        study: found.bootstrap,
        sizes: arguments.sizes.clone(),
        replicates: arguments.replicates,
        seed: arguments.seed,
        interval: interval.map(|word| if word == "bca" { Interval::Bca } else { Interval::Percentile }),
        unit: arguments.unit.as_deref().and_then(|word| Unit::ALL.into_iter().find(|unit| unit.key() == word)),
        simultaneous: arguments.simultaneous,
        plan: arguments.plan.clone(),
        reference: reference.unwrap_or_default(),
        force: arguments.result.force(),
    };
    let report = run(&found.path, &options, terminal)?;
    if arguments.json {
        return print_json(&report);
    }
    let shown = spectrum(&report.result, &DisplacementOptions::default())?.found;
    print_bootstrap(&report, &shown, terminal)
}
