//! `uplift report`: one page to hand over.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::Terminal;
use crate::show::shown_path;
use uplift::UpliftError;
use uplift_report::report as page;

#[derive(Debug, Args)]
pub(super) struct ReportArguments {
    /// Result files of `uplift run`; several stand side by side
    #[arg(required = true, value_name = "RESULT")]
    results: Vec<PathBuf>,
    /// The page [default: the first result with .html]
    #[arg(short, long, value_name = "FILE.html")]
    output: Option<PathBuf>,
}

pub(super) fn report(arguments: &ReportArguments, session: &Terminal) -> Result<(), UpliftError> {
    let target = arguments.output.clone().unwrap_or_else(|| arguments.results[0].with_extension("html"));
    if arguments.results.contains(&target) || target.extension().is_none_or(|extension| extension != "html") {
        return Err(UpliftError::Usage(format!(
            "-o {}: the report is an HTML file, give it a name that ends in .html",
            target.display()
        )));
    }
    let html = page(&arguments.results)?;
    uplift::result::write_atomically(&target, html.as_bytes())?;
    if !session.is_quiet() {
        writeln!(std::io::stdout(), "{}", shown_path(&target).display())?;
    }
    Ok(())
}
