//! `uplift verify`: whether a result is as it was written.

use std::path::PathBuf;

use clap::Args;
use uplift::JobError;
use uplift::verify::verify as verify_results;

use crate::error::CommandError;
use crate::show::print_verified;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift verify results/*.h5")]
pub(crate) struct VerifyArguments {
    /// Result files
    #[arg(required = true, value_name = "RESULT")]
    results: Vec<PathBuf>,
}

pub(crate) fn verify(arguments: &VerifyArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let report = verify_results(&arguments.results, terminal)?;
    print_verified(&report, terminal)?;
    let mistakes = report.mistakes();
    if mistakes.is_empty() { Ok(()) } else { Err(JobError::Inputs(mistakes).into()) }
}
