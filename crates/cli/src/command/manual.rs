//! `uplift manual`: what `make install` puts beside the program, for `man` and for the shells.

use std::path::{Path, PathBuf};

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate_to};
use uplift::outputs::provide_folder;

use crate::command::Arguments;
use crate::error::CommandError;

#[derive(Debug, Args)]
pub(crate) struct ManualArguments {
    /// Folder for them, for instance ~/.local/share
    folder: PathBuf,
}

/// Where each shell looks for the completions of a program, below the folder of shared files.
const SHELLS: [(Shell, &str); 3] = [
    (Shell::Bash, "bash-completion/completions"),
    (Shell::Zsh, "zsh/site-functions"),
    (Shell::Fish, "fish/vendor_completions.d"),
];

/// Writes a page of the manual for every command, and the completions of three shells.
pub(crate) fn manual(arguments: &ManualArguments) -> Result<(), CommandError> {
    let folder_of = |below: &str| -> Result<PathBuf, CommandError> {
        let folder = arguments.folder.join(below);
        provide_folder(&folder)?;
        Ok(folder)
    };
    let refused = |folder: &Path, error: &std::io::Error| {
        CommandError::Usage(format!("nothing can be written in {}: {error}", folder.display()))
    };
    let pages = folder_of("man/man1")?;
    clap_mangen::generate_to(Arguments::command(), &pages).map_err(|error| refused(&pages, &error))?;
    for (shell, below) in SHELLS {
        let folder = folder_of(below)?;
        generate_to(shell, &mut Arguments::command(), "uplift", &folder).map_err(|error| refused(&folder, &error))?;
    }
    // bash looks for a file of the program's own name
    let bash = arguments.folder.join(SHELLS[0].1);
    std::fs::rename(bash.join("uplift.bash"), bash.join("uplift")).map_err(|error| refused(&bash, &error))
}
