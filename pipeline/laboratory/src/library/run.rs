//! A library computed and written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use uplift_alarms::study_alarms;
use uplift_fragility::{PELICUN_COLUMN, nrml_model, pelicun_table};
use uplift_inputs::{RecordSets, read_sets};
use uplift_job::alarm::Alarm;
use uplift_job::events::{Events, Progress};
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{text_columns, write_atomically, write_table};
use uplift_study::LibraryStudy;

use super::compute::{Motions, SystemReport, measures, system_report};
use super::fragilities::functions;
use super::systems::systems;
use super::tables::{TABLES, tables};
use crate::error::LaboratoryError;

/// The fragilities for `OpenQuake` and for pelicun, beside the tables.
const NRML: &str = "fragility.xml";
const PELICUN: &str = "pelicun.csv";

/// Where the tables of a library go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LibraryOptions {
    /// Folder for tables and fragilities; none for no files.
    pub folder: Option<PathBuf>,
    /// Whether existing files are overwritten.
    pub force: bool,
}

/// A library of rocking response.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LibraryReport {
    /// Free text of the file.
    pub title: String,
    /// The records, in a line.
    pub record_set: String,
    /// Whether they were made by the program.
    pub synthetic: bool,
    /// Motions, two a record.
    pub motions: usize,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// The systems.
    pub systems: Vec<SystemReport>,
    /// What to know before the numbers are used.
    pub alarms: Vec<Alarm>,
    /// Acceleration of gravity, m/s².
    pub gravity_m_s2: f64,
    /// What is to be known of the inputs.
    pub notes: Vec<String>,
    /// The files written.
    pub files: Vec<PathBuf>,
}

/// Shakes every block and oscillator of `study` by every motion at every level, and writes what they do as tables
/// and as fragilities for `OpenQuake` and pelicun.
///
/// # Errors
/// Records that cannot be used; a system that cannot be followed; files that would overwrite something else, or cannot
/// be written; an interruption.
pub fn library(
    study: &LibraryStudy,
    options: &LibraryOptions,
    events: &dyn Events,
) -> Result<LibraryReport, LaboratoryError> {
    if let Some(folder) = &options.folder {
        let table = |(name, column)| Output::new(folder.join(name), OutputKind::Table(column));
        let mut outputs = TABLES.map(table).to_vec();
        outputs.push(Output::new(folder.join(NRML), OutputKind::Nrml));
        outputs.push(table((PELICUN, PELICUN_COLUMN)));
        outputs::check(&outputs, &study.inputs(), options.force)?;
    }
    let systems = systems(study)?;
    let records = read_sets(&study.records, &[], study.gravity_m_s2, events)?;
    events.remark("records", &records.description);
    let sets = records.motions(study.gravity_m_s2)?;
    // without plans there is one set
    let all = sets.first().map_or(&[][..], |set| set.motions());
    let motions = Motions { all, units: units(&records), gravity_m_s2: study.gravity_m_s2 };
    let levels = [&study.pga_levels[..], &study.pgv_levels[..]];
    let of_system = |of| all.len() * measures(of, levels).iter().map(|(_, levels)| levels.len()).sum::<usize>();
    let analyses: u64 = systems.iter().map(|of| of_system(of) as u64).sum();
    let progress = Progress::begin(events, "library", "analyses", analyses);
    let reports: Result<Vec<SystemReport>, _> =
        systems.iter().map(|of| system_report(of, &motions, levels, &progress)).collect();
    drop(progress);
    let mut report = LibraryReport {
        title: study.title.clone(),
        record_set: records.description.clone(),
        synthetic: records.synthetic,
        motions: all.len(),
        analyses,
        systems: reports?,
        alarms: study_alarms(&[], records.synthetic).collect(),
        gravity_m_s2: study.gravity_m_s2,
        notes: records.notes.clone(),
        files: Vec::new(),
    };
    if let Some(folder) = &options.folder {
        events.writing_into(folder);
        report.files = write(&report, folder)?;
    }
    Ok(report)
}

/// Positions of the motions of each earthquake; of each record where its earthquake is not known, or is none.
fn units(records: &RecordSets) -> Vec<Vec<usize>> {
    let mut places = BTreeMap::<&str, usize>::new();
    let mut units: Vec<Vec<usize>> = Vec::new();
    for (place, record) in records.sets.iter().flat_map(|set| records.records_of(set)).enumerate() {
        let event = record.pair.metadata.get("event").map_or("", |event| event.trim());
        let is_known = !(event.is_empty() || event.starts_with("synthetic"));
        let unit = if is_known { *places.entry(event).or_insert(units.len()) } else { units.len() };
        if unit == units.len() {
            units.push(Vec::new());
        }
        units[unit].extend([2 * place, 2 * place + 1]);
    }
    units
}

fn write(report: &LibraryReport, folder: &Path) -> Result<Vec<PathBuf>, LaboratoryError> {
    let line = format!(
        "uplift {} ({}); library of rocking response: {}; overturned = inf",
        uplift_job::VERSION,
        uplift_job::COMMIT,
        report.record_set
    );
    let mut files = Vec::new();
    for ((name, _), columns) in TABLES.into_iter().zip(tables(&report.systems)) {
        let file = folder.join(name);
        write_table(&file, &line, columns)?;
        files.push(file);
    }
    let functions = functions(&report.systems, report.gravity_m_s2);
    let file = folder.join(NRML);
    // the fits that are missing are in the table of fits
    let (text, _) = nrml_model(&functions, &line);
    write_atomically(&file, text.as_bytes())?;
    files.push(file);
    let file = folder.join(PELICUN);
    write_table(&file, &line, text_columns(pelicun_table(&functions).0))?;
    files.push(file);
    Ok(files)
}
