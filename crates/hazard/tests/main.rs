//! Hazard curves, and the readers of tables and exports.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod csv;
mod curve;
mod import_nrml;
mod import_openquake;
mod import_properties;
mod import_real_files;
mod import_usgs;
mod project_curves;
mod properties;
