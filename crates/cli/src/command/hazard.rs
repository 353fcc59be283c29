//! `uplift hazard`: hazard curves, imported from what engines export, and looked at.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

mod import;
mod plot;
mod show;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use uplift_hazard::{
    CsvOptions, Declared, ExportedCurve, ExportedCurves, HazardCurve, HazardError, SecondColumn, SiteSelection,
    Statistic, read_csv, read_export, table_text,
};
use uplift_motion::STANDARD_GRAVITY_M_S2;

use super::Terminal;
use crate::error::CommandError;
use crate::terminal::tell;

#[derive(Debug, Args)]
pub(super) struct HazardArguments {
    #[command(subcommand)]
    command: HazardCommand,
}

#[derive(Debug, Subcommand)]
enum HazardCommand {
    /// Take the curves of a site from an export of OpenQuake or the USGS: curve files, and the lines for a study
    Import(import::ImportArguments),
    /// Show what a curve file or an export holds
    Show(show::ShowArguments),
    /// Draw curves in one figure
    Plot(plot::PlotArguments),
}

pub(super) fn hazard(arguments: &HazardArguments, terminal: &Terminal) -> Result<(), CommandError> {
    match &arguments.command {
        HazardCommand::Import(arguments) => import::import(arguments, terminal),
        HazardCommand::Show(arguments) => show::show(arguments),
        HazardCommand::Plot(arguments) => plot::plot(arguments, terminal),
    }
}

/// Which site of an export with several.
#[derive(Debug, Args)]
struct SiteArguments {
    /// The site of this name in the export
    #[arg(long, value_name = "NAME", conflicts_with = "near")]
    name: Option<String>,
    /// The site nearest to this place, longitude and latitude in degrees, e.g. 23.73,37.98
    #[arg(long, value_name = "LON,LAT", value_parser = place, allow_hyphen_values = true)]
    near: Option<[f64; 2]>,
}

fn place(text: &str) -> Result<[f64; 2], String> {
    let numbers = text.split_once(',').map(|(a, b)| [a, b].map(|number| number.trim().parse::<f64>()));
    match numbers {
        Some([Ok(longitude), Ok(latitude)]) if longitude.abs() <= 360.0 && latitude.abs() <= 90.0 => {
            Ok([longitude, latitude])
        }
        _ => Err("give longitude and latitude in degrees, longitude first, e.g. 23.73,37.98".to_owned()),
    }
}

impl SiteArguments {
    fn selection(&self) -> SiteSelection {
        match (&self.name, self.near) {
            (Some(name), _) => SiteSelection::Name(name.clone()),
            (None, Some([longitude_deg, latitude_deg])) => SiteSelection::Nearest { longitude_deg, latitude_deg },
            (None, None) => SiteSelection::All,
        }
    }
}

/// What a table does not say.
#[derive(Debug, Args)]
struct TableArguments {
    /// Measure of a table that does not name it: PGV, PGA
    #[arg(long, value_name = "NAME")]
    measure: Option<String>,
    /// Unit of the levels of such a table: cm/s, m/s, g, m/s2, cm/s2
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Years that the probabilities of a table refer to
    #[arg(long, value_name = "YEARS")]
    years: Option<f64>,
}

/// A curve with what to call it.
struct NamedCurve {
    name: String,
    curve: HazardCurve,
}

/// The curves of a file: those of an export, or the one of a table with two columns.
fn read(path: &Path, site: &SiteArguments, table: &TableArguments) -> Result<Vec<NamedCurve>, CommandError> {
    let export = match curves_of(path, &site.selection()) {
        Ok(curves) => {
            if let Some(far) = curves.iter().filter_map(|curve| curve.distance_km).reduce(f64::max) {
                tell(&format!("{}: the nearest site is {far:.1} km away", path.display()));
            }
            return Ok(curves.into_iter().map(|exported| named(path, exported)).collect());
        }
        Err(error) => error,
    };
    let fail = |reason: String| CommandError::input(reason);
    let text = table_text(path).map_err(|error| fail(error.to_string()))?;
    // what looks like an export but cannot be read as one is told as such
    let begins = text.trim_start_matches('\u{feff}').trim_start();
    let an_export =
        begins.starts_with(['<', '{', '[']) || begins.lines().next().is_some_and(|line| line.contains("generated_by"));
    if an_export {
        return Err(fail(export.to_string()));
    }
    let declared = match (&table.measure, &table.unit, Declared::in_table(&text)) {
        (Some(measure), Some(unit), _) => Declared { measure: measure.to_uppercase(), unit: unit.clone() },
        (_, _, Some(declared)) => declared,
        _ => {
            return Err(fail(format!(
                "{}: the table does not say its measure and unit: add a first line such as \"# IM: PGV [cm/s]\", or give --measure and --unit",
                path.display()
            )));
        }
    };
    let options =
        CsvOptions { declared, second_column: table.years.map(|_| SecondColumn::Probability), years: table.years };
    let read = read_csv(&text, &path.display().to_string(), &options).map_err(|error| fail(error.to_string()))?;
    let stem = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
    let folder = path.parent().and_then(Path::file_name).map(|folder| format!("{}/", folder.to_string_lossy()));
    Ok(vec![NamedCurve { name: format!("{}{stem}", folder.unwrap_or_default()), curve: in_field_units(&read.curve)? }])
}

/// The curves of an export; of all sites those that have one, the others are told.
fn curves_of(path: &Path, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
    if *selection != SiteSelection::All {
        return read_export(path, selection);
    }
    let mut export = ExportedCurves::open(path)?;
    let (mut curves, mut first, mut without) = (Vec::new(), None, 0);
    while let Some(site) = export.next_site() {
        match site?.curve {
            Ok(curve) => curves.push(curve),
            Err(error) => {
                without += 1;
                first.get_or_insert(error);
            }
        }
    }
    match first {
        Some(error) if curves.is_empty() => Err(error),
        Some(error) => {
            tell(&format!("{without} site(s) without a hazard curve, the first: {error}"));
            Ok(curves)
        }
        None => Ok(curves),
    }
}

fn named(path: &Path, exported: ExportedCurve) -> NamedCurve {
    let place = exported
        .site
        .name
        .clone()
        .unwrap_or_else(|| format!("{}, {}", exported.site.longitude_deg, exported.site.latitude_deg));
    let kind = match exported.kind {
        Statistic::Unspecified => path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
        kind => kind.to_string(),
    };
    NamedCurve { name: format!("{place}, {kind}"), curve: exported.curve }
}

fn in_field_units(curve: &HazardCurve) -> Result<HazardCurve, CommandError> {
    curve.in_field_units(STANDARD_GRAVITY_M_S2).map_err(|error| CommandError::input(error.to_string()))
}

/// The files given, each once.
fn distinct(files: &[PathBuf]) -> Vec<&PathBuf> {
    let mut distinct: Vec<&PathBuf> = Vec::new();
    for file in files {
        if !distinct.contains(&file) {
            distinct.push(file);
        }
    }
    distinct
}
