//! `uplift records import`: from a folder of downloads, or a zip archive, to a manifest.

use std::path::PathBuf;

use clap::Args;
use uplift::import::{ImportOptions, import as import_folder};

use super::FileArguments;
use crate::command::arguments::ForceArgument;
use crate::error::CommandError;
use crate::show::{print_import, tell_remarks};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct ImportArguments {
    /// Folder with record files, in folders of their own if you like; or the zip archive that PEER gives, which is
    /// unpacked into a folder of its name beside the manifest
    #[arg(value_name = "FOLDER|ZIP")]
    folder: PathBuf,
    /// The manifest to write (CSV); a folder gets a manifest.csv
    #[arg(short, long, value_name = "SET")]
    output: PathBuf,
    #[command(flatten)]
    files: FileArguments,
    /// Leave out the search for velocity pulses, which takes most of the time
    #[arg(long)]
    no_pulses: bool,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(super) fn import(arguments: &ImportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = ImportOptions {
        folder: arguments.folder.clone(),
        output: arguments.output.clone(),
        files: arguments.files.options(),
        pulses: !arguments.no_pulses,
        force: arguments.overwriting.force,
    };
    let report = import_folder(&options, terminal)?;
    tell_remarks(&report, terminal);
    if report.manifest.is_none() {
        return Err(CommandError::input(format!(
            "no pair of horizontal components in {}: {} files read, {} components found",
            options.folder.display(),
            report.files,
            report.components
        )));
    }
    print_import(&report, terminal)
}
