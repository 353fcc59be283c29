//! `uplift status`: how far a run is, and what a result holds.

use std::path::PathBuf;

use clap::Args;
use uplift::status::status as status_of;

use crate::error::CommandError;
use crate::show::print_status;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift status results/study.h5")]
pub(crate) struct StatusArguments {
    /// Result file, study file, or shard
    #[arg(value_name = "RESULT|STUDY|SHARD")]
    input: PathBuf,
}

pub(crate) fn status(arguments: &StatusArguments) -> Result<(), CommandError> {
    print_status(&status_of(&arguments.input)?)
}
