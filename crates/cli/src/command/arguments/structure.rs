//! What `uplift design`, `uplift overturning` and `uplift risk` share: a structure, and the result whose records and
//! hazard it meets.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift::result::Finding;
use uplift::structure::keep;
use uplift_ida::Shard;
use uplift_study::Structure;

use super::RARE;
use super::study::shard;
use crate::error::CommandError;
use crate::terminal::Terminal;

#[derive(Debug, Args)]
pub(crate) struct StructureArguments {
    /// Structure file, e.g. configs/structures/pier.toml
    pub(crate) structure: PathBuf,
    /// Result file with the spectra, records and hazard
    #[arg(long, value_name = "RESULT")]
    pub(crate) urs: PathBuf,
    /// Manifest of the records, if it was moved
    #[arg(long, help_heading = RARE, value_name = "CSV")]
    pub(crate) manifest: Option<PathBuf>,
    /// Compute only shard I of N of the structure's analyses
    #[arg(long, help_heading = RARE, value_name = "I/N", value_parser = shard, conflicts_with_all = ["shards", "json"])]
    pub(crate) shard: Option<Shard>,
    /// All shards of these analyses, from --shard
    #[arg(long, help_heading = RARE, value_name = "FILE", num_args = 1..)]
    pub(crate) shards: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) keeping: KeepArgument,
}

impl StructureArguments {
    /// Files that are read.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        [&self.structure, &self.urs].into_iter().chain(&self.manifest).map(PathBuf::as_path).collect()
    }

    /// Whether the answer says what small changes make of it: where it is `written`, told in detail, or made of shards,
    /// which serve every later question.
    pub(crate) fn asks_for_sensitivity(&self, is_written: bool, terminal: &Terminal) -> bool {
        let is_shared = self.shard.is_some() || !self.shards.is_empty();
        is_shared || is_written || terminal.shows_details()
    }

    /// The structure.
    pub(crate) fn load(&self) -> Result<Structure, CommandError> {
        Ok(Structure::load(&self.structure)?)
    }
}

/// Whether the answer is kept.
#[derive(Debug, Args)]
pub(crate) struct KeepArgument {
    /// Do not keep the answer in the result
    #[arg(long, help_heading = RARE)]
    no_keep: bool,
}

impl KeepArgument {
    /// Keeps what `finding` makes, in the result at `result`, unless it is not to be.
    pub(crate) fn keep(
        &self,
        finding: impl FnOnce() -> Result<Finding, uplift::UpliftError>,
        result: &Path,
        terminal: &Terminal,
    ) -> Result<(), CommandError> {
        if !self.no_keep {
            keep(&finding()?, result, terminal);
        }
        Ok(())
    }
}
