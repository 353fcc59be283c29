//! What `uplift design` and `uplift overturning` share: a structure, and the result whose records and hazard it meets.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift_study::Structure;

use crate::error::CommandError;

#[derive(Debug, Args)]
pub(super) struct StructureArguments {
    /// Structure file (TOML), for instance configs/structures/pier.toml
    pub(super) structure: PathBuf,
    /// Result file of `uplift run`: its spectra, and the records and hazard that they were made from
    #[arg(long, value_name = "RESULT")]
    pub(super) urs: PathBuf,
    /// Manifest of the records, where it is no longer where the study says
    #[arg(long, value_name = "CSV")]
    pub(super) manifest: Option<PathBuf>,
}

impl StructureArguments {
    /// Files that are read.
    pub(super) fn inputs(&self) -> Vec<&Path> {
        [&self.structure, &self.urs].into_iter().chain(&self.manifest).map(PathBuf::as_path).collect()
    }

    /// The structure.
    pub(super) fn load(&self) -> Result<Structure, CommandError> {
        Ok(Structure::load(&self.structure)?)
    }
}
