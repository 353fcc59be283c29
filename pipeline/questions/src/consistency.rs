//! `uplift consistency`: the question asked of a result, and the answer added to it.

use std::path::{Path, PathBuf};

use clap::Args;
use polars::prelude::Column;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind, beside};
use uplift_job::table::{ColumnsOf, write_table};
use uplift_job::{Array, JobError};
use uplift_motion::IntensityMeasure;
use uplift_result::{ConsistencyGroup, LockedResult};
use uplift_study::Repair;
use uplift_uniform_risk::StoredStripes;
use uplift_uniform_risk::consistency::{
    Answer, ConsistencyReport, ConsistencyRow, Question, TargetRow, disaggregated, earthquakes,
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
    if question.sites.is_empty()
        && let Some(elsewhere) = file.without_verdicts()
    {
        return Err(elsewhere.into());
    }
    let shaken = disaggregated(&question, &options.disaggregations)?;
    if !question.can_be_asked() {
        return Ok(Answer::from_question(question, &file, None, false, events)?.report(&[]));
    }
    let stored = StoredStripes::read(&file)?;
    let path = beside(&stored.path, "consistency.csv");
    outputs::check(&[Output::new(path.clone(), OutputKind::Table("implied_level"))], &[result], options.force)?;
    // a repair that is there stays: what was made of it would be of another result
    let is_there = file.has_repair();
    let repair = options.repair || options.keep_weights || is_there || question.settings.repair == Repair::Weights;
    let answer = Answer::from_question(question, &file, Some(&stored), repair, events)?;
    if events.cancelled() {
        return Err(JobError::Interrupted.into());
    }
    locked.write(&ConsistencyGroup::replaced(), |writer| answer.group(options.keep_weights).write(writer))?;
    let plain_m: Vec<(IntensityMeasure, Array<3>)> =
        file.spectra()?.measures.into_iter().map(|spectra| (spectra.measure, spectra.u_m)).collect();
    let (question, mut report) = (answer.question(), answer.report(&plain_m));
    report.earthquakes = earthquakes(question, &report.rows, &shaken);
    for ((_, path), (site, _)) in options.disaggregations.iter().zip(&shaken) {
        if !report.earthquakes.iter().any(|row| row.site == question.sites[*site]) {
            events.note(&format!("{}: ignored, its measure and probability are not in the result", path.display()));
        }
    }
    write_table(&path, &stored.line("hazard consistency"), columns(&report))?;
    report.result = Some(stored.path.clone());
    report.table = Some(path);
    Ok(report)
}

/// The rows of a report as a table: a row a measure, site and probability.
fn columns(report: &ConsistencyReport) -> Vec<Column> {
    let targets = report.rows.iter().flat_map(|row| row.targets.iter().map(move |target| (row, target)));
    let repaired = |(row, target): (&ConsistencyRow, &TargetRow), value: fn(&TargetRow) -> Option<f64>| {
        value(row.repair.as_ref()?.targets.iter().find(|own| own.poe.to_bits() == target.poe.to_bits())?)
    };
    ColumnsOf::new(targets)
        .with("site", |(row, _)| row.site.as_str())
        .with("scaled_to", |(row, _)| row.scaled_to)
        .with("shows", |(row, _)| row.shows)
        .with("unit", |(row, _)| row.unit)
        .with("poe", |(_, target)| target.poe)
        .with("years", |_| report.years)
        .with("site_level", |(_, target)| target.site_level)
        .with("implied_level", |(_, target)| target.implied_level)
        .with("ratio", |(_, target)| target.ratio)
        .with("times_as_often", |(_, target)| target.times_as_often)
        .with("bias", |(row, _)| row.bias)
        .with("rms", |(row, _)| row.rms)
        .with("max", |(row, _)| row.max)
        .with("verdict", |(row, _)| row.verdict.unwrap_or_default())
        .with("scale_factor_05", |(_, target)| target.scale_factors[0])
        .with("scale_factor_50", |(_, target)| target.scale_factors[1])
        .with("scale_factor_95", |(_, target)| target.scale_factors[2])
        .with("scale_factors_outside", |(_, target)| target.outside_limits)
        .with("effective_records", |(_, target)| target.effective_records)
        .with("effective_events", |(_, target)| target.effective_events)
        .with("repaired_ratio", |at| repaired(at, |target| target.ratio))
        .with("repaired_effective_records", |at| repaired(at, |target| Some(target.effective_records)))
        .with("repaired_effective_events", |at| repaired(at, |target| target.effective_events))
        .build()
}
