//! `uplift check`: everything that can be wrong, and what the study would cost.

use clap::Args;
use uplift::plan;

use crate::command::arguments::{StudyArguments, run_options};
use crate::error::CommandError;
use crate::show::{print_json, print_plan};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Print the plan as JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn check(arguments: &CheckArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let study = arguments.study.load_any()?;
    let plan = plan(&study, &run_options(&arguments.study, None, false), terminal)?;
    if arguments.json { print_json(&plan) } else { print_plan(&plan, &study, terminal) }?;
    Ok(plan.head().room.refuse(terminal)?)
}
