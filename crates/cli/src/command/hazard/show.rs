//! `uplift hazard show`: what a curve file holds.

use std::path::PathBuf;

use clap::Args;
use uplift::hazard_curves::show as show_curves;

use super::{SiteArguments, TableArguments};
use crate::error::CommandError;
use crate::show::print_curves;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(super) struct ShowArguments {
    /// Table with two columns, or an export of OpenQuake (CSV, NRML) or the USGS (JSON); .gz too
    file: PathBuf,
    #[command(flatten)]
    site: SiteArguments,
    #[command(flatten)]
    table: TableArguments,
}

pub(super) fn show(arguments: &ShowArguments, terminal: &Terminal) -> Result<(), CommandError> {
    print_curves(&show_curves(&arguments.file, &arguments.table.options(&arguments.site), terminal)?)
}
