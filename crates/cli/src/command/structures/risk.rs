//! `uplift risk`: the risk of a frame itself, beside what its proxies say.

use std::path::PathBuf;

use clap::Args;
use uplift::structure::{FrameRiskOptions, frame_risk as run, frame_risk_shard};
use uplift_report::{check_figure_file, plot_frame_risk};

use crate::command::arguments::{Overwriting, StructureArguments};
use crate::error::CommandError;
use crate::show::{print_answer_json, print_frame_risk, print_shard};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift risk configs/structures/frame.toml --urs results/study.h5")]
pub(crate) struct FrameRiskArguments {
    #[command(flatten)]
    structure: StructureArguments,
    #[command(flatten)]
    options: FrameRiskOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Draw risk curves and collapse fragility
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Write the peak of every run, with those of each level in .levels.csv beside it
    #[arg(long, short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: Overwriting,
}

pub(crate) fn risk(arguments: &FrameRiskArguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(figure) = &arguments.plot {
        check_figure_file(figure, &arguments.structure.inputs(), arguments.overwriting.force)?;
    }
    let StructureArguments { urs, manifest, shard, shards, .. } = &arguments.structure;
    let options = FrameRiskOptions {
        manifest: manifest.clone(),
        shards: shards.clone(),
        table: arguments.output.clone(),
        force: arguments.overwriting.force,
        ..arguments.options.clone()
    };
    let structure = arguments.structure.load()?;
    if let Some(shard) = shard {
        return print_shard(&frame_risk_shard(&structure, urs, &options, *shard, terminal)?, terminal);
    }
    let report = run(&structure, urs, &options, terminal)?;
    if let Some(figure) = &arguments.plot {
        plot_frame_risk(&report, figure)?;
    }
    arguments.structure.keeping.keep(|| Ok(report.finding(&structure)?), urs, terminal)?;
    if arguments.json { print_answer_json(&report, urs) } else { print_frame_risk(&report, terminal) }?;
    for file in arguments.plot.iter().chain(&report.files) {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
