//! `uplift plot`: the figures of a result, or of a structure's columns, as files.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift::outputs::beside;
use uplift::pushover::{PushoverOptions, pushover};
use uplift::study::Structure;
use uplift_report::{FigureOptions, PlotOptions, plot as plot_result, plot_columns};

use crate::command::arguments::{Numbers, ResultArguments, all_numbers, numbers, require_folder};
use crate::error::CommandError;
use crate::show::print_files;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  uplift plot results/study.h5 --only urs\n  uplift plot configs/structures/column-j.toml"
)]
pub(crate) struct PlotArguments {
    #[command(flatten)]
    result: ResultArguments,
    /// Folder for the figures [default: beside the result]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// Draw only figures whose name contains this, e.g. urs
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Strengths on maps of many sites [default: about 0.1, 0.2 and 0.4]
    #[arg(long, value_name = "STRENGTH[,…]", allow_negative_numbers = true, value_parser = numbers)]
    strength: Vec<Numbers>,
    #[command(flatten)]
    figures: FigureOptions,
}

pub(crate) fn plot(arguments: &PlotArguments, terminal: &Terminal) -> Result<(), CommandError> {
    if let Some(folder) = &arguments.output {
        require_folder(folder, "figures")?;
    }
    if let Some(file) = arguments.result.structure() {
        return plot_structure(file, arguments, terminal);
    }
    let options = PlotOptions {
        result: arguments.result.find(terminal)?.path,
        folder: arguments.output.clone(),
        only: arguments.only.clone(),
        strengths: all_numbers(&arguments.strength),
        figures: arguments.figures,
        force: arguments.result.force(),
    };
    print_files(&plot_result(&options, terminal)?.files, terminal)
}

/// The figures of a structure's columns, into `results` where no folder is named: its own place may be read-only.
fn plot_structure(file: &Path, arguments: &PlotArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let structure = Structure::load(file)?;
    let named_after = || beside(&Path::new("results").join(structure.name()).with_extension("h5"), "figures");
    let folder = arguments.output.clone().unwrap_or_else(named_after);
    let options = PushoverOptions { linear: true, ..PushoverOptions::default() };
    let report = pushover(&structure, &options, terminal)?;
    let (only, figures) = (arguments.only.as_deref(), arguments.figures);
    let files = plot_columns(&structure, &report, &folder, only, figures, arguments.result.force())?;
    print_files(&files, terminal)
}
