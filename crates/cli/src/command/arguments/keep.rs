//! Whether an answer goes into the result that it was asked under.

use std::path::Path;

use clap::Args;
use uplift::result::Finding;
use uplift::structure::keep;

use super::RARE;
use crate::error::CommandError;
use crate::terminal::Terminal;

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
