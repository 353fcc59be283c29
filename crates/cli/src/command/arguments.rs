//! Arguments that several commands take.

mod result;
mod structure;
mod study;

pub(crate) use result::ResultArguments;
pub(crate) use structure::{KeepArgument, StructureArguments};
pub(crate) use study::{StudyArguments, command_line, run_options, shard};
pub(crate) use uplift::typed::{Overwriting, RARE, number, number_or_per_cent};

use std::path::Path;

use crate::error::CommandError;

/// Endings of the files that the program writes.
const FILES: [&str; 9] = ["h5", "svg", "png", "pdf", "csv", "html", "json", "xlsx", "mat"];

/// Several numbers, parted by commas.
#[derive(Debug, Clone)]
pub(crate) struct Numbers(pub(crate) Vec<f64>);

/// Those of an option, however often it is given.
pub(crate) fn all_numbers(several: &[Numbers]) -> Vec<f64> {
    several.iter().flat_map(|Numbers(all)| all.iter().copied()).collect()
}

/// Reads `0.1,0.2`; `0,13` is a number with a decimal comma.
pub(crate) fn numbers(text: &str) -> Result<Numbers, String> {
    if let Some(decimals) = text.strip_prefix("0,").filter(|rest| rest.bytes().all(|byte| byte.is_ascii_digit())) {
        return Err(format!("the decimal mark is a point: write 0.{decimals}"));
    }
    text.split(',').map(number).collect::<Result<_, _>>().map(Numbers)
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_comma_is_named() {
        assert!(numbers("0,13").is_err_and(|error| error.contains("write 0.13")));
        assert!(numbers("0.1,x").is_err());
        assert!(numbers("0.1,0.2").is_ok_and(|Numbers(all)| all == [0.1, 0.2]));
    }
}
