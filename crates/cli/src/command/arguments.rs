//! Arguments that several commands take.

mod figures;
mod keep;
mod probability;
mod result;
mod risk;
mod structure;
mod study;

pub(crate) use figures::FigureArguments;
pub(crate) use keep::KeepArgument;
pub(crate) use probability::{number_or_per_cent, probability};
pub(crate) use result::ResultArguments;
pub(crate) use risk::{OneRiskArguments, RiskArguments};
pub(crate) use structure::StructureArguments;
pub(crate) use study::{StudyArguments, command_line, run_options, shard};

use std::path::Path;

use clap::Args;
use uplift_frame::Model;

use crate::error::CommandError;

/// Heading of the options that few need.
pub(crate) const RARE: &str = "Rarely needed";

/// Endings of the files that the program writes.
const FILES: [&str; 9] = ["h5", "svg", "png", "pdf", "csv", "html", "json", "xlsx", "mat"];

/// Whether files that are there are overwritten.
#[derive(Debug, Args)]
pub(crate) struct ForceArgument {
    /// Overwrite existing outputs (never an input)
    #[arg(long)]
    pub(crate) force: bool,
}

/// A model of a frame by its name.
pub(crate) fn model(word: &str) -> Result<Model, String> {
    match word {
        "planar" => Ok(Model::Planar),
        "wobbling" => Ok(Model::Wobbling),
        _ => Err("it is planar or wobbling".to_owned()),
    }
}

/// Reads `0.2` or `2e-4`; of a decimal comma it is said what to write, of a list that one number is wanted.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    text.parse::<f64>().map_err(|_| {
        let pointed = text.replace(',', ".");
        let is_number = |part: &str| part.trim().parse::<f64>().is_ok();
        match text.split_once(',') {
            Some((whole, decimals)) if is_number(&pointed) && whole.len() + decimals.len() < 5 => {
                format!("the decimal mark is a point: write {pointed}")
            }
            Some(_) if text.split(',').all(is_number) => {
                "give one number, and repeat the command for the others".to_owned()
            }
            _ => "write a number, 0.2 or 2e-4, without a unit".to_owned(),
        }
    })
}

/// Several numbers, parted by commas.
#[derive(Debug, Clone)]
pub(crate) struct Numbers(pub(crate) Vec<f64>);

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
        assert_eq!(number(" 2e-4"), Ok(2e-4));
        assert!(number("0,2").is_err_and(|error| error.ends_with("write 0.2")));
        for text in ["475,2475", "1,234,567"] {
            assert!(number(text).is_err_and(|error| error.starts_with("give one number")), "{text}");
        }
        for text in ["0.2 m", "x", ""] {
            assert!(number(text).is_err_and(|error| error.starts_with("write a number")), "{text}");
        }
        assert!(numbers("0,13").is_err_and(|error| error.contains("write 0.13")));
        assert!(numbers("0.1,x").is_err());
        assert!(numbers("0.1,0.2").is_ok_and(|Numbers(all)| all == [0.1, 0.2]));
    }
}
