//! `uplift hazard import`: curve files of a site from what an engine exports.

use std::path::PathBuf;

use clap::Args;
use uplift::hazard_curves::{HazardImportOptions, import as import_curves};
use uplift_hazard::ComponentDefinition;

use super::SiteArguments;
use crate::command::arguments::{ForceArgument, number, require_folder};
use crate::error::CommandError;
use crate::show::print_hazard_import;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct ImportArguments {
    /// Exports: OpenQuake CSV or NRML, USGS JSON; several files for several measures, or for the realizations of a
    /// logic tree
    #[arg(required = true, value_name = "EXPORT")]
    exports: Vec<PathBuf>,
    /// Folder for the curve files; made if it is not there
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    #[command(flatten)]
    site: SiteArguments,
    /// How the ground-motion models combine horizontal components: geometric mean, GMRotI50, RotD50, RotD100, larger,
    /// arbitrary. Exports do not say it
    #[arg(long, value_name = "WORD")]
    component: Option<ComponentDefinition>,
    /// Weights of the realizations (OpenQuake's realizations_*.csv)
    #[arg(long, value_name = "FILE")]
    weights: Option<PathBuf>,
    /// Refuse a site farther from --near than this, km
    #[arg(long, value_name = "KM", default_value_t = 100.0, value_parser = number)]
    within_km: f64,
    #[command(flatten)]
    overwriting: ForceArgument,
}

pub(super) fn import(arguments: &ImportArguments, terminal: &Terminal) -> Result<(), CommandError> {
    require_folder(&arguments.output, "curves")?;
    let options = HazardImportOptions {
        exports: arguments.exports.clone(),
        folder: arguments.output.clone(),
        site: arguments.site.selection(),
        component: arguments.component,
        weights: arguments.weights.clone(),
        within_km: arguments.within_km,
        force: arguments.overwriting.force,
    };
    print_hazard_import(&import_curves(&options, terminal)?)
}
