//! `uplift plot`: the figures of a result as files.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::Terminal;
use super::figure_files::{FigureArguments, provide_folder};
use super::result_of::ResultArguments;
use crate::error::CommandError;
use crate::show::shown_path;
use uplift_report::figures::result_figures;

#[derive(Debug, Args)]
pub(super) struct PlotArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Folder for the figures [default: beside the result, named after it]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Only figures whose name contains this, for instance urs
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    #[command(flatten)]
    figures: FigureArguments,
}

pub(super) fn plot(arguments: &PlotArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let path = arguments.result.find(terminal)?.path;
    let figures = result_figures(&path)?;
    let wanted = arguments.only.as_deref().unwrap_or_default();
    let chosen: Vec<_> = figures.iter().filter(|figure| figure.id.contains(wanted)).collect();
    if chosen.is_empty() {
        let names: Vec<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
        return Err(CommandError::Usage(format!("--only {wanted}: the result has the figures {}", names.join(", "))));
    }
    let folder = arguments.output.clone().unwrap_or_else(|| path.with_extension("figures"));
    provide_folder(&folder)?;
    let mut out = std::io::stdout().lock();
    for figure in chosen {
        for file in arguments.figures.write(figure, &folder)? {
            if !terminal.is_quiet() {
                writeln!(out, "{}", shown_path(&file).display())?;
            }
        }
    }
    Ok(())
}
