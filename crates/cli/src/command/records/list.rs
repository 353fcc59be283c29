//! `uplift records list`: the records of a manifest.

use clap::Args;
use uplift::records::list as list_records;

use super::SetArguments;
use crate::error::CommandError;
use crate::show::print_records;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct ListArguments {
    #[command(flatten)]
    set: SetArguments,
}

pub(super) fn list(arguments: &ListArguments, terminal: &Terminal) -> Result<(), CommandError> {
    print_records(&list_records(&arguments.set.options(), terminal)?)
}
