//! What becomes of files that are in the way.

use clap::Args;

/// Whether files that are there give way.
#[derive(Debug, Args)]
pub(crate) struct ForceArgument {
    /// Replace files that this command did not write for the same input; an input is never replaced
    #[arg(long)]
    pub(crate) force: bool,
}
