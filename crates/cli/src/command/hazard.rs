//! `uplift hazard`: hazard curves, imported from what engines export, and looked at.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

mod import;
mod plot;
mod show;

use clap::{Args, Subcommand};
use uplift::hazard_curves::CurveOptions;
use uplift_hazard::SiteSelection;

use super::arguments::number;
use crate::error::CommandError;
use crate::terminal::Terminal;

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
        HazardCommand::Show(arguments) => show::show(arguments, terminal),
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
    #[arg(long, value_name = "YEARS", value_parser = number)]
    years: Option<f64>,
}

impl TableArguments {
    /// What is read of files of which `site` is taken.
    fn options(&self, site: &SiteArguments) -> CurveOptions {
        CurveOptions {
            site: site.selection(),
            measure: self.measure.clone(),
            unit: self.unit.clone(),
            years: self.years,
        }
    }
}
