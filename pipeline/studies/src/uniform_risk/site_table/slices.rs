//! Slices of a table of sites: results of their own, joined into that of the whole table.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use uplift_ida::Watch;
use uplift_inputs::SiteList;
use uplift_job::JobError;
use uplift_job::events::{Events, Progress};
use uplift_job::outputs::beside;
use uplift_job::text::counted;
use uplift_result::{ResultFile, SiteArrays};
use uplift_study::{SiteSlice, UniformRiskStudy};

use super::files::SiteTableFiles;
use super::{SiteOutput, Tally};
use crate::error::StudiesError;

/// What the ending of the result of a slice begins with.
pub const SLICE: &str = "slice-";
/// Slices named where some are missing.
const NAMED: usize = 5;

/// Where the result of a slice goes, beside the result of the whole table.
pub fn slice_path(result: &Path, slice: SiteSlice) -> PathBuf {
    beside(result, &ending(slice))
}

fn ending(SiteSlice { number, count }: SiteSlice) -> String {
    let width = count.to_string().len();
    format!("{SLICE}{number:0width$}-of-{count}.h5")
}

/// The results whose stripes a slice at `path` takes instead of computing them: that of the whole table, and that of
/// the first slice, as far as they lie beside it under their usual names.
pub fn stripes_beside(study: &UniformRiskStudy, path: &Path) -> Vec<PathBuf> {
    let Some(slice) = study.site_table.as_ref().and_then(|table| table.slice) else { return Vec::new() };
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let Some(whole) = name.strip_suffix(&ending(slice)) else { return Vec::new() };
    let whole = path.with_file_name(format!("{whole}h5"));
    let first = slice_path(&whole, SiteSlice { number: 1, ..slice });
    [whole, first].into_iter().filter(|beside| beside != path && beside.is_file()).collect()
}

/// The results of the slices of the table of `study` in the order of the table.
///
/// # Errors
/// Every one that is missing, there twice, of another study or no slice, at once.
pub fn sorted_slices(study: &UniformRiskStudy, paths: &[PathBuf]) -> Result<Vec<PathBuf>, StudiesError> {
    let own = what_slices_share(&study.to_toml()?).map(|(table, _)| table);
    let mut mistakes = Vec::new();
    let mut found: BTreeMap<usize, &PathBuf> = BTreeMap::new();
    let mut counts = Vec::new();
    // a pattern such as *.h5 names the arrays of a slice too
    let is_cube = |path: &&PathBuf| paths.iter().any(|result| SiteArrays::path(result) == **path);
    for path in paths.iter().filter(|path| !is_cube(path)) {
        let name = path.display();
        let head = match ResultFile::open(path).and_then(|file| file.head()) {
            Ok(head) => head,
            Err(error) => {
                mistakes.push(error.to_string());
                continue;
            }
        };
        match what_slices_share(&head.study_toml) {
            _ if own.is_none() => mistakes.push(format!(
                "{name}: is a result, and the study has no [site_table] of which it could be a slice: give the shards \
                 of the run"
            )),
            Some((_, None)) | None => {
                mistakes.push(format!(
                    "{name}: is not a slice of a table of sites; `uplift run STUDY --sites 1/8` writes one"
                ));
            }
            Some((table, _)) if Some(&table) != own.as_ref() => {
                mistakes.push(format!("{name}: is a slice of another study, or of this one with other values"));
            }
            Some((_, Some(slice))) => {
                counts.push(slice.count);
                if let Some(twice) = found.insert(slice.number, path) {
                    mistakes.push(format!("{name}: slice {slice} is given twice, also as {}", twice.display()));
                }
            }
        }
    }
    counts.sort_unstable();
    counts.dedup();
    if let [count] = counts[..] {
        let missing: Vec<String> =
            (1..=count).filter(|n| !found.contains_key(n)).map(|n| format!("{n}/{count}")).collect();
        if !missing.is_empty() {
            let more = if missing.len() > NAMED { ", …" } else { "" };
            let named = missing[..missing.len().min(NAMED)].join(", ");
            let slices = counted(missing.len(), "slice");
            mistakes
                .push(format!("{slices} missing: {named}{more}; `uplift run STUDY --sites {}` writes it", missing[0]));
        }
    } else if !counts.is_empty() {
        let counts: Vec<String> = counts.iter().map(ToString::to_string).collect();
        mistakes.push(format!("slices of {} parts are mixed: give all of one division", counts.join(" and ")));
    }
    if mistakes.is_empty() {
        Ok(found.into_values().cloned().collect())
    } else {
        Err(JobError::Inputs(mistakes).into())
    }
}

/// All that the slices of a table have in common, and which slice it is.
fn what_slices_share(study_toml: &str) -> Option<(toml::Table, Option<SiteSlice>)> {
    let mut table: toml::Table = toml::from_str(study_toml).ok()?;
    for section in ["title", "output"] {
        table.remove(section);
    }
    let slice = table.get_mut("site_table")?.as_table_mut()?.remove("slice");
    Some((table, slice.and_then(|slice| slice.as_str()?.parse().ok())))
}

/// The files of many sites joined from those of the `slices`, in order; `line` says where the numbers come from, of
/// inputs with these `checksums`.
///
/// # Errors
/// A slice of other inputs, or whose files are not as they were written.
pub fn join(
    study: &UniformRiskStudy,
    (list, checksums): (&SiteList, &BTreeMap<String, String>),
    slices: &[PathBuf],
    (path, line): (&Path, &str),
    events: &dyn Events,
) -> Result<SiteOutput, StudiesError> {
    let mut files = SiteTableFiles::create(path, study, list, line)?;
    let mut tally = Tally::new(study, list);
    let progress = Progress::begin(events, "slices", "slices", slices.len() as u64);
    for slice in slices {
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        let head = ResultFile::open(slice)?.head()?;
        if head.input_checksums != *checksums {
            let name = slice.display();
            return Err(JobError::input(format!(
                "{name}: is of other records, hazard curves or sites than those of the study: run the slice again"
            ))
            .into());
        }
        let findings = files.write_slice(slice, &head.study_digest())?;
        tally.join(&serde_json::from_str(&findings).map_err(|error| JobError::input(error.to_string()))?);
        progress.finished(1);
    }
    drop(progress);
    SiteOutput::new(files, &tally, study, list)
}
