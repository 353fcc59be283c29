//! `uplift table`: the coefficients of Eq. 4.11, ours beside a reference; for displacement spectra the design example.

use std::path::PathBuf;

use clap::Args;
use uplift::result::AskedRisk;
use uplift::table::{TableMeasure, TableOptions, table as table_of};
use uplift_motion::MotionError;

use crate::error::CommandError;
use crate::show::{print_json, print_table};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift table results/study.h5\n  \
                  uplift table results/study.h5 --measure pga --return-period 475")]
pub(crate) struct TableArguments {
    /// Result file, or a structure file with columns
    result: PathBuf,
    /// Table to compare with
    #[arg(long, value_name = "FILE.csv")]
    reference: Option<PathBuf>,
    /// Intensity measure [default: pgv]
    #[arg(long, alias = "im", value_name = "pgv|pga|sa_1s|...|all", value_parser = which_measure)]
    measure: Option<TableMeasure>,
    #[command(flatten)]
    risk: AskedRisk,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A measure, or all of them.
fn which_measure(word: &str) -> Result<TableMeasure, MotionError> {
    if word.trim().eq_ignore_ascii_case("all") {
        return Ok(TableMeasure::All);
    }
    word.parse().map(TableMeasure::Only)
}

pub(crate) fn table(arguments: &TableArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = TableOptions {
        result: arguments.result.clone(),
        reference: arguments.reference.clone(),
        measure: arguments.measure.unwrap_or_default(),
        risk: arguments.risk.clone(),
    };
    let report = table_of(&options, terminal)?;
    if arguments.json { print_json(&report) } else { print_table(&report, &arguments.result, terminal) }
}
