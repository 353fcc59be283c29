//! `uplift warnings`: all that is to be known before the numbers of a result are used.

use std::path::PathBuf;

use clap::Args;
use uplift::alarms::alarms;
use uplift::result::{ResultFile, TargetRisks, at_target_risks};

use crate::error::CommandError;
use crate::show::{print_all_warnings, print_answer_json};

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift warnings results/study.h5")]
pub(crate) struct WarningsArguments {
    /// Result file
    result: PathBuf,
    #[command(flatten)]
    risk: TargetRisks,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn warnings(arguments: &WarningsArguments) -> Result<(), CommandError> {
    let found = alarms(&at_target_risks(ResultFile::open(&arguments.result)?, &arguments.risk)?)?;
    if arguments.json {
        print_answer_json(&found, &arguments.result)
    } else {
        print_all_warnings(&found, &arguments.result)
    }
}
