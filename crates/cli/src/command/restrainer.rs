//! `uplift restrainer`: tendons and disc springs, looked at and chosen.

mod design;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use uplift::restrainer::{RestrainerCurveOptions, curve as compute};
use uplift::study::RestrainerFile;
use uplift_report::{check_figure_file, plot_restrainer};

use super::arguments::Overwriting;
use crate::error::CommandError;
use crate::show::{print_json, print_restrainer_curve};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct RestrainerArguments {
    #[command(subcommand)]
    command: RestrainerCommand,
}

#[derive(Debug, Subcommand)]
enum RestrainerCommand {
    /// Compute the force of a restrainer over its elongation
    Curve(CurveArguments),
    /// Choose disc springs from a catalogue
    Design(Box<design::DesignArguments>),
}

pub(super) fn restrainer(arguments: &RestrainerArguments, terminal: &Terminal) -> Result<(), CommandError> {
    match &arguments.command {
        RestrainerCommand::Curve(arguments) => curve(arguments, terminal),
        RestrainerCommand::Design(arguments) => design::design(arguments, terminal),
    }
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift restrainer curve configs/structures/column-dr.toml --plot curve.svg")]
struct CurveArguments {
    /// File with the table [restrainer]
    restrainer: PathBuf,
    #[command(flatten)]
    options: RestrainerCurveOptions,
    /// Draw springs and restrainer
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwriting: Overwriting,
}

fn curve(arguments: &CurveArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let force = arguments.overwriting.force;
    if let Some(figure) = &arguments.plot {
        check_figure_file(figure, &[&arguments.restrainer], force)?;
    }
    let options = RestrainerCurveOptions { force, ..arguments.options.clone() };
    let mut report = compute(&RestrainerFile::load(&arguments.restrainer)?, &options, terminal)?;
    if let Some(figure) = &arguments.plot {
        plot_restrainer(&report, figure)?;
        report.files.push(figure.clone());
    }
    if arguments.json { print_json(&report) } else { print_restrainer_curve(&report, terminal) }
}
