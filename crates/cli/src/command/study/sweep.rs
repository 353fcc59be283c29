//! `uplift sweep`: variants of a study, each an ordinary result, compared.

use clap::Args;
use uplift::sweep::{SweepOptions, sweep as run, sweep_folder};
use uplift_report::{check_figure_file, plot_sweep};

use crate::command::arguments::{Overwriting, command_line, require_folder};
use crate::error::CommandError;
use crate::show::{print_json, print_sweep};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift sweep configs/quick.toml --over oscillator.restitution=0.85,0.95 --over \
                  'strengths.values=\"0:1/25:1\",\"0:1/50:1\"'")]
pub(crate) struct SweepArguments {
    #[command(flatten)]
    options: SweepOptions,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwriting: Overwriting,
}

pub(crate) fn sweep(arguments: &SweepArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let force = arguments.overwriting.force;
    let options = SweepOptions { command: command_line(), force, ..arguments.options.clone() };
    if let Some(folder) = &options.folder {
        require_folder(folder, "results")?;
    }
    let figure = sweep_folder(&options)?.join("comparison.svg");
    check_figure_file(&figure, &[&options.study_file], force)?;
    let report = run(&options, terminal)?;
    plot_sweep(&report, &figure)?;
    if arguments.json { print_json(&report) } else { print_sweep(&report, terminal) }?;
    for file in report.variants.iter().map(|variant| &variant.result).chain([&report.table, &figure]) {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
