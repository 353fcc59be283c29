//! `uplift records`: record files, looked at, imported, chosen and made.

use std::io::Write;

use clap::{Args, Subcommand};
use uplift::import::{ImportOptions, import as import_folder};
use uplift::records::{
    self, AtLevelOptions, SelectOptions, SetOptions, ShowOptions, SynthesizeOptions, at_level as write_at_level,
};

use uplift::text::counted;

use crate::error::CommandError;
use crate::show::{print_at_level, print_import, print_record, print_records, print_selection, tell_remarks};
use crate::terminal::{Terminal, output};

/// What `--force` does to a set of synthetic records.
const SET_IS_REPLACED: &str = "Overwrite existing outputs (never an input) and remove the records of a replaced set";

#[derive(Debug, Args)]
pub(super) struct RecordsArguments {
    #[command(subcommand)]
    command: RecordsCommand,
}

#[derive(Debug, Subcommand)]
enum RecordsCommand {
    /// Import a folder of records into a manifest
    #[command(after_help = "Example:\n  uplift records import downloads/ -o records/mine.csv")]
    Import(ImportOptions),
    /// List the records of a manifest
    #[command(after_help = "Example:\n  uplift records list records/mine.csv --magnitude 6:7.5")]
    List(SetOptions),
    /// Show one record
    #[command(after_help = "Examples:\n  \
        uplift records show records/mine.csv RSN953\n  \
        uplift records show downloads/RSN953_NORTHR_MUL009.AT2")]
    Show(ShowOptions),
    /// Select records by their properties
    #[command(after_help = "Example:\n  uplift records select records/mine.csv --pga-g 0.14: -o records/strong.csv")]
    Select(SelectOptions),
    /// Convert records selected per level into a table
    #[command(
        after_help = "Example:\n  uplift records at-level level-*.txt --manifest mine.csv --measure sa_1s -o levels.csv"
    )]
    AtLevel(AtLevelOptions),
    /// Make synthetic records of a scenario
    #[command(
        mut_arg("force", |force| force.help(SET_IS_REPLACED)),
        after_help = "Example:\n  uplift records synthesize -o records/synthetic --count 40 --magnitude 6.5:7"
    )]
    Synthesize(SynthesizeOptions),
}

pub(super) fn records(arguments: &RecordsArguments, terminal: &Terminal) -> Result<(), CommandError> {
    match &arguments.command {
        RecordsCommand::Import(options) => import(options, terminal),
        RecordsCommand::List(options) => print_records(&records::list(options, terminal)?),
        RecordsCommand::Show(options) => print_record(&records::show(options)?),
        RecordsCommand::Select(options) => print_selection(&records::select(options, terminal)?, terminal),
        RecordsCommand::AtLevel(options) => print_at_level(&write_at_level(options)?, terminal),
        RecordsCommand::Synthesize(options) => synthesize(options, terminal),
    }
}

fn import(options: &ImportOptions, terminal: &Terminal) -> Result<(), CommandError> {
    let report = import_folder(options, terminal)?;
    if report.manifest.is_none() {
        tell_remarks(&report, terminal);
        return Err(CommandError::input(format!(
            "no pair of horizontal components in {}: {} in {}",
            options.folder.display(),
            counted(report.components, "component"),
            counted(report.files, "file")
        )));
    }
    print_import(&report, terminal)
}

fn synthesize(options: &SynthesizeOptions, terminal: &Terminal) -> Result<(), CommandError> {
    let report = records::synthesize(options, terminal)?;
    if !terminal.is_quiet() {
        writeln!(output(), "{}: {}", counted(report.pairs, "synthetic pair"), report.manifest.display())?;
    }
    Ok(())
}
