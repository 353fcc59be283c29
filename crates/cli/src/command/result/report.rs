//! `uplift report`: one page to hand over.

use clap::Args;
use uplift_report::{ReportOptions, report as write_report};

use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift report results/study.h5")]
pub(crate) struct ReportArguments {
    #[command(flatten)]
    options: ReportOptions,
}

pub(crate) fn report(arguments: &ReportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    print_files(&[write_report(&arguments.options, terminal)?.file], terminal)
}
