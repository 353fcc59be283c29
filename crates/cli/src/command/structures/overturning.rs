//! `uplift overturning`: how often a structure overturns, by its equivalent oscillator and by the rigid block that
//! rotates as it does.

use std::path::PathBuf;

use clap::Args;
use uplift::structure::{OverturningOptions, overturning as run, overturning_shard};
use uplift_report::{check_figure_file, plot_overturning};

use crate::command::arguments::{Overwriting, StructureArguments};
use crate::error::CommandError;
use crate::show::{print_answer_json, print_overturning, print_shard};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift overturning configs/structures/pier.toml --urs results/study.h5")]
pub(crate) struct OverturningArguments {
    #[command(flatten)]
    structure: StructureArguments,
    #[command(flatten)]
    options: OverturningOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Draw the collapse fragility
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Write the collapse fragility, with the risk in .risk.csv beside it
    #[arg(long, short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: Overwriting,
}

pub(crate) fn overturning(arguments: &OverturningArguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(figure) = &arguments.plot {
        check_figure_file(figure, &arguments.structure.inputs(), arguments.overwriting.force)?;
    }
    let StructureArguments { urs, manifest, shard, shards, .. } = &arguments.structure;
    let is_written = arguments.json || arguments.output.is_some();
    let options = OverturningOptions {
        sensitivity: arguments.structure.asks_for_sensitivity(is_written, terminal),
        manifest: manifest.clone(),
        shards: shards.clone(),
        table: arguments.output.clone(),
        force: arguments.overwriting.force,
        ..arguments.options.clone()
    };
    let structure = arguments.structure.load()?;
    if let Some(shard) = shard {
        return print_shard(&overturning_shard(&structure, urs, &options, *shard, terminal)?, terminal);
    }
    let report = run(&structure, urs, &options, terminal)?;
    if let Some(figure) = &arguments.plot {
        plot_overturning(&report, figure)?;
    }
    arguments.structure.keeping.keep(|| Ok(report.finding(&structure, &options)?), urs, terminal)?;
    if arguments.json { print_answer_json(&report, urs) } else { print_overturning(&report, terminal) }?;
    for file in arguments.plot.iter().chain(&report.files) {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
