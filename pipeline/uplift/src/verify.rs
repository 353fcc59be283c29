//! Whether results are as they were written.

use std::path::PathBuf;

use serde::Serialize;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::is_sites;
use uplift_labelled::{Seal, Verdict, verify as verify_file, verify_bytes};
use uplift_result::ResultFile;

use crate::error::UpliftError;

/// What was found of some results.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct VerifyReport {
    /// The files, in the order in which they were given.
    pub files: Vec<VerifiedFile>,
}

/// What was found of a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct VerifiedFile {
    /// The file.
    pub file: PathBuf,
    /// Arrays that are as they were written.
    pub sound: usize,
    /// Arrays without a checksum.
    pub unknown: Vec<String>,
    /// What is not as it was written, each with the name of the file; empty of a file that is sound.
    pub mistakes: Vec<String>,
}

impl VerifyReport {
    /// What is wrong with the files; empty where all are as they were written.
    pub fn mistakes(&self) -> Vec<String> {
        self.files.iter().flat_map(|file| file.mistakes.iter().cloned()).collect()
    }
}

/// Checks every byte of the result `files`. A file that is damaged or no result is a finding, not an error.
///
/// # Errors
/// An interruption.
pub fn verify(files: &[PathBuf], events: &dyn Events) -> Result<VerifyReport, UpliftError> {
    let mut found = Vec::new();
    for file in files {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        // what is damaged is not opened; what is whole may still be of another program
        let verdict = verify_file(file).map_err(UpliftError::from).and_then(|verdict| {
            if verdict.is_sound() && !is_sites(file) {
                ResultFile::open(file)?;
            }
            Ok(verdict)
        });
        found.push(match verdict {
            Ok(verdict) => VerifiedFile::from_verdict(file.clone(), verdict),
            Err(error) => {
                let mistakes = vec![error.to_string()];
                VerifiedFile { file: file.clone(), sound: 0, unknown: Vec::new(), mistakes }
            }
        });
    }
    Ok(VerifyReport { files: found })
}

/// Refuses result `files` of which some byte is not as it was written, whether what is asked of them needs it or not.
///
/// # Errors
/// [`JobError::Inputs`] with everything that is wrong with them.
pub fn require_whole(files: &[PathBuf]) -> Result<(), UpliftError> {
    let mut mistakes = Vec::new();
    for file in files {
        mistakes.extend(VerifiedFile::from_verdict(file.clone(), verify_bytes(file)?).mistakes);
    }
    if mistakes.is_empty() { Ok(()) } else { Err(JobError::Inputs(mistakes).into()) }
}

impl VerifiedFile {
    fn from_verdict(file: PathBuf, verdict: Verdict) -> Self {
        let name = file.display();
        let remedy = "use another copy, or run the study again";
        let mut mistakes: Vec<String> =
            verdict.damaged.iter().map(|damage| format!("{name} is damaged: {damage}; {remedy}")).collect();
        match verdict.seal {
            Seal::Broken if mistakes.is_empty() => {
                mistakes.push(format!("{name} has changed since it was written: {remedy}"));
            }
            Seal::Missing => mistakes.push(format!(
                "{name}: the checksum at its end is missing: another program has changed it, or it is cut short; \
                 {remedy}"
            )),
            Seal::Broken | Seal::Whole => {}
        }
        Self { sound: verdict.sound, unknown: verdict.unknown, mistakes, file }
    }
}
