//! `uplift export`: a result for other programs.

use std::path::PathBuf;

use clap::Args;
use uplift::export::{ExportFormat, ExportOptions, export as export_result};

use crate::command::arguments::{ForceArgument, RiskArguments};
use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "a switch for each format")]
#[command(after_help = "Examples:\n  \
    uplift export results/study.h5 --csv --mat\n  \
    uplift export results/study.h5 --xlsx -o spectra.xlsx --return-period 475,2475")]
pub(crate) struct ExportArguments {
    /// Result file
    result: PathBuf,
    /// CSV table, one row an ordinate, with fit, flag and bands
    #[arg(long)]
    csv: bool,
    /// JSON with spectra, bands, coefficients and warnings
    #[arg(long)]
    json: bool,
    /// MATLAB file
    #[arg(long)]
    mat: bool,
    /// Excel workbook with spectra, bands, coefficients and hazard
    #[arg(long)]
    xlsx: bool,
    /// Output file, for one format [default: beside the result]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    risk: RiskArguments,
    #[command(flatten)]
    overwriting: ForceArgument,
}

impl ExportArguments {
    fn formats(&self) -> Vec<ExportFormat> {
        let wanted = [
            (self.csv, ExportFormat::Csv),
            (self.json, ExportFormat::Json),
            (self.mat, ExportFormat::Matlab),
            (self.xlsx, ExportFormat::Workbook),
        ];
        wanted.into_iter().filter_map(|(wanted, format)| wanted.then_some(format)).collect()
    }
}

pub(crate) fn export(arguments: &ExportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = ExportOptions {
        result: arguments.result.clone(),
        formats: arguments.formats(),
        output: arguments.output.clone(),
        risk: arguments.risk.asked(),
        force: arguments.overwriting.force,
    };
    print_files(&export_result(&options, terminal)?.files, terminal)
}
