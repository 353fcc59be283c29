//! `uplift sweep`: variants of a study, each an ordinary result, compared.

use std::path::PathBuf;

use clap::{ArgGroup, Args};
use uplift::sweep::{SweepOptions, cases, product, sweep as run, sweep_folder};
use uplift_report::{check_figure_file, plot_sweep};

use crate::command::arguments::{Overwriting, command_line, require_folder};
use crate::error::CommandError;
use crate::show::{print_json, print_sweep};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  uplift sweep configs/quick.toml --over oscillator.restitution=0.85,0.95 --over \
                  'strengths.values=\"0:1/25:1\",\"0:1/50:1\"'",
    group = ArgGroup::new("variants").required(true).args(["over", "cases"])
)]
pub(crate) struct SweepArguments {
    /// Study file, e.g. configs/quick.toml
    study: PathBuf,
    /// Key and its values; every combination is run
    #[arg(long, value_name = "KEY=VALUE,VALUE…")]
    over: Vec<String>,
    /// Table of variants: a column a key, a row a variant, with a column `name` if wanted
    #[arg(long, value_name = "CASES.csv", conflicts_with = "over")]
    cases: Option<PathBuf>,
    /// Set a key for all variants, e.g. records.first=20
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// Folder for the results [default: results/<study>.sweep]
    #[arg(long, short, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwriting: Overwriting,
}

pub(crate) fn sweep(arguments: &SweepArguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(folder) = &arguments.output {
        require_folder(folder, "results")?;
    }
    let options = SweepOptions {
        study_file: arguments.study.clone(),
        overrides: arguments.overrides.clone(),
        variants: match &arguments.cases {
            Some(table) => cases(table)?,
            None => product(&arguments.over)?,
        },
        folder: arguments.output.clone(),
        command: command_line(),
        force: arguments.overwriting.force,
    };
    let figure = sweep_folder(&options)?.join("comparison.svg");
    check_figure_file(&figure, &[&arguments.study], options.force)?;
    let report = run(&options, terminal)?;
    plot_sweep(&report, &figure)?;
    if arguments.json { print_json(&report) } else { print_sweep(&report, terminal) }?;
    for file in report.variants.iter().map(|variant| &variant.result).chain([&report.table, &figure]) {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
