//! Which records are played: those of a table, or all.

use std::path::Path;

use uplift_inputs::{RecordSets, SetRecord, is_numbered};
use uplift_job::{JobError, ReferenceTable};

use crate::error::StudiesError;

/// Columns that say which record is played.
const RECORDS: [&str; 2] = ["rsn", "record_id"];
/// The class of excitations that have none.
const ALL: &str = "all";
/// Excitations that a note names.
const TOLD: usize = 10;

/// An excitation: what it is called, its class, and the position of its record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Chosen {
    pub(super) exc_id: String,
    pub(super) class: String,
    pub(super) record: usize,
}

/// Every record.
pub(super) fn all(records: &RecordSets) -> Result<Vec<Chosen>, StudiesError> {
    let chosen = |(record, found): (usize, &SetRecord)| Chosen {
        exc_id: found.pair.metadata.get("exc_id").cloned().unwrap_or_else(|| found.pair.id.clone()),
        class: found.pair.metadata.get("class").cloned().unwrap_or_else(|| ALL.to_owned()),
        record,
    };
    let all: Vec<Chosen> = records.records.iter().enumerate().map(chosen).collect();
    let mut ids: Vec<&str> = all.iter().map(|chosen| chosen.exc_id.as_str()).collect();
    ids.sort_unstable();
    let twice: Vec<String> = ids
        .windows(2)
        .filter(|pair| pair[0] == pair[1])
        .map(|pair| format!("excitation {} is twice in the column exc_id of the manifest", pair[0]))
        .collect();
    if twice.is_empty() { Ok(all) } else { Err(JobError::Inputs(twice).into()) }
}

/// The records that the table at `path` names, and what to say of those that are not there.
///
/// # Errors
/// A table without its columns, or with an excitation twice; one of which no record is there.
pub(super) fn read_table(path: &Path, records: &RecordSets) -> Result<(Vec<Chosen>, Option<String>), StudiesError> {
    let table = ReferenceTable::read_as("excitations", path)?;
    let Some(by) = RECORDS.into_iter().find(|name| table.has(name)).filter(|_| table.has("exc_id")) else {
        return Err(table
            .fail(format!(
                "it needs the columns exc_id, and {}; class if there are several. It has {}",
                RECORDS.join(" or "),
                table.columns().join(", ")
            ))
            .into());
    };
    let (mut chosen, mut missing, mut mistakes): (Vec<Chosen>, Vec<String>, Vec<String>) = Default::default();
    for row in 0..table.rows() {
        let (exc_id, record) = (table.text("exc_id", row), table.text(by, row));
        let class = Some(table.text("class", row)).filter(|class| !class.is_empty());
        if exc_id.is_empty() || record.is_empty() {
            mistakes.push(format!("{}, row {}: exc_id or {by} is blank", path.display(), row + 1));
        } else if chosen.iter().any(|before| before.exc_id == exc_id) || missing.contains(&exc_id) {
            mistakes.push(format!("{}, row {}: excitation {exc_id} is listed twice", path.display(), row + 1));
        } else if let Some(record) = records.records.iter().position(|found| is_numbered(found, &record)) {
            chosen.push(Chosen { exc_id, class: class.unwrap_or_else(|| ALL.to_owned()), record });
        } else {
            missing.push(exc_id);
        }
    }
    if !mistakes.is_empty() {
        return Err(JobError::Inputs(mistakes).into());
    }
    if chosen.is_empty() {
        return Err(table
            .fail("none of its records is among those of the study: give them by records.manifest")
            .into());
    }
    let note = (!missing.is_empty()).then(|| {
        let more = if missing.len() > TOLD { ", …" } else { "" };
        let first = missing[..missing.len().min(TOLD)].join(", ");
        format!(
            "{} excitations of {} are not played: the records have not got {first}{more}",
            missing.len(),
            table.rows()
        )
    });
    Ok((chosen, note))
}
