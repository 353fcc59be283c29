//! `uplift table`: the coefficients of Eq. 4.11, ours beside a reference; for displacement spectra the design example.

use clap::Args;
use uplift::table::{TableOptions, table as table_of};

use crate::error::CommandError;
use crate::show::{print_answer_json, print_table};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift table results/study.h5\n  \
                  uplift table results/study.h5 --measure pga --return-period 475")]
pub(crate) struct TableArguments {
    #[command(flatten)]
    options: TableOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn table(arguments: &TableArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let report = table_of(&arguments.options, terminal)?;
    let result = &arguments.options.result;
    if arguments.json { print_answer_json(&report, result) } else { print_table(&report, result, terminal) }
}
