//! `uplift check`: everything that can be wrong, and what the study would cost.

use clap::Args;
use uplift::plan;

use crate::command::arguments::{StudyArguments, run_options};
use crate::error::{CommandError, is_stopped};
use crate::show::{print_json, print_plan, print_study};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift check study.toml\n  uplift check study.toml --print-study")]
pub(crate) struct CheckArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Print the study with every default filled in, as TOML
    #[arg(long, conflicts_with = "json")]
    print_study: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What an interruption leaves.
const STOPPED: &str = "a check writes nothing. Run the same command to start again";

pub(crate) fn check(arguments: &CheckArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let study = arguments.study.load_any()?;
    if arguments.print_study {
        return print_study(&study);
    }
    terminal.set_interruption_message(format!("interrupted: {STOPPED}"));
    let StudyArguments { study: file, overrides } = &arguments.study;
    let plan = plan(&study, &run_options(file, overrides, None, false), terminal)
        .map_err(|error| if is_stopped(&error) { CommandError::Interrupted(STOPPED) } else { error.into() })?;
    if arguments.json { print_json(&plan) } else { print_plan(&plan, terminal) }?;
    // as a run does, once what a study costs has been told
    let head = plan.head();
    head.would_replace.clone().map_or(Ok(()), |reason| Err(CommandError::Usage(reason)))?;
    Ok(head.room.refuse(terminal)?)
}
