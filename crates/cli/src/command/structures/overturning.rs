//! `uplift overturning`: how often a structure overturns, by its equivalent oscillator and by the rigid block that
//! rotates as it does.

use std::path::PathBuf;

use clap::Args;
use uplift::structure::{OverturningOptions, overturning as run, overturning_shard};
use uplift_motion::IntensityMeasure;
use uplift_report::{check_figure_file, plot_overturning};

use crate::command::arguments::{ForceArgument, StructureArguments, number};
use crate::error::CommandError;
use crate::show::{print_json, print_overturning, print_shard};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(
    after_help = "Structures to start from: configs/structures/*.toml. Method and a worked example: docs/design.md"
)]
pub(crate) struct OverturningArguments {
    #[command(flatten)]
    structure: StructureArguments,
    /// Site of the result [default: all]
    #[arg(long)]
    site: Option<String>,
    /// Intensity measure: pgv, pga or any other [default: all of the result]
    #[arg(long)]
    measure: Option<IntensityMeasure>,
    /// One coefficient of restitution for both models, in place of the structure's, the study's (oscillator) and that
    /// of angular momentum (block)
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = number)]
    restitution: Option<f64>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Draw the collapse fragility as SVG or PNG
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Write the collapse fragility to this CSV file, and the risk to one that ends in .risk.csv beside it
    #[arg(long, short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(crate) fn overturning(arguments: &OverturningArguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(figure) = &arguments.plot {
        check_figure_file(figure, &arguments.structure.inputs(), arguments.overwriting.force)?;
    }
    let StructureArguments { urs, manifest, shard, shards, .. } = &arguments.structure;
    let options = OverturningOptions {
        manifest: manifest.clone(),
        site: arguments.site.clone(),
        measure: arguments.measure,
        restitution: arguments.restitution,
        table: arguments.output.clone(),
        shards: shards.clone(),
        force: arguments.overwriting.force,
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
    if arguments.json { print_json(&report) } else { print_overturning(&report, terminal) }?;
    for file in arguments.plot.iter().chain(&report.files) {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
