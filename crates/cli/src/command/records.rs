//! `uplift records`: record files, looked at, imported and chosen.

mod synthesize;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use uplift::import::{ImportOptions, import as import_folder};
use uplift::inputs::FileOptions;
use uplift::records::{self, AtLevelOptions, SelectOptions, SetOptions, ShowOptions, at_level as write_at_level};
use uplift_motion::{AccelerationUnit, Combination, IntensityMeasure, RecordFormat, STANDARD_GRAVITY_M_S2};
use uplift_study::{CRITERIA, Criterion, Range, RecordSelection};

use super::arguments::{ForceArgument, number};
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
    Import(ImportArguments),
    /// List the records of a manifest
    List(ListArguments),
    /// Show one record
    Show(ShowArguments),
    /// Select records by their properties
    Select(SelectArguments),
    /// Convert records selected per level into a table
    AtLevel(AtLevelArguments),
    /// Make synthetic records of a scenario
    Synthesize(synthesize::SynthesizeArguments),
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift records list records/mine.csv --magnitude 6:7.5")]
struct ListArguments {
    #[command(flatten)]
    set: SetArguments,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    uplift records show records/mine.csv RSN953\n  \
    uplift records show downloads/RSN953_NORTHR_MUL009.AT2")]
struct ShowArguments {
    /// Manifest or record file
    #[arg(value_name = "SET|FILE")]
    input: PathBuf,
    /// Name of a record in the manifest
    record: Option<String>,
    #[command(flatten)]
    files: FileArguments,
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
        RecordsCommand::Import(arguments) => import(arguments, terminal),
        RecordsCommand::List(arguments) => list(arguments, terminal),
        RecordsCommand::Show(arguments) => show(arguments),
        RecordsCommand::Select(arguments) => select(arguments, terminal),
        RecordsCommand::AtLevel(arguments) => at_level(arguments, terminal),
        RecordsCommand::Synthesize(arguments) => synthesize::synthesize(arguments, terminal),
    }
}

fn list(arguments: &ListArguments, terminal: &Terminal) -> Result<(), CommandError> {
    print_records(&records::list(&arguments.set.options(), terminal)?)
}

fn show(arguments: &ShowArguments) -> Result<(), CommandError> {
    let options = ShowOptions {
        input: arguments.input.clone(),
        record: arguments.record.clone(),
        files: arguments.files.options(),
    };
    print_record(&records::show(&options)?)
}

fn select(arguments: &SelectArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = SelectOptions {
        set: arguments.set.options(),
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    print_selection(&records::select(&options, terminal)?, terminal)
}

/// What the files do not say.
#[derive(Debug, Clone, Copy, Args)]
struct FileArguments {
    /// File format: at2, esm, knet, cosmos, csmip or columns [default: detected]
    #[arg(long, value_name = "FORMAT")]
    format: Option<RecordFormat>,
    /// Unit, if the files name none: g, m/s2, cm/s2 or gal
    #[arg(long, value_name = "UNIT")]
    unit: Option<AccelerationUnit>,
    /// Time step, s, if the files name none
    #[arg(long, value_name = "SECONDS", value_parser = number)]
    dt_s: Option<f64>,
    /// Acceleration of gravity, m/s2
    #[arg(long, value_name = "M_S2", default_value_t = STANDARD_GRAVITY_M_S2, value_parser = number)]
    gravity_m_s2: f64,
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

impl FileArguments {
    fn options(self) -> FileOptions {
        let Self { format, unit, dt_s, gravity_m_s2 } = self;
        FileOptions { format, unit, dt_s, gravity_m_s2 }
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

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift records import downloads/ -o records/mine.csv")]
struct ImportArguments {
    /// Folder with record files, or the zip archive of PEER
    #[arg(value_name = "FOLDER|ZIP")]
    folder: PathBuf,
    /// Manifest to write (CSV), or a folder for it
    #[arg(short, long, value_name = "SET")]
    output: PathBuf,
    #[command(flatten)]
    files: FileArguments,
    /// Skip the search for velocity pulses (faster)
    #[arg(long)]
    no_pulses: bool,
    #[command(flatten)]
    overwriting: ForceArgument,
}

fn import(arguments: &ImportArguments, terminal: &Terminal) -> Result<(), CommandError> {
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

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  uplift records at-level level-*.txt --manifest mine.csv --measure sa_1s -o levels.csv"
)]
struct AtLevelArguments {
    /// Selections, one file a level
    #[arg(
        required = true,
        value_name = "FILE",
        help = "Output of the tool, one file per level: haselREC's ..._summary_selection.txt, CS_Selection's \
                Output_File.dat, EzGM's GMR_H1_names.txt or GMR_names.txt (GMR_sf_used.txt lies beside it), Djura's \
                records_....json"
    )]
    selections: Vec<PathBuf>,
    /// Manifest with the records, from uplift records import
    #[arg(long, value_name = "SET")]
    manifest: PathBuf,
    /// Intensity measure of the selection
    #[arg(
        long,
        value_name = "MEASURE",
        help = "The measure that they were selected for: pgv, pga, sa_1s (SA at 0.5 s is sa_0p5s), ..."
    )]
    measure: IntensityMeasure,
    /// Level of each file, cm/s or g (haselREC and Djura name it)
    #[arg(long = "level", value_name = "LEVEL,...", value_delimiter = ',', value_parser = number)]
    levels: Vec<f64>,
    /// Count each component as a record (for component = "both")
    #[arg(long)]
    both: bool,
    /// Table to write (CSV)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    overwriting: ForceArgument,
}

fn at_level(arguments: &AtLevelArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = AtLevelOptions {
        selections: arguments.selections.clone(),
        manifest: arguments.manifest.clone(),
        measure: arguments.measure,
        levels: arguments.levels.clone(),
        both: arguments.both,
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    print_at_level(&write_at_level(&options)?, terminal)
}
