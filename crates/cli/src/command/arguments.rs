//! Arguments that several commands take.

mod result;
mod structure;
mod study;

pub(crate) use result::ResultArguments;
pub(crate) use structure::{KeepArgument, StructureArguments};
pub(crate) use study::{StudyArguments, command_line, run_options, shard};
pub(crate) use uplift::typed::{Numbers, Overwriting, RARE, all_numbers, number, numbers};

use std::path::Path;

use crate::error::CommandError;

/// Endings of the files that the program writes.
const FILES: [&str; 9] = ["h5", "svg", "png", "pdf", "csv", "html", "json", "xlsx", "mat"];

/// Refuses a `folder` for some files (`what`) whose name is that of a file, unless there is such a folder.
pub(crate) fn require_folder(folder: &Path, what: &str) -> Result<(), CommandError> {
    let looks_like_a_file = folder.extension().is_some_and(|ending| FILES.iter().any(|known| ending == *known));
    if folder.is_dir() || !looks_like_a_file {
        return Ok(());
    }
    Err(CommandError::Usage(format!(
        "{}: -o names a folder for the {what}, and this is the name of a file: write -o {}",
        folder.display(),
        folder.with_extension("").display()
    )))
}
