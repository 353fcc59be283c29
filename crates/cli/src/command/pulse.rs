//! `uplift pulse`: rocking spectra of a rigid block under Ricker wavelets.

use std::path::PathBuf;

use clap::Args;
use uplift::pulses::{PulseOptions, PulsePlan, pulses};
use uplift_report::{FigureOptions, check_pulse_figures, plot_pulses};

use super::arguments::{Overwriting, require_folder};
use crate::error::CommandError;
use crate::show::{print_json, print_pulses};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift pulse --slenderness 0.2 -o results/pulses")]
pub(super) struct PulseArguments {
    /// Folder for figures and tables
    #[arg(short, long, value_name = "FOLDER", default_value = "results/pulses")]
    output: PathBuf,
    #[command(flatten)]
    plan: PulsePlan,
    #[command(flatten)]
    figures: FigureOptions,
    #[command(flatten)]
    overwriting: Overwriting,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn pulse(arguments: &PulseArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let folder = &arguments.output;
    require_folder(folder, "figures and tables")?;
    let (figures, force) = (arguments.figures, arguments.overwriting.force);
    check_pulse_figures(folder, figures, force)?;
    let options = PulseOptions { plan: arguments.plan.clone(), folder: Some(folder.clone()), force };
    let mut report = pulses(&options, terminal)?;
    let figures = plot_pulses(&report, folder, figures)?;
    report.files.splice(..0, figures);
    if arguments.json { print_json(&report) } else { print_pulses(&report, terminal) }
}
