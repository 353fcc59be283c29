//! From `STUDY|RESULT` to a result: the one that is there if it is the study's, else the study is run.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift::result::is_hdf5;
use uplift::{load_uniform_risk, result_of};
use uplift_study::{Bootstrap, Repair, Structure};

use super::Overwriting;
use super::study::run_options;
use crate::error::CommandError;
use crate::terminal::Terminal;

/// A result, or a study that has or makes one.
#[derive(Debug, Args)]
pub(crate) struct ResultArguments {
    /// Result file, or a study file, which is run first if needed
    #[arg(value_name = "STUDY|RESULT")]
    input: PathBuf,
    /// Set a key of the study, e.g. records.first=20
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    #[command(flatten)]
    overwriting: Overwriting,
}

/// A result file that is there.
pub(crate) struct FoundResult {
    pub(crate) path: PathBuf,
    /// What the study file, if one was given, says about the bootstrap.
    pub(crate) bootstrap: Option<Bootstrap>,
    /// Whether the study file, if one was given, asks for a repair.
    pub(crate) repair: bool,
}

impl ResultArguments {
    /// Whether files that are there are overwritten.
    pub(crate) fn force(&self) -> bool {
        self.overwriting.force
    }

    /// The file, where it is of a structure.
    pub(crate) fn structure(&self) -> Option<&Path> {
        Some(self.input.as_path()).filter(|file| Structure::is_written_in(file))
    }

    /// The result to read from: as [`find`](Self::find), or the only one in a folder.
    pub(crate) fn find_to_read(&self, terminal: &Terminal) -> Result<PathBuf, CommandError> {
        if self.input.is_dir() { only_result(&self.input) } else { Ok(self.find(terminal)?.path) }
    }

    /// The result; a study without one is run.
    pub(crate) fn find(&self, terminal: &Terminal) -> Result<FoundResult, CommandError> {
        if is_hdf5(&self.input) || self.input.extension().is_some_and(|ending| ending == "h5" || ending == "part") {
            if !self.overrides.is_empty() {
                return Err(CommandError::Usage(
                    "--set changes a study, and a result was given: give the study file instead".to_owned(),
                ));
            }
            return Ok(FoundResult { path: self.input.clone(), bootstrap: None, repair: false });
        }
        let study = load_uniform_risk(&self.input, &self.overrides)?;
        let options = run_options(&self.input, &self.overrides, None, self.force());
        let path = result_of(&study, &options, terminal)?;
        let repair = study.consistency.repair == Repair::Weights;
        Ok(FoundResult { path, bootstrap: Some(study.bootstrap.clone()), repair })
    }
}

/// The result in a folder, or in its `results`.
fn only_result(folder: &Path) -> Result<PathBuf, CommandError> {
    let folders = [folder.to_owned(), folder.join("results")];
    let files = folders.iter().filter_map(|folder| folder.read_dir().ok()).flatten().flatten().map(|file| file.path());
    let mut results: Vec<PathBuf> = files.filter(|file| file.is_file() && is_hdf5(file)).collect();
    results.sort();
    let name = folder.display();
    let reason = match &mut results[..] {
        [only] => return Ok(std::mem::take(only)),
        [] if folder.join("study.toml").is_file() => {
            format!("{name} is a folder without a result: run its study: uplift run {name}/study.toml")
        }
        [] => format!("{name} is a folder without a result: give a result, or a study to run"),
        several => {
            let several: Vec<String> = several.iter().map(|file| file.display().to_string()).collect();
            format!("{name} is a folder with several results: give one of {}", several.join(", "))
        }
    };
    Err(CommandError::Usage(reason))
}
