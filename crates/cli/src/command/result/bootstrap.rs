//! `uplift bootstrap`: confidence bands (Section 4.5, Table 4.1).

use std::path::PathBuf;

use clap::Args;
use uplift::bootstrap::{BootstrapOptions, bootstrap as run, read_reference};
use uplift::spectrum::spectrum;
use uplift::uniform_risk::DisplacementOptions;

use crate::command::arguments::{RARE, ResultArguments, command_line};
use crate::error::CommandError;
use crate::show::{print_bootstrap, print_json};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift bootstrap results/study.h5\n  \
                  uplift bootstrap results/study.h5 --sizes 20,40 --details")]
pub(crate) struct BootstrapArguments {
    #[command(flatten)]
    result: ResultArguments,
    #[command(flatten)]
    options: BootstrapOptions,
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
    let options = BootstrapOptions {
        study: found.bootstrap,
        reference: reference.unwrap_or_default(),
        command: command_line(),
        force: arguments.result.force(),
        ..arguments.options.clone()
    };
    let report = run(&found.path, &options, terminal)?;
    if arguments.json {
        return print_json(&report);
    }
    let shown = spectrum(&report.stored.path, &DisplacementOptions::default())?;
    print_bootstrap(&report, &shown, terminal)
}
