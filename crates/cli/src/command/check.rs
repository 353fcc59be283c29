//! `uplift check`: everything that can be wrong, and what the study would cost.

use crate::error::CommandError;
use clap::Args;
use uplift::plan;

use super::StudyArguments;
use crate::show::{print_json, print_plan};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Print the plan as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn check(arguments: &CheckArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let study = arguments.study.load_any()?;
    let plan = plan(&study, &arguments.study.study, terminal)?;
    if arguments.json { print_json(&plan) } else { print_plan(&plan, &study, terminal) }
}
