//! Pairs of components from the files of a manifest.

use std::path::Path;

use rayon::prelude::*;
use uplift_job::JobError;
use uplift_job::checksum::checksum;
use uplift_job::events::Events;
use uplift_motion::{ReadOptions, RecordPair, Recording, read_record, record_bytes};

use super::manifest::{ComponentFile, Row};

/// A pair with the SHA-256 of what each component was read from.
pub type CheckedPair = (RecordPair, [String; 2]);

/// Key in the metadata of a pair: by how many seconds its components begin apart, where their files say so.
pub const START_APART: &str = "start_apart_s";

/// Key in the metadata of a pair: when its first component begins, s, where its file says so.
pub(super) const START: &str = "start_s";

/// Reads the pairs of `rows`, in their order; values in g are converted with `gravity_m_s2`.
///
/// # Errors
/// Everything that is wrong with the files, a line each; [`JobError::Interrupted`] where `events` say so.
pub fn read(rows: Vec<Row>, gravity_m_s2: f64, events: &dyn Events) -> Result<Vec<CheckedPair>, JobError> {
    let read: Option<Vec<Result<CheckedPair, Vec<String>>>> =
        rows.into_par_iter().map(|row| (!events.cancelled()).then(|| read_row(row, gravity_m_s2))).collect();
    let read = read.ok_or(JobError::Interrupted)?;
    let mut pairs = Vec::new();
    let mut mistakes = Vec::new();
    for outcome in read {
        match outcome {
            Ok(pair) => pairs.push(pair),
            Err(found) => mistakes.extend(found),
        }
    }
    if mistakes.is_empty() { Ok(pairs) } else { Err(JobError::Inputs(mistakes)) }
}

fn read_row(row: Row, gravity_m_s2: f64) -> Result<CheckedPair, Vec<String>> {
    let component = |file: &ComponentFile| {
        let options =
            ReadOptions { format: row.format, channel: file.channel, dt_s: row.dt_s, unit: row.unit, gravity_m_s2 };
        read_component(file, &options).map_err(|reason| format!("record {}: {reason}", row.id))
    };
    match (component(&row.components[0]), component(&row.components[1])) {
        (Ok((one, sum1)), Ok((other, sum2))) => {
            let mut metadata = row.metadata;
            if let Some(start_s) = one.description.start_time_s {
                metadata.insert(START.to_owned(), start_s.to_string());
            }
            if let (Some(start_s), Some(other_s)) = (one.description.start_time_s, other.description.start_time_s)
                && (start_s - other_s).abs() > 0.5 * one.accelerogram.dt_s()
            {
                metadata.insert(START_APART.to_owned(), format!("{:.3}", (start_s - other_s).abs()));
            }
            Ok((RecordPair { id: row.id, h1: one.accelerogram, h2: other.accelerogram, metadata }, [sum1, sum2]))
        }
        (one, other) => Err([one.err(), other.err()].into_iter().flatten().collect()),
    }
}

/// Reads the component that a row of a manifest names, with the SHA-256 of its file.
///
/// # Errors
/// In words: a file that is missing, cannot be read, or is not the one that the manifest was made from.
pub(crate) fn read_component(file: &ComponentFile, options: &ReadOptions) -> Result<(Recording, String), String> {
    let path: &Path = &file.path;
    let bytes = record_bytes(path).map_err(|error| error.to_string())?;
    let sum = checksum(&bytes);
    if file.sha256.as_ref().is_some_and(|known| !known.eq_ignore_ascii_case(&sum)) {
        return Err(format!(
            "{} has changed since the import (SHA-256): restore it, or import the records again",
            path.display()
        ));
    }
    let name = path.display().to_string();
    let recording = read_record(&bytes, &name, options)
        .and_then(|file| file.component(&name, options.channel))
        .map_err(|error| error.to_string())?;
    Ok((recording, sum))
}
