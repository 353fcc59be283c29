//! Which records a study takes, and a manifest of them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{table_text, write_atomically};
use uplift_job::typed::Overwriting;
use uplift_motion::Combination;
use uplift_study::RecordSelection;

use super::{Criteria, SetOptions};
use crate::error::InputsError;
use crate::manifest;

/// Which records are chosen, and where they are listed.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct SelectOptions {
    /// The set, and what the chosen records have in common: at least one criterion.
    #[command(flatten)]
    pub set: SetOptions,
    /// Write a manifest of the selected records
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Whether existing files are overwritten.
    #[command(flatten)]
    pub overwriting: Overwriting,
}

/// The records that were chosen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SelectReport {
    /// Their names, in the order of the manifest.
    pub records: Vec<String>,
    /// How many the set has in all.
    pub count: usize,
    /// The section of a study that chooses the same records, TOML.
    pub study_lines: String,
    /// The manifest that was written.
    pub manifest: Option<PathBuf>,
}

/// Chooses records of a set.
///
/// # Errors
/// No range; a set that cannot be read; no record within the ranges; a manifest that would overwrite what is not this
/// program's, or cannot be written.
pub fn select(options: &SelectOptions, events: &dyn Events) -> Result<SelectReport, InputsError> {
    let set = &options.set;
    let selection = &set.criteria.0;
    if selection.is_empty() {
        return Err(JobError::Usage("say which records, e.g. --magnitude 6.5:7.5 --pulse-like false".to_owned()).into());
    }
    if let Some(output) = &options.output {
        let mut inputs = vec![set.manifest.clone()];
        inputs.extend(manifest::record_files(&set.manifest));
        outputs::check(&[Output::new(output, OutputKind::Manifest)], &inputs, options.overwriting.force)?;
    }
    let (pairs, count) = set.read(events)?;
    let records: Vec<String> = pairs.into_iter().map(|(pair, _)| pair.id).collect();
    if let Some(output) = &options.output {
        let ids: BTreeSet<&str> = records.iter().map(String::as_str).collect();
        let folder = output.parent().unwrap_or(Path::new(""));
        let columns = manifest::rows_of(&set.manifest, &ids, folder).map_err(JobError::Inputs)?;
        let (version, commit) = (uplift_job::VERSION, uplift_job::COMMIT);
        let line = format!("uplift {version} ({commit}), {} of {count} records: {selection}", records.len());
        let content = table_text(output, &line, columns)?;
        // what a study would refuse is not written
        manifest::read_bytes(&content, output, None).map_err(JobError::Inputs)?;
        write_atomically(output, &content)?;
    }
    Ok(SelectReport { study_lines: study_lines(set), records, count, manifest: options.output.clone() })
}

/// The section of a study.
fn study_lines(set: &SetOptions) -> String {
    let SetOptions { manifest, tag, intensity, criteria: Criteria(selection) } = set;
    let mut lines =
        vec!["[records]".to_owned(), format!("manifest = {}", toml::Value::from(manifest.display().to_string()))];
    lines.extend(tag.as_ref().map(|tag| format!("tag = {}", toml::Value::from(tag.as_str()))));
    lines.extend(chosen(*intensity, selection));
    lines.join("\n") + "\n"
}

fn chosen(intensity: Combination, selection: &RecordSelection) -> Vec<String> {
    let mut lines = vec![format!("intensity = \"{intensity}\""), String::new(), "[records.select]".to_owned()];
    lines.extend(selection.ranges.iter().map(|(criterion, range)| format!("{} = \"{range}\"", criterion.key)));
    lines.extend(selection.pulse_like.map(|pulse_like| format!("pulse_like = {pulse_like}")));
    lines
}
