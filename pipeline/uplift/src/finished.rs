//! A study whose result is there, whole and its own: nothing is left to run.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;
use uplift_alarms::alarms;
use uplift_ida::NUMERICS;
use uplift_inputs::{input_checksums, read_hazard, read_other_hazard, read_records, site_table_checksums};
use uplift_job::events::{Events, Silent};
use uplift_job::outputs::Output;
use uplift_job::study_run::{RunHead, RunOptions};
use uplift_labelled::verify as verify_file;
use uplift_motion::IntensityMeasure;
use uplift_result::{Kind, Overview, Provenance, ResultFile, what_counts};
use uplift_studies::uniform_risk::MeasureReport;
use uplift_studies::{displacement, shake_table, uniform_risk};
use uplift_study::{AnyStudy, Repair, UniformRiskStudy};

use crate::error::UpliftError;

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
    let (tables, missing): (Vec<_>, Vec<_>) = tables.into_iter().partition(|table| table.is_file());
    for table in missing {
        events.note(&format!("{} is missing; --again writes it", table.display()));
    }
    let mut files = vec![path.to_owned()];
    files.extend(tables);
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
