//! `uplift table`: the coefficients of Eq. 4.11, ours beside a reference; for displacement spectra the design example.

use std::path::PathBuf;

use clap::Args;
use uplift::table::{TableMeasure, TableOptions, table as table_of};
use uplift_motion::IntensityMeasure;

use crate::command::arguments::RiskArguments;
use crate::error::CommandError;
use crate::show::{print_json, print_table};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(crate) struct TableArguments {
    /// Result file of `uplift run`, or a structure file with columns
    result: PathBuf,
    /// Table to compare with
    #[arg(
        long,
        value_name = "FILE.csv",
        help = "Table to compare with: CSV with the columns site, poe_50y (or poe), c0_m, c1, c2_m, rmse_m; for \
                displacement spectra record_set, scaling, quantity, value and, for oscillators, rule (ED, EE); for a \
                structure quantity, value"
    )]
    reference: Option<PathBuf>,
    /// Which intensity measure, with the warnings of it alone; not for displacement spectra [default: pgv, with every
    /// warning]
    #[arg(long, value_parser = ["pgv", "pga", "all"], ignore_case = true)]
    im: Option<String>,
    #[command(flatten)]
    risk: RiskArguments,
    /// Print the rows as JSON
    #[arg(long)]
    json: bool,
}

impl TableArguments {
    fn measure(&self) -> TableMeasure {
        let Some(word) = &self.im else { return TableMeasure::Usual };
        let found = IntensityMeasure::ALL.into_iter().find(|measure| word.eq_ignore_ascii_case(measure.key()));
        found.map_or(TableMeasure::All, TableMeasure::Only)
    }
}

pub(crate) fn table(arguments: &TableArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = TableOptions {
        result: arguments.result.clone(),
        reference: arguments.reference.clone(),
        measure: arguments.measure(),
        risk: arguments.risk.asked(),
    };
    let report = table_of(&options, terminal)?;
    if arguments.json { print_json(&report) } else { print_table(&report) }
}
