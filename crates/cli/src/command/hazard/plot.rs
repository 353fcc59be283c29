//! `uplift hazard plot`: curves in one figure.

use std::path::PathBuf;

use clap::Args;
use uplift_report::{HazardPlotOptions, plot_hazard};

use super::{SiteArguments, TableArguments};
use crate::command::arguments::ForceArgument;
use crate::error::CommandError;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct PlotArguments {
    /// Tables with two columns, or exports of OpenQuake or the USGS
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// The figure, .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    site: SiteArguments,
    #[command(flatten)]
    table: TableArguments,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(super) fn plot(arguments: &PlotArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = HazardPlotOptions {
        files: arguments.files.clone(),
        curves: arguments.table.options(&arguments.site),
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    for file in plot_hazard(&options, terminal)?.files {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
