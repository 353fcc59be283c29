//! A study file, and how it is run.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift::analysis::MOST_SHARDS;
use uplift::uniform_risk::site_table::slice_path;
use uplift::{RunOptions, load_study};
use uplift_ida::Shard;
use uplift_study::{AnyStudy, SiteSlice};

use crate::error::CommandError;

/// A study file and what is changed of it.
#[derive(Debug, Args)]
pub(crate) struct StudyArguments {
    /// Study file, e.g. configs/europe.toml; - reads standard input
    pub(crate) study: PathBuf,
    /// Set a key of the study, e.g. records.first=20
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) overrides: Vec<String>,
}

impl StudyArguments {
    /// The study, of whichever kind, every default filled in.
    pub(crate) fn load_any(&self) -> Result<AnyStudy, CommandError> {
        Ok(load_study(&self.study, &self.overrides)?)
    }

    /// The same, of one slice of its table of sites where one is asked for, with the options of its run; the result of
    /// a slice has a name of its own unless `output` is one.
    pub(crate) fn load_slice(
        &self,
        slice: Option<SiteSlice>,
        output: Option<&Path>,
        force: bool,
    ) -> Result<(AnyStudy, RunOptions), CommandError> {
        let of_slice = slice.map(|slice| format!("site_table.slice=\"{slice}\""));
        let overrides = self.overrides.iter().cloned().chain(of_slice).collect();
        let own = Self { study: self.study.clone(), overrides };
        let study = own.load_any()?;
        let output = output.map(Path::to_owned).or_else(|| Some(slice_path(&study.output().file, slice?)));
        let options = run_options(&own.study, &own.overrides, output, force);
        Ok((study, options))
    }
}

/// What was typed, for the result.
pub(crate) fn command_line() -> String {
    std::env::args().collect::<Vec<_>>().join(" ")
}

/// The options of a run that was typed.
pub(crate) fn run_options(file: &Path, overrides: &[String], output: Option<PathBuf>, force: bool) -> RunOptions {
    let (study_file, overrides) = (file.to_owned(), overrides.to_vec());
    RunOptions { study_file, output, command: command_line(), overrides, force, ..RunOptions::default() }
}

/// Reads `1/8`.
pub(crate) fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text
        .split_once('/')
        .and_then(|(index, count)| Some((index.trim().parse::<u64>().ok()?, count.trim().parse::<u64>().ok()?)));
    match numbers {
        Some((index, count)) if index >= 1 && index <= count && count <= MOST_SHARDS => {
            Ok(Shard { index: index - 1, count })
        }
        Some((index, count)) if index > count && count >= 1 => {
            Err(format!("there is no shard {index} of {count}: the first number is from 1 to {count}"))
        }
        _ => Err(format!("write 1/8 for the first of eight shards; at most {MOST_SHARDS}")),
    }
}
