//! `uplift records select`: which records a study takes, and a manifest of them.

use std::path::PathBuf;

use clap::Args;
use uplift::records::{SelectOptions, select as select_records};

use super::SetArguments;
use crate::command::arguments::ForceArgument;
use crate::error::CommandError;
use crate::show::print_selection;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct SelectArguments {
    #[command(flatten)]
    set: SetArguments,
    /// Write a manifest of the chosen records
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(super) fn select(arguments: &SelectArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = SelectOptions {
        set: arguments.set.options(),
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    print_selection(&select_records(&options, terminal)?, terminal)
}
