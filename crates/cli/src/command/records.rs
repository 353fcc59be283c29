//! `uplift records`: record files, looked at, imported and chosen.

mod synthesize;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use uplift::import::{ImportOptions, import as import_folder};
use uplift::records::{self, AtLevelOptions, SelectOptions, SetOptions, ShowOptions, at_level as write_at_level};
use uplift_motion::Combination;
use uplift_study::{CRITERIA, Criterion, Range, RecordSelection};

use super::arguments::ForceArgument;
use crate::error::CommandError;
use crate::show::{print_at_level, print_import, print_record, print_records, print_selection, tell_remarks};
use crate::terminal::Terminal;

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
    List(SetArguments),
    /// Show one record
    #[command(after_help = "Examples:\n  \
        uplift records show records/mine.csv RSN953\n  \
        uplift records show downloads/RSN953_NORTHR_MUL009.AT2")]
    Show(ShowOptions),
    /// Select records by their properties
    Select(SelectArguments),
    /// Convert records selected per level into a table
    #[command(
        after_help = "Example:\n  uplift records at-level level-*.txt --manifest mine.csv --measure sa_1s -o levels.csv"
    )]
    AtLevel(AtLevelOptions),
    /// Make synthetic records of a scenario
    Synthesize(synthesize::SynthesizeArguments),
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift records select records/mine.csv --pga-g 0.14: -o records/strong.csv")]
struct SelectArguments {
    #[command(flatten)]
    set: SetArguments,
    /// Write a manifest of the selected records
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(super) fn records(arguments: &RecordsArguments, terminal: &Terminal) -> Result<(), CommandError> {
    match &arguments.command {
        RecordsCommand::Import(options) => import(options, terminal),
        RecordsCommand::List(set) => print_records(&records::list(&set.options(), terminal)?),
        RecordsCommand::Show(options) => print_record(&records::show(options)?),
        RecordsCommand::Select(arguments) => select(arguments, terminal),
        RecordsCommand::AtLevel(options) => print_at_level(&write_at_level(options)?, terminal),
        RecordsCommand::Synthesize(arguments) => synthesize::synthesize(arguments, terminal),
    }
}

fn select(arguments: &SelectArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = SelectOptions {
        set: arguments.set.options(),
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    print_selection(&records::select(&options, terminal)?, terminal)
}

/// A manifest, and which of its records.
#[derive(Debug, Args)]
struct SetArguments {
    /// Manifest, from uplift records import
    #[arg(value_name = "SET")]
    set: PathBuf,
    /// Only records with this tag
    #[arg(long, value_name = "WORD", help = "Only rows whose set_tags contain this word")]
    tag: Option<String>,
    /// Combination of two components: geometric-mean, rotd50 or rotd100
    #[arg(long, value_name = "WORD", default_value_t = Combination::GeometricMean)]
    intensity: Combination,
    #[command(flatten)]
    criteria: CriteriaArguments,
}

/// Ranges such as 6.5:7.5, 6.5: or :7.5.
#[derive(Debug, Args)]
#[command(next_help_heading = "Which records (ranges such as 6.5:7.5, 6.5: or :7.5)")]
struct CriteriaArguments {
    /// Magnitude
    #[arg(long, value_name = "RANGE", value_parser = range)]
    magnitude: Option<Range>,
    /// Closest distance to the rupture, km
    #[arg(long, value_name = "RANGE", value_parser = range)]
    rrup_km: Option<Range>,
    /// Distance to the epicentre, km
    #[arg(long, value_name = "RANGE", value_parser = range)]
    repi_km: Option<Range>,
    /// Mean shear-wave velocity of the upper 30 m, m/s
    #[arg(long, value_name = "RANGE", value_parser = range)]
    vs30: Option<Range>,
    /// Lowest usable frequency, Hz
    #[arg(long, value_name = "RANGE", value_parser = range)]
    lowest_usable_hz: Option<Range>,
    /// PGA of the pair, g
    #[arg(long, value_name = "RANGE", value_parser = range)]
    pga_g: Option<Range>,
    /// PGV of the pair, cm/s
    #[arg(long, value_name = "RANGE", value_parser = range)]
    pgv_cm_s: Option<Range>,
    /// Significant duration D5-75, s
    #[arg(long = "d5-75-s", value_name = "RANGE", value_parser = range)]
    d5_75_s: Option<Range>,
    /// Significant duration D5-95, s
    #[arg(long = "d5-95-s", value_name = "RANGE", value_parser = range)]
    d5_95_s: Option<Range>,
    /// Velocity pulse (Shahi and Baker 2014): true or false
    #[arg(long, value_name = "BOOL")]
    pulse_like: Option<bool>,
}

fn range(text: &str) -> Result<Range, String> {
    Range::parse(text).ok_or_else(|| format!("write {}, the smaller number first", Range::ACCEPTED))
}

impl CriteriaArguments {
    fn selection(&self) -> RecordSelection {
        let given = [
            ("magnitude", self.magnitude),
            ("rrup_km", self.rrup_km),
            ("repi_km", self.repi_km),
            ("vs30", self.vs30),
            ("lowest_usable_hz", self.lowest_usable_hz),
            ("pga_g", self.pga_g),
            ("pgv_cm_s", self.pgv_cm_s),
            ("d5_75_s", self.d5_75_s),
            ("d5_95_s", self.d5_95_s),
        ];
        let of = |criterion: Criterion| {
            let range = given.iter().find(|(key, _)| *key == criterion.key)?.1?;
            Some((criterion, range))
        };
        RecordSelection { ranges: CRITERIA.into_iter().filter_map(of).collect(), pulse_like: self.pulse_like }
    }
}

impl SetArguments {
    fn options(&self) -> SetOptions {
        SetOptions {
            manifest: self.set.clone(),
            tag: self.tag.clone(),
            intensity: self.intensity,
            selection: self.criteria.selection(),
        }
    }
}

fn import(options: &ImportOptions, terminal: &Terminal) -> Result<(), CommandError> {
    let report = import_folder(options, terminal)?;
    if report.manifest.is_none() {
        tell_remarks(&report, terminal);
        return Err(CommandError::input(format!(
            "no pair of horizontal components in {}: {} files read, {} components found",
            options.folder.display(),
            report.files,
            report.components
        )));
    }
    print_import(&report, terminal)?;
    tell_remarks(&report, terminal);
    Ok(())
}
