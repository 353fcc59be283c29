//! `uplift init`: a small study to start from.

use std::path::PathBuf;

use clap::Args;
use uplift::init::init as write;

use crate::error::CommandError;
use crate::show::{print_files, typed_path};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  uplift init first\n  uplift run first/study.toml")]
pub(crate) struct InitArguments {
    /// Folder for the study and its hazard curves
    #[arg(default_value = "first")]
    folder: PathBuf,
}

pub(crate) fn init(arguments: &InitArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let files = write(&arguments.folder)?;
    print_files(&files, terminal)?;
    if let Some(study) = files.first() {
        terminal.say(&format!("Next: uplift run {}", typed_path(study)));
    }
    Ok(())
}
