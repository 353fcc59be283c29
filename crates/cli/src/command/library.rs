//! `uplift library`: how blocks and oscillators respond to a record set, over normalised intensities.

use std::path::PathBuf;

use clap::Args;
use uplift::library::{LibraryOptions, library as compute};
use uplift_report::{FigureOptions, check_library_figures, plot_library};
use uplift_study::LibraryStudy;

use super::arguments::{Overwriting, require_folder};
use crate::error::CommandError;
use crate::show::{print_json, print_library};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift library configs/rocking-library.toml -o results/library\n\n\
                  Keys and tables: docs/rocking-library.md")]
pub(super) struct LibraryArguments {
    /// Library file; - reads standard input
    library: PathBuf,
    /// Set a key of the file, e.g. records.first=20
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// Folder for tables, figures and fragilities
    #[arg(short, long, value_name = "FOLDER", default_value = "results/library")]
    output: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overwriting: Overwriting,
}

pub(super) fn library(arguments: &LibraryArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let (folder, force, figures) = (&arguments.output, arguments.overwriting.force, FigureOptions::default());
    require_folder(folder, "tables")?;
    let study = LibraryStudy::load(&arguments.library, &arguments.overrides)?;
    check_library_figures(folder, figures, force)?;
    let mut report = compute(&study, &LibraryOptions { folder: Some(folder.clone()), force }, terminal)?;
    report.files.extend(plot_library(&report, folder, figures)?);
    if arguments.json { print_json(&report) } else { print_library(&report, terminal) }
}
