//! The structures that were analysed under a result, a block each: the structure to scale, and every stored answer.

use std::collections::BTreeSet;
use std::path::Path;

use minijinja::Value;
use serde::Serialize;
use uplift::UpliftError;
use uplift::alarms::{Alarm, name_result};
use uplift::result::{FindingRow, ResultFile, StoredFinding};
use uplift::structure::StructureReport;
use uplift::study::Structure;
use uplift::text::Table;

use super::TitledTable;
use crate::sheet::{bands, elevation, facts};

/// A structure, and the answers to what it was asked.
#[derive(Debug, Serialize)]
pub(super) struct AskedStructure {
    name: String,
    /// A sentence on its file.
    note: String,
    /// Empty where its file is of another version of the program.
    drawing: String,
    facts: Vec<(&'static str, String)>,
    /// What to know before the answers are used, but for what the page says of the result.
    alarms: Vec<Value>,
    answers: Vec<Answer>,
}

/// What one question was answered.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    table: TitledTable,
    /// Drawings of the numbers with bands.
    bands: Vec<String>,
}

/// The structures that were asked something under `result`, of which the page says `known` already. Commands name it
/// as it is `typed`.
///
/// # Errors
/// A file that is damaged.
pub(super) fn structures(
    result: &ResultFile,
    known: &[Alarm],
    typed: &str,
) -> Result<Vec<AskedStructure>, UpliftError> {
    let mut findings = result.findings()?;
    // a structure whose file has changed is another
    findings.sort_by(|a, b| file_of(a).cmp(&file_of(b)));
    let of_structure = findings.chunk_by(|a, b| file_of(a) == file_of(b));
    Ok(of_structure.enumerate().map(|(index, answers)| asked(index + 1, answers, (known, typed))).collect())
}

/// Whose answers stand together, those of a file as it was before last.
fn file_of(of: &StoredFinding) -> (&str, bool, String) {
    (&of.finding.structure, of.is_of_earlier_file, of.finding.structure_sha256())
}

fn asked(number: usize, answers: &[StoredFinding], (known, typed): (&[Alarm], &str)) -> AskedStructure {
    let first = &answers[0].finding;
    let structure = Structure::parse(Path::new(&first.structure_file), first.structure_toml.clone()).ok();
    let facts =
        structure.as_ref().map(|own| facts(own, &StructureReport::from_structure(own, own.description.restitution)));
    let before = ", since changed: these are answers for the earlier file";
    let mut said: BTreeSet<String> = known.iter().map(|alarm| alarm.what.clone()).collect();
    let alarms = answers.iter().flat_map(|of| of.finding.alarms());
    let alarms = alarms.filter(|alarm| alarm["what"].as_str().is_some_and(|what| said.insert(what.to_owned())));
    let named = |mut alarm| {
        name_result(&mut alarm, typed);
        Value::from_serialize(alarm)
    };
    AskedStructure {
        name: first.structure.clone(),
        note: format!("File {}{}.", first.structure_file, if answers[0].is_of_earlier_file { before } else { "" }),
        drawing: structure.as_ref().map_or_else(String::new, |own| elevation(&own.description)),
        facts: facts.unwrap_or_default(),
        alarms: alarms.map(named).collect(),
        answers: answers
            .iter()
            .enumerate()
            .map(|(index, of)| Answer { table: table([number, index + 1], of), bands: bands(&of.finding.rows) })
            .collect(),
    }
}

fn table([structure, answer]: [usize; 2], of: &StoredFinding) -> TitledTable {
    let all = &of.finding.rows;
    let differ = |part: fn(&FindingRow) -> &String| {
        let mut found = all.iter().map(part).filter(|text| !text.is_empty());
        let first = found.next();
        found.any(|text| Some(text) != first)
    };
    let bands = all.iter().map(|row| &row.band).find(|band| !band.is_empty());
    let heading = bands.filter(|_| !differ(|row| &row.band)).map(|band| format!("90 % band of {band}"));
    let is_one = heading.is_some();
    let rows = Table::from_rows(all)
        .left("quantity", |row| &row.quantity)
        .when(differ(|row| &row.site), |table| table.left("site", |row| &row.site))
        .when(differ(|row| &row.im), |table| table.left("measure", |row| &row.im))
        .right("value", FindingRow::shown)
        .right(heading.unwrap_or_else(|| "90 % band".to_owned()), FindingRow::band_shown)
        .right("unit", |row| if row.unit == "1" { "" } else { &row.unit })
        .when(!is_one, |table| table.right("band of", |row| &row.band));
    let note = format!("Computed {} by uplift {} ({}).", of.created, of.version, of.commit);
    TitledTable::new(&format!("structure-{structure}-{answer}"), of.finding.question(), note, rows)
}
