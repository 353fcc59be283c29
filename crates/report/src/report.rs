//! The page of results, written.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use uplift::events::Events;
use uplift::outputs::{self, Output, OutputKind, beside};
use uplift::result::{ResultFile, TargetRisks, is_hdf5, write_atomically};
use uplift::typed::Overwriting;
use uplift::verify::require_whole;
use uplift::{JobError, UpliftError};

use crate::page::page;

/// Which results a page is of.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ReportOptions {
    /// Result files; several are compared
    #[arg(required = true, value_name = "RESULT")]
    pub results: Vec<PathBuf>,
    /// Page to write [default: the first result with .html]
    #[arg(short, long, value_name = "FILE.html")]
    pub output: Option<PathBuf>,
    /// Embed the calculator with this result: web/dist/index.html of `make web`; adds 2 MB, and some 40 kB a record
    #[arg(long, value_name = "PAGE.html")]
    pub explore: Option<PathBuf>,
    /// The risks of the spectra.
    #[command(flatten)]
    pub risk: TargetRisks,
    /// Whether existing files are overwritten.
    #[command(flatten)]
    pub overwriting: Overwriting,
}

/// The page that was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PageReport {
    /// Its file.
    pub file: PathBuf,
}

/// Writes one HTML file with every figure and table of the results, to hand over.
///
/// # Errors
/// A result that is missing, damaged or without sites; a calculator for several results, or from a page that is not
/// its own; a file that cannot be written.
pub fn report(options: &ReportOptions, events: &dyn Events) -> Result<PageReport, UpliftError> {
    let Some(first) = options.results.first() else {
        return Err(JobError::Usage("give at least one result".to_owned()).into());
    };
    if options.explore.is_some() && options.results.len() > 1 {
        return Err(JobError::Usage("--explore takes one result: write a report for each".to_owned()).into());
    }
    let file = options.output.clone().unwrap_or_else(|| beside(first, "html"));
    let output = Output::new(&file, OutputKind::Page).with_result(first);
    let inputs: Vec<PathBuf> = options.results.iter().chain(&options.explore).cloned().collect();
    outputs::check(&[output], &inputs, options.overwriting.force)?;
    // what is no result at all is reported as what it is
    for other in options.results.iter().filter(|path| !is_hdf5(path)) {
        ResultFile::open(other)?;
    }
    // what is handed over says nothing of a file that is not as it was written, even where it would not show
    require_whole(&options.results)?;
    write_atomically(&file, page(options, events)?.as_bytes())?;
    // after the page itself was written again
    for result in &options.results {
        ResultFile::open(result)?.tell_made_of_another(events)?;
    }
    Ok(PageReport { file })
}
