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
pub(crate) struct ExportArguments {
    /// Result file of `uplift run`
    result: PathBuf,
    /// A tidy table, a row each ordinate, with fit, flag and bands
    #[arg(
        long,
        help = "A tidy table, a row each ordinate: site, im, poe, years, strength, u_m, fit_m, return_period_years, \
                flag, bands"
    )]
    csv: bool,
    /// One object with the spectra, bands, coefficients and warnings
    #[arg(long)]
    json: bool,
    /// A file that MATLAB and scipy.io load; `u_pgv_m` is strength x probability x site
    #[arg(long, help = "A file that MATLAB and scipy.io load; u_pgv_m is strength x probability x site")]
    mat: bool,
    /// A workbook of Excel: spectra, bands, coefficients, hazard, and where they come from
    #[arg(long)]
    xlsx: bool,
    /// The file, if one format is asked for [default: the result with .spectra.csv, .json, .mat or
    /// .xlsx]
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
