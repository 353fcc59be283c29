//! A study carried out, of whichever kind: the frame that all kinds share.
//!
//! A kind has a folder of its own, [`uniform_risk`], [`displacement`] or [`shake_table`], with the same files in it:
//! `plan` (what it costs), `run` (from the inputs to the result file), `report` (what a run tells), `write` (what it
//! puts into the file).

use std::io::ErrorKind;
use std::path::Path;
use std::time::Instant;

use uplift_atomic_file::FileError;
use uplift_engine::checkpoint::{FinishedRows, RowFile, checkpoint_path};
use uplift_inputs::manifest;
use uplift_job::events::Events;
use uplift_job::study_run::Place;
use uplift_job::{JobError, cause, outputs};
use uplift_labelled::LabelledError;
use uplift_study::AnyStudy;

use crate::error::UpliftError;
pub use crate::finished::RunReport;
use crate::finished::{finished, tables};
use uplift_job::lock::ResultLock;
pub use uplift_job::study_run::{RunHead, RunOptions};
use uplift_result::{check_place, replaces_another};
use uplift_studies::{displacement, shake_table, uniform_risk};

/// Carries out a study: records and hazard are read and checked, everything that is not known from before is computed,
/// and the result file and its tables are written.
///
/// A study whose result is there and whole is done already, unless it is run [`again`](RunOptions::again).
///
/// Finished rows of the analysis outlive whatever stops the run, in a checkpoint beside the result; an earlier result
/// stays until the new one is complete.
///
/// # Errors
/// Inputs that cannot be used; a result that cannot be written; [`JobError::Paused`] or [`JobError::Interrupted`]
/// where `events` say so.
pub fn run(study: &AnyStudy, options: &RunOptions, events: &dyn Events) -> Result<RunReport, UpliftError> {
    if !options.again
        && let Some(report) = finished(study, options, Instant::now(), events)?
    {
        // of a run that was killed after its last write
        ResultLock::clear(options.result_file(&study.output().file));
        return Ok(report);
    }
    run_with(study, options, FinishedRows::default(), events)
}

/// Refuses a run whose result or tables would replace something else, see [`outputs`].
pub(crate) fn check_outputs(study: &AnyStudy, options: &RunOptions) -> Result<(), UpliftError> {
    let path = options.result_file(&study.output().file);
    let tables = tables(study, path);
    let mut inputs = vec![options.study_file.clone()];
    inputs.extend(study.inputs().into_iter().map(Path::to_owned));
    if options.force {
        // nothing but their names keeps the records from being written over; what is wrong with them is said later
        inputs.extend(study.inputs().into_iter().flat_map(manifest::record_files));
    }
    check_place(study, options, &inputs)?;
    Ok(outputs::check(&tables, &inputs, options.force)?)
}

/// Why a run would replace the result of another, and what to do about it, see [`replaces_another`].
pub(crate) fn replaced(study: &AnyStudy, options: &RunOptions) -> Result<Option<String>, UpliftError> {
    let checkpoint = checkpoint_path(options.result_file(&study.output().file));
    let name = checkpoint.file_name().unwrap_or_default().to_string_lossy();
    let has_rows = || matches!(RowFile::read(&checkpoint), Ok(Some(found)) if !found.rows.is_empty());
    let way_out = |reason| {
        let kept = if has_rows() { format!("; {name} has analyses of an interrupted run") } else { String::new() };
        format!("{reason}: give the result another name (-o), or --force to replace it{kept}")
    };
    Ok(replaces_another(study, options)?.map(way_out))
}

/// Refuses a run that would replace the result of another, see [`replaces_another`].
pub(crate) fn check_replaced(study: &AnyStudy, options: &RunOptions) -> Result<(), UpliftError> {
    replaced(study, options)?.map_or(Ok(()), |reason| Err(JobError::Usage(reason).into()))
}

/// As [`run`], with rows of the analysis that are `known` from elsewhere.
///
/// # Errors
/// As [`run`].
pub fn run_with(
    study: &AnyStudy,
    options: &RunOptions,
    known: FinishedRows,
    events: &dyn Events,
) -> Result<RunReport, UpliftError> {
    let start = Instant::now();
    let path = options.result_file(&study.output().file);
    // a place that cannot be written is found now, not after the analyses
    check_outputs(study, options)?;
    check_replaced(study, options)?;
    let _lock = ResultLock::acquire(path)?;
    for warning in study.warnings() {
        let doubt = if warning.unlikely { "mistake? " } else { "" };
        events.note(&format!("{doubt}{warning}"));
    }
    let place = Place { path, options, start };
    let report: Result<RunReport, UpliftError> = match study {
        AnyStudy::UniformRisk(study) => uniform_risk::run(study, &place, known, events)
            .map(|report| RunReport::UniformRisk(Box::new(report)))
            .map_err(UpliftError::from),
        AnyStudy::Displacement(study) => {
            displacement::run(study, &place, known, events).map(RunReport::Displacement).map_err(UpliftError::from)
        }
        AnyStudy::ShakeTable(study) => {
            shake_table::run(study, &place, events).map(RunReport::ShakeTable).map_err(UpliftError::from)
        }
    };
    let checkpoint = checkpoint_path(path);
    if report.as_ref().is_err_and(is_of_disk) && checkpoint.is_file() {
        let name = checkpoint.display();
        events.note(&format!(
            "the finished analyses are in {name}: solve the problem, and run the same command to resume"
        ));
    }
    report
}

/// What the operating system says where there is no room.
const FULL: [ErrorKind; 3] = [ErrorKind::StorageFull, ErrorKind::FileTooLarge, ErrorKind::QuotaExceeded];

/// Whether a result could not be written, as on a full disk.
fn is_of_disk(error: &UpliftError) -> bool {
    matches!(cause(error), Some(LabelledError::Hdf5 { action: "write" | "create" | "close" | "flush", .. }))
        || matches!(cause(error), Some(FileError::Io { source, .. }) if FULL.contains(&source.kind()))
}
