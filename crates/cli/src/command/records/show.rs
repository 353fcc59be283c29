//! `uplift records show`: one record, or what a file holds.

use std::path::PathBuf;

use clap::Args;
use uplift::records::{ShowOptions, show as show_record};

use super::FileArguments;
use crate::error::CommandError;
use crate::show::print_record;

#[derive(Debug, Args)]
pub(super) struct ShowArguments {
    /// Manifest of a record set, or a record file
    #[arg(value_name = "SET|FILE")]
    input: PathBuf,
    /// Name of a record of the manifest
    record: Option<String>,
    #[command(flatten)]
    files: FileArguments,
}

pub(super) fn show(arguments: &ShowArguments) -> Result<(), CommandError> {
    let options = ShowOptions {
        input: arguments.input.clone(),
        record: arguments.record.clone(),
        files: arguments.files.options(),
    };
    print_record(&show_record(&options)?)
}
