//! `uplift export`: a result for other programs.

use std::path::PathBuf;

use clap::Args;
use uplift::export::{ExportFormat, ExportOptions, export as export_result};

use crate::command::arguments::ForceArgument;
use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(crate) struct ExportArguments {
    /// Result file of `uplift run`
    result: PathBuf,
    /// A tidy table: site, im, poe, years, strength, `u_m`, `fit_m`; one comment line first
    #[arg(long, help = "A tidy table: site, im, poe, years, strength, u_m, fit_m; one comment line first")]
    csv: bool,
    /// One object with the spectra and their coefficients
    #[arg(long)]
    json: bool,
    /// A file that MATLAB and scipy.io load; `u_pgv_m` is strength x probability x site
    #[arg(long, help = "A file that MATLAB and scipy.io load; u_pgv_m is strength x probability x site")]
    mat: bool,
    /// The file, if one format is asked for [default: the result with .spectra.csv, .json or .mat]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: ForceArgument,
}

impl ExportArguments {
    fn formats(&self) -> Vec<ExportFormat> {
        [(self.csv, ExportFormat::Csv), (self.json, ExportFormat::Json), (self.mat, ExportFormat::Matlab)]
            .into_iter()
            .filter_map(|(wanted, format)| wanted.then_some(format))
            .collect()
    }
}

pub(crate) fn export(arguments: &ExportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = ExportOptions {
        result: arguments.result.clone(),
        formats: arguments.formats(),
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    print_files(&export_result(&options, terminal)?.files, terminal)
}
