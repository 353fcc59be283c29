//! `uplift report`: one page to hand over.

use std::path::PathBuf;

use clap::Args;
use uplift::result::AskedRisk;
use uplift_report::{ReportOptions, report as write_report};

use crate::command::arguments::ForceArgument;
use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift report results/study.h5")]
pub(crate) struct ReportArguments {
    /// Result files; several are compared
    #[arg(required = true, value_name = "RESULT")]
    results: Vec<PathBuf>,
    /// Page to write [default: the first result with .html]
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,
    /// Embed the calculator with this result: web/dist/index.html of `make web`; adds 2 MB, and some 40 kB a record
    #[arg(long, value_name = "PAGE.html")]
    explore: Option<PathBuf>,
    #[command(flatten)]
    risk: AskedRisk,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(crate) fn report(arguments: &ReportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = ReportOptions {
        results: arguments.results.clone(),
        output: arguments.output.clone(),
        risk: arguments.risk.clone(),
        explore: arguments.explore.clone(),
        force: arguments.overwriting.force,
    };
    print_files(&[write_report(&options, terminal)?.file], terminal)
}
