//! `uplift plot`: the figures of a result as files.

use std::path::PathBuf;

use clap::Args;
use uplift_report::{PlotOptions, plot as plot_result};

use crate::command::arguments::{FigureArguments, ResultArguments, require_folder};
use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(crate) struct PlotArguments {
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

pub(crate) fn plot(arguments: &PlotArguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(folder) = &arguments.output {
        require_folder(folder, "figures")?;
    }
    let options = PlotOptions {
        result: arguments.result.find(terminal)?.path,
        folder: arguments.output.clone(),
        only: arguments.only.clone(),
        figures: arguments.figures.options(),
        force: arguments.result.force(),
    };
    print_files(&plot_result(&options, terminal)?.files, terminal)
}
