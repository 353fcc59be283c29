//! `uplift export`: a result for other programs.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::Terminal;
use crate::error::CommandError;
use crate::show::shown_path;
use uplift::export::Export;
use uplift::outputs::refuse_foreign;
use uplift::result::{write_aside, write_table};

#[derive(Debug, Args)]
pub(super) struct ExportArguments {
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
}

pub(super) fn export(arguments: &ExportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let formats: Vec<&str> = [(arguments.csv, "spectra.csv"), (arguments.json, "json"), (arguments.mat, "mat")]
        .into_iter()
        .filter_map(|(wanted, extension)| wanted.then_some(extension))
        .collect();
    if formats.is_empty() || (arguments.output.is_some() && formats.len() > 1) {
        return Err(CommandError::Usage("say --csv, --json or --mat; -o goes with one of them".to_owned()));
    }
    let export = Export::read(&arguments.result)?;
    for format in formats {
        let path = arguments.output.clone().unwrap_or_else(|| arguments.result.with_extension(format));
        if path == arguments.result {
            return Err(CommandError::Usage(format!("-o {}: this is the result itself", path.display())));
        }
        if arguments.output.is_some() && format != "mat" {
            refuse_foreign(&path)?;
        }
        match format {
            "json" => write_aside(&path, format!("{:#}\n", export.json()).as_bytes())?,
            "mat" => write_aside(&path, &export.matlab()?)?,
            _ => write_table(&path, export.provenance(), export.columns())?,
        }
        if !terminal.is_quiet() {
            writeln!(std::io::stdout(), "{}", shown_path(&path).display())?;
        }
    }
    Ok(())
}
