//! `uplift hazard`: hazard curves, imported from what engines export, and looked at.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::{Args, Subcommand};
use uplift::hazard_curves::{CurveOptions, HazardImportOptions, import as import_curves, show as show_curves};
use uplift::{JobError, UpliftError};
use uplift_hazard::SiteSelection;
use uplift_report::{HazardPlotOptions, plot_hazard};

use super::arguments::{Overwriting, require_folder};
use crate::error::CommandError;
use crate::show::{print_curves, print_hazard_import};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct HazardArguments {
    #[command(subcommand)]
    command: HazardCommand,
}

#[derive(Debug, Subcommand)]
enum HazardCommand {
    /// Import the curves of a site from OpenQuake or the USGS
    Import(ImportArguments),
    /// Show hazard curves
    Show(ShowArguments),
    /// Draw hazard curves
    Plot(PlotArguments),
}

pub(super) fn hazard(arguments: &HazardArguments, terminal: &Terminal) -> Result<(), CommandError> {
    match &arguments.command {
        HazardCommand::Import(arguments) => import(arguments, terminal),
        HazardCommand::Show(arguments) => show(arguments, terminal),
        HazardCommand::Plot(arguments) => plot(arguments, terminal),
    }
}

/// Which site of an export with several.
#[derive(Debug, Args)]
struct SiteArguments {
    /// Name of the site in the export
    #[arg(long, value_name = "NAME", conflicts_with = "near")]
    name: Option<String>,
    /// Take the nearest site: longitude,latitude in degrees, e.g. 23.73,37.98
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
    /// The curves of this site.
    fn applied_to(&self, curves: &CurveOptions) -> CurveOptions {
        CurveOptions { site: self.selection(), ..curves.clone() }
    }

    fn selection(&self) -> SiteSelection {
        match (&self.name, self.near) {
            (Some(name), _) => SiteSelection::Name(name.clone()),
            (None, Some([longitude_deg, latitude_deg])) => SiteSelection::Nearest { longitude_deg, latitude_deg },
            (None, None) => SiteSelection::All,
        }
    }
}

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  uplift hazard import hazard_curve-mean-PGV_1.csv -o hazard/athens --near 23.73,37.98"
)]
struct ImportArguments {
    #[command(flatten)]
    site: SiteArguments,
    #[command(flatten)]
    options: HazardImportOptions,
    #[command(flatten)]
    overwriting: Overwriting,
}

fn import(arguments: &ImportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let (site, force) = (arguments.site.selection(), arguments.overwriting.force);
    let options = HazardImportOptions { site, force, ..arguments.options.clone() };
    require_folder(&options.folder, "curves")?;
    print_hazard_import(&import_curves(&options, terminal)?)
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift hazard show hazard/athens/*.csv")]
struct ShowArguments {
    /// Curves with two columns, or exports of OpenQuake or the USGS; .gz too
    #[arg(required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    site: SiteArguments,
    #[command(flatten)]
    curves: CurveOptions,
}

fn show(arguments: &ShowArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let report = show_curves(&arguments.files, &arguments.site.applied_to(&arguments.curves), terminal)?;
    print_curves(&report)?;
    if report.mistakes.is_empty() { Ok(()) } else { Err(UpliftError::from(JobError::Inputs(report.mistakes)).into()) }
}

#[derive(Debug, Args)]
#[command(after_help = "Example:\n  uplift hazard plot hazard/*/pgv.csv -o curves.svg")]
struct PlotArguments {
    /// Curves with two columns, or exports of OpenQuake or the USGS
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Figure, .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    site: SiteArguments,
    #[command(flatten)]
    curves: CurveOptions,
    #[command(flatten)]
    overwriting: Overwriting,
}

fn plot(arguments: &PlotArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let options = HazardPlotOptions {
        files: arguments.files.clone(),
        curves: arguments.site.applied_to(&arguments.curves),
        output: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    for file in plot_hazard(&options, terminal)?.files {
        terminal.say(&file.display().to_string());
    }
    Ok(())
}
