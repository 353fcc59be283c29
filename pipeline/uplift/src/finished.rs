//! A study whose result is there, whole and its own: nothing is left to run.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;
use uplift_alarms::alarms;
use uplift_atomic_file::clear_leftovers;
use uplift_engine::checkpoint::checkpoint_path;
use uplift_ida::NUMERICS;
use uplift_inputs::{input_checksums, read_hazard, read_other_hazard, read_records, site_table_checksums};
use uplift_job::events::{Events, Silent};
use uplift_job::lock::ResultLock;
use uplift_job::outputs::{Output, digest_said, metadata_path};
use uplift_job::study_run::{RunHead, RunOptions};
use uplift_labelled::verify as verify_file;
use uplift_motion::IntensityMeasure;
use uplift_result::earlier::Earlier;
use uplift_result::{Kind, Overview, Provenance, ResultFile, what_counts};
use uplift_studies::uniform_risk::MeasureReport;
use uplift_studies::{StudiesError, Table, displacement, shake_table, uniform_risk, write_tables};
use uplift_study::{AnyStudy, Repair, UniformRiskStudy};

use crate::error::UpliftError;
use crate::run::check_outputs;

/// What a run tells, by the kind of its study.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum RunReport {
    /// Of a study of uniform risk.
    UniformRisk(Box<uniform_risk::RunReport>),
    /// Of a study of displacement spectra.
    Displacement(displacement::RunReport),
    /// Of a study of a shaking table.
    ShakeTable(shake_table::RunReport),
}

impl RunReport {
    /// What every kind reports.
    pub fn head(&self) -> &RunHead {
        match self {
            Self::UniformRisk(report) => &report.head,
            Self::Displacement(report) => &report.head,
            Self::ShakeTable(report) => &report.head,
        }
    }
}

/// The tables that a run of `study` writes beside its result at `path`.
pub(crate) fn tables(study: &AnyStudy, path: &Path) -> Vec<Output> {
    match study {
        AnyStudy::UniformRisk(study) => uniform_risk::tables(study, path),
        AnyStudy::Displacement(study) => displacement::tables(study, path),
        AnyStudy::ShakeTable(study) => shake_table::tables(study, path),
    }
}

/// The report on the result of `study` where it is there, whole, and all that the study asks of a run; none where the
/// study has to be run.
///
/// # Errors
/// A result that changes while it is read.
pub(crate) fn finished(
    study: &AnyStudy,
    options: &RunOptions,
    start: Instant,
    events: &dyn Events,
) -> Result<Option<RunReport>, UpliftError> {
    let path = options.result_file(&study.output().file);
    let tables: Vec<PathBuf> = tables(study, path).iter().map(|table| table.path().to_owned()).collect();
    // a run tells what is wrong with its inputs; every byte of the file is read only where it is the one
    let is_own = path.is_file() && is_result_of_any(study, path).unwrap_or(false);
    if !is_own || !verify_file(path).is_ok_and(|verdict| verdict.is_sound()) {
        return Ok(None);
    }
    let file = ResultFile::open(path)?;
    if !answers(&file, study)? {
        return Ok(None);
    }
    let (stored, alarms) = (file.head()?, alarms(&file)?);
    if study.title() != stored.title {
        events.note("the result keeps its earlier title; use that of the study: --again");
    }
    if !finish_files(study, options, (&file, &tables), events)? {
        return Ok(None);
    }
    let mut files = vec![path.to_owned()];
    files.extend(tables.into_iter().filter(|table| table.is_file()));
    let (records, seconds) = ((stored.record_set.as_str(), stored.synthetic), start.elapsed().as_secs_f64());
    let head = Provenance::new(options, stored.input_checksums).head(&stored.title, records, alarms, files, seconds);
    let head = RunHead { done_already: true, ..head };
    Ok(match study {
        AnyStudy::UniformRisk(_) => {
            let Overview::UniformRisk { analyses, .. } = file.overview()? else { return Ok(None) };
            let of_measure = |im: &str| analyses.iter().find(|(own, _)| *own == im).map_or(0, |(_, count)| *count);
            let labels = file.measures().into_iter().map(IntensityMeasure::label);
            let measures = labels.map(|im| MeasureReport::stored(im, of_measure(im))).collect();
            Some(RunReport::UniformRisk(Box::new(uniform_risk::RunReport::read(&file, head, measures, None)?)))
        }
        AnyStudy::Displacement(study) => {
            displacement::RunReport::read(&file, study, head)?.map(RunReport::Displacement)
        }
        AnyStudy::ShakeTable(_) => Some(RunReport::ShakeTable(shake_table::RunReport::read(&file, head)?)),
    })
}

/// Does what a run of `study` has left to do that was killed when its result, in `file`, was in place: writes those of
/// its `tables` that are missing, and removes hidden files. False where only another run has their numbers.
fn finish_files(
    study: &AnyStudy,
    options: &RunOptions,
    (file, tables): (&ResultFile, &[PathBuf]),
    events: &dyn Events,
) -> Result<bool, UpliftError> {
    let (path, digest) = (file.path(), file.head()?.study_digest());
    // one of an earlier result was not moved away
    let is_there = |table: &PathBuf| table.is_file() && digest_said(table).is_none_or(|said| said == digest);
    let missing: Vec<&PathBuf> = tables.iter().filter(|table| !is_there(table)).collect();
    if !missing.is_empty() {
        let written: Vec<Table> = match study {
            AnyStudy::UniformRisk(study) if study.sites.is_empty() => Vec::new(),
            AnyStudy::UniformRisk(_) => uniform_risk::csv_tables(file)?,
            AnyStudy::Displacement(study) => displacement::csv_tables(file, study)?,
            AnyStudy::ShakeTable(_) => shake_table::csv_tables(file)?,
        };
        let is_site_table = |path: &PathBuf| written.iter().all(|(own, _)| own != path);
        let of_sites = missing.iter().find(|path| is_site_table(path));
        if let (AnyStudy::UniformRisk(_), Some(table)) = (study, of_sites) {
            events.remark("tables", &format!("{} is missing: its sites are computed again", table.display()));
            return Ok(false);
        }
        check_outputs(study, options)?;
        let _lock = ResultLock::acquire(path)?;
        Earlier::replaced(path, &digest).set_aside(events)?;
        let written = written.into_iter().filter(|(path, _)| missing.contains(&path));
        for table in write_tables(file, written)? {
            events.remark("tables", &format!("{} was missing: written", table.display()));
        }
    }
    for table in tables {
        clear_leftovers(table);
        clear_leftovers(&metadata_path(table));
    }
    clear_leftovers(path);
    clear_checkpoint(study, path);
    Ok(true)
}

/// Removes the checkpoint of the run whose result is at `path`; one that may hold more stays.
fn clear_checkpoint(study: &AnyStudy, path: &Path) {
    let checkpoint = checkpoint_path(path);
    let Some(_lock) = checkpoint.is_file().then(|| ResultLock::acquire(path).ok()).flatten() else { return };
    let cleared = || -> Result<(), StudiesError> {
        match study {
            AnyStudy::UniformRisk(study) => {
                uniform_risk::Inputs::read(study, &Silent)?.work(study, &[])?.clear_checkpoint(&checkpoint);
            }
            AnyStudy::Displacement(study) => {
                displacement::Inputs::read(study, &Silent)?.sets(study)?.work(study)?.clear_checkpoint(&checkpoint);
            }
            AnyStudy::ShakeTable(_) => {}
        }
        Ok(())
    };
    // the inputs have been read before: what has happened to them meanwhile, the next run tells
    let _ = cleared();
}

/// Whether the file at `path` holds the numbers of `study`, computed from the same inputs by the same solver.
fn is_result_of_any(study: &AnyStudy, path: &Path) -> Result<bool, UpliftError> {
    if let AnyStudy::UniformRisk(study) = study {
        return is_result_of(study, path);
    }
    let file = ResultFile::open(path)?;
    let head = file.head()?;
    let is_same = head.numerics == NUMERICS && what_counts(&study.to_toml()?) == what_counts(&head.study_toml);
    Ok(is_same
        && match study {
            AnyStudy::Displacement(study) => displacement::is_of_records(&file, study)?,
            AnyStudy::ShakeTable(study) => shake_table::is_of_inputs(&file, study)?,
            AnyStudy::UniformRisk(_) => false,
        })
}

/// Whether the result in `file`, of the same numbers, holds all that `study` asks of a run: the defaults of a bootstrap
/// of the result are kept in it.
fn answers(file: &ResultFile, study: &AnyStudy) -> Result<bool, UpliftError> {
    let AnyStudy::UniformRisk(study) = study else { return Ok(true) };
    let kept = file.stored_study()?;
    let of_sites = study.consistency.repair == Repair::Weights && !study.sites.is_empty();
    let lacks_repair = of_sites && !file.has_repair();
    // the files of a table of sites are only written by a run
    let other_tables = study.site_table.is_some() && study.consistency.repair != kept.consistency.repair;
    let same_question = study.consistency.differing_keys(&kept.consistency).is_empty();
    Ok(study.bootstrap == kept.bootstrap && same_question && !lacks_repair && !other_tables)
}

/// Whether the file at `path` holds the stripes and spectra of `study`, made of the same records and hazard curves.
pub(crate) fn is_result_of(study: &UniformRiskStudy, path: &Path) -> Result<bool, UpliftError> {
    let Ok(file) = ResultFile::open(path) else { return Ok(false) };
    if file.kind() != Kind::UniformRisk {
        return Ok(false);
    }
    let head = file.head()?;
    let own = study.to_toml()?;
    let (Some(own), Some(kept)) = (what_counts(&own), what_counts(&head.study_toml)) else { return Ok(false) };
    if own != kept {
        return Ok(false);
    }
    let (hazard, _) = read_hazard(study)?;
    let records = read_records(study, &Silent)?;
    let (other_hazard, _) = read_other_hazard(study)?;
    let mut checksums = input_checksums(&records, &hazard, &other_hazard);
    checksums.extend(site_table_checksums(study)?);
    if head.input_checksums != checksums {
        return Ok(false);
    }
    Ok(uniform_risk::is_of_records(&file, study, &records.records).unwrap_or(false))
}
