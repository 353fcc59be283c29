//! `uplift consistency`: the question asked of a result, and the answer added to it.

use std::path::{Path, PathBuf};

use clap::Args;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::write_table;
use uplift_job::{Array, JobError};
use uplift_motion::IntensityMeasure;
use uplift_result::LockedResult;
use uplift_study::Repair;
use uplift_uniform_risk::StoredStripes;
use uplift_uniform_risk::consistency::{
    ConsistencyReport, Keep, Question, add, columns, consistency_path, disaggregated, earthquakes, repairs_of, replaced,
};

use crate::error::QuestionsError;

/// What is done beyond asking.
#[derive(Debug, Clone, PartialEq, Eq, Default, Args)]
pub struct ConsistencyOptions {
    /// Weight the records to match both hazard curves, and add the repaired spectra
    #[arg(long)]
    pub repair: bool,
    /// Keep every weight in the result; implies --repair
    #[arg(long)]
    pub keep_weights: bool,
    /// Disaggregation (`OpenQuake`) to compare with the records
    #[arg(long = "disaggregation", value_name = "[SITE=]FILE", value_parser = site_and_file)]
    pub disaggregations: Vec<(Option<String>, PathBuf)>,
    /// Whether existing files are overwritten.
    #[arg(skip)]
    pub force: bool,
}

/// `Athens=Mag_Dist-mean-0.csv`, or a file alone.
#[expect(clippy::unnecessary_wraps, reason = "as clap calls it")]
fn site_and_file(text: &str) -> Result<(Option<String>, PathBuf), String> {
    Ok(match text.split_once('=') {
        // a file may be called so
        Some((site, file)) if !Path::new(text).exists() => (Some(site.trim().to_owned()), file.into()),
        _ => (None, text.into()),
    })
}

/// Whether the records of the result at `result` bring the hazard of the other measure, and if asked for the spectra of
/// weights by which they do: written into the file and into a table beside it.
///
/// # Errors
/// A file that is missing, damaged or of another kind; a file that cannot be written; [`JobError::Interrupted`]
/// where `events` say so.
pub fn consistency(
    result: &Path,
    options: &ConsistencyOptions,
    events: &dyn Events,
) -> Result<ConsistencyReport, QuestionsError> {
    let (locked, file) = LockedResult::open(result, events)?;
    let question = Question::from_result(&file)?;
    let shaken = disaggregated(&question, &options.disaggregations)?;
    if !question.can_be_asked() {
        return Ok(ConsistencyReport::new(&question, &[], &[], &[]));
    }
    let stored = StoredStripes::read(&file)?;
    let table = Output::new(consistency_path(&stored.path), OutputKind::Table("implied_level"));
    outputs::check(&[table], &[result], options.force)?;
    // a repair that is there stays: what was made of it would be of another result
    let is_there = file.has_repair();
    let repair = options.repair || options.keep_weights || is_there || question.settings.repair == Repair::Weights;
    let findings = question.findings(repair)?;
    if events.cancelled() {
        return Err(JobError::Interrupted.into());
    }
    let repairs = if repair { repairs_of(&file, &stored, &question, &findings)? } else { Vec::new() };
    let keep = if options.keep_weights { Keep::Weights } else { Keep::Exponents };
    locked.write(&replaced(), |writer| add(writer, &question, &findings, &repairs, keep))?;
    let plain_m: Vec<(IntensityMeasure, Array<3>)> =
        file.spectra()?.measures.into_iter().map(|spectra| (spectra.measure, spectra.u_m)).collect();
    let mut report = ConsistencyReport::new(&question, &findings, &plain_m, &repairs);
    report.earthquakes = earthquakes(&question, &report.rows, &shaken);
    for ((_, path), (site, _)) in options.disaggregations.iter().zip(&shaken) {
        if !report.earthquakes.iter().any(|row| row.site == question.sites[*site]) {
            events.note(&format!("{}: ignored, its measure and probability are not in the result", path.display()));
        }
    }
    let path = consistency_path(&stored.path);
    write_table(&path, &stored.line("hazard consistency"), columns(&report))?;
    report.result = Some(stored.path.clone());
    report.table = Some(path);
    Ok(report)
}
