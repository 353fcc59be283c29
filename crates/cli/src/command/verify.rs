//! `uplift verify`: whether a result is as it was written.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::Terminal;
use crate::error::CommandError;
use uplift::result::ResultFile;
use uplift_labelled::{Seal, verify as verify_file};

#[derive(Debug, Args)]
pub(super) struct VerifyArguments {
    /// Result files of `uplift run`
    #[arg(required = true, value_name = "RESULT")]
    results: Vec<PathBuf>,
}

pub(super) fn verify(arguments: &VerifyArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let mut mistakes = Vec::new();
    let mut out = std::io::stdout().lock();
    for path in &arguments.results {
        let name = path.display();
        let verdict = match ResultFile::open(path).and_then(|_| Ok(verify_file(path)?)) {
            Ok(verdict) => verdict,
            Err(error) => {
                mistakes.push(error.to_string());
                continue;
            }
        };
        mistakes.extend(verdict.damaged.iter().map(|damage| format!("{name}: {damage}")));
        match verdict.seal {
            Seal::Broken if verdict.damaged.is_empty() => mistakes.push(format!(
                "{name}: some byte is not as it was written, in what lies between the arrays: take the numbers from a copy, or run the study again"
            )),
            Seal::Broken => mistakes.push(format!("{name}: is damaged: run the study again")),
            Seal::Missing => mistakes.push(format!(
                "{name}: the checksum of the whole file is not at its end: another program has written to it, or its end is missing"
            )),
            Seal::Whole(_) => {}
        }
        if !verdict.unknown.is_empty() {
            terminal.say(&format!(
                "{name}: {} arrays without a checksum: {}",
                verdict.unknown.len(),
                verdict.unknown.join(", ")
            ));
        }
        if verdict.is_sound() {
            writeln!(out, "{name}: {} arrays as they were written, and every byte of the file", verdict.sound)?;
        }
    }
    if mistakes.is_empty() { Ok(()) } else { Err(uplift::UpliftError::Inputs(mistakes).into()) }
}
