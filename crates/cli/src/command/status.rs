//! `uplift status`: how far a run is, and what a result holds.

use crate::error::CommandError;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use uplift::checkpoint::{Finding, RowFile, checkpoint_path};
use uplift::result::{Overview, ResultFile, ResultLock, is_hdf5};
use uplift_study::Study;

#[derive(Debug, Args)]
pub(super) struct StatusArguments {
    /// Result file, study file, or shard
    #[arg(value_name = "RESULT|STUDY|SHARD")]
    input: PathBuf,
}

pub(super) fn status(arguments: &StatusArguments) -> Result<(), CommandError> {
    let input = &arguments.input;
    let mut out = std::io::stdout().lock();
    if input.is_file() && !is_hdf5(input) {
        if let Ok(Some(finding)) = RowFile::read(input) {
            return unfinished(&mut out, input, &finding);
        }
        if input.extension().is_some_and(|extension| extension == "h5") {
            return Err(CommandError::input(format!("{} is no HDF5 file", input.display())));
        }
    }
    let result = if input.extension().is_some_and(|extension| extension == "toml") {
        Study::load_any(input, &[])?.output().file.clone()
    } else {
        input.clone()
    };
    let checkpoint = checkpoint_path(&result);
    let mut nothing = true;
    if result.is_file() {
        nothing = false;
        finished(&mut out, &result)?;
    }
    if let Some(finding) = RowFile::read(&checkpoint).map_err(uplift::UpliftError::from)? {
        nothing = false;
        unfinished(&mut out, &checkpoint, &finding)?;
    }
    for shard in shards_of(&result) {
        if let Ok(Some(finding)) = RowFile::read(&shard) {
            nothing = false;
            unfinished(&mut out, &shard, &finding)?;
        }
    }
    if let Some(holder) = ResultLock::holder(&result) {
        writeln!(out, "being written now, by {holder}")?;
    } else if nothing {
        return Err(CommandError::input(format!(
            "{}: no result, and no checkpoint of an unfinished run",
            result.display()
        )));
    }
    Ok(())
}

/// Files named as the shards of the result at `result`.
fn shards_of(result: &Path) -> Vec<PathBuf> {
    let stem = result.file_stem().unwrap_or(result.as_os_str()).to_string_lossy();
    let beginning = format!("{stem}.shard-");
    let folder = result.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut shards: Vec<PathBuf> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .filter(|entry| entry.file_name().to_string_lossy().starts_with(&beginning))
        .map(|entry| entry.path())
        .collect();
    shards.sort();
    shards
}

fn finished(out: &mut impl Write, path: &Path) -> Result<(), CommandError> {
    let file = ResultFile::open(path)?;
    let head = file.head()?;
    writeln!(out, "{}: finished {}, uplift {} ({})", path.display(), head.created, head.version, head.commit)?;
    writeln!(out, "  study    {} {}", head.study_file, head.title)?;
    writeln!(out, "  records  {}", head.record_set)?;
    match file.overview()? {
        Overview::Displacement { structure, analyses, sets, designed } => {
            writeln!(out, "  spectra  displacement spectra of {structure}s, {analyses} analyses")?;
            for (set, records) in sets {
                writeln!(out, "  set      {set}: {records} records, {} motions", 2 * records)?;
            }
            if designed {
                writeln!(out, "  design   uplift table {}", path.display())?;
            }
        }
        Overview::UniformRisk { analyses, sites, added } => {
            for (measure, analyses) in analyses {
                writeln!(out, "  {:<8} {analyses} analyses", measure.to_uppercase())?;
            }
            if !sites.is_empty() {
                writeln!(out, "  sites    {}", sites.join(", "))?;
            }
            if !added.is_empty() {
                writeln!(out, "  added    {}", added.join(", "))?;
            }
        }
    }
    Ok(())
}

fn unfinished(out: &mut impl Write, path: &Path, finding: &Finding) -> Result<(), CommandError> {
    let head = &finding.head;
    let what = if head.shards > 1 {
        format!("shard {} of {}", head.shard, head.shards)
    } else {
        "checkpoint of an unfinished run".to_owned()
    };
    // rows of another study may be among them, and those of design examples, which nobody counts before they are found
    let done = (finding.rows.len() as u64).min(head.rows);
    writeln!(
        out,
        "{}: {what}, {done} of {} analysis rows ({:.0} %) {}",
        path.display(),
        head.rows,
        100.0 * done as f64 / head.rows.max(1) as f64,
        head.title
    )?;
    if finding.damaged_bytes > 0 {
        writeln!(
            out,
            "  analysis rows that were cut off or damaged ({} bytes) will be computed again",
            finding.damaged_bytes
        )?;
    }
    Ok(())
}
