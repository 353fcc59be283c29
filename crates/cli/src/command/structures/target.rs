//! `uplift target`: the least strength, size, width, capacity or tendon stiffness for a target risk.

use std::path::PathBuf;

use clap::Args;
use uplift::structure::{TargetOptions, target as run};
use uplift_study::Structure;

use crate::command::arguments::KeepArgument;
use crate::error::CommandError;
use crate::show::{print_answer_json, print_target};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift target configs/structures/pier.toml --urs results/study.h5 \
                        --vary width --overturning 2e-4")]
pub(crate) struct TargetArguments {
    /// Structure file, e.g. configs/structures/frame.toml
    structure: PathBuf,
    /// Result file with the records and hazard
    #[arg(long, value_name = "RESULT")]
    urs: PathBuf,
    #[command(flatten)]
    options: TargetOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    keeping: KeepArgument,
}

pub(crate) fn target(arguments: &TargetArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let TargetArguments { urs, options, .. } = arguments;
    let structure = Structure::load(&arguments.structure)?;
    let report = run(&structure, urs, options, terminal)?;
    arguments.keeping.keep(|| Ok(report.finding(&structure, options)?), urs, terminal)?;
    if arguments.json { print_answer_json(&report, urs) } else { print_target(&report, terminal) }?;
    for file in &report.files {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
