//! Pairs of components from the files of a manifest.

use std::path::Path;

use rayon::prelude::*;
use uplift_motion::{Accelerogram, ReadOptions, RecordPair, read_auto, record_bytes};

use super::checksum;
use super::manifest::{ComponentFile, Row};

/// A pair with the SHA-256 of what each component was read from.
pub(crate) type CheckedPair = (RecordPair, [String; 2]);

/// Reads the pairs of `rows`, in their order; values in g are converted with `gravity_m_s2`.
///
/// # Errors
/// Everything that is wrong with the files, a line each.
pub(crate) fn read(rows: Vec<Row>, gravity_m_s2: f64) -> Result<Vec<CheckedPair>, Vec<String>> {
    let read: Vec<Result<CheckedPair, Vec<String>>> =
        rows.into_par_iter().map(|row| read_row(row, gravity_m_s2)).collect();
    let mut pairs = Vec::new();
    let mut mistakes = Vec::new();
    for outcome in read {
        match outcome {
            Ok(pair) => pairs.push(pair),
            Err(found) => mistakes.extend(found),
        }
    }
    if mistakes.is_empty() { Ok(pairs) } else { Err(mistakes) }
}

fn read_row(row: Row, gravity_m_s2: f64) -> Result<CheckedPair, Vec<String>> {
    let component = |file: &ComponentFile| {
        let options =
            ReadOptions { format: row.format, channel: file.channel, dt_s: row.dt_s, unit: row.unit, gravity_m_s2 };
        read_component(file, &options).map_err(|reason| format!("record {}: {reason}", row.id))
    };
    match (component(&row.components[0]), component(&row.components[1])) {
        (Ok((h1, sum1)), Ok((h2, sum2))) => {
            Ok((RecordPair { id: row.id, h1, h2, metadata: row.metadata }, [sum1, sum2]))
        }
        (one, other) => Err([one.err(), other.err()].into_iter().flatten().collect()),
    }
}

fn read_component(file: &ComponentFile, options: &ReadOptions) -> Result<(Accelerogram, String), String> {
    let path: &Path = &file.path;
    let bytes = record_bytes(path).map_err(|error| error.to_string())?;
    let sum = checksum(&bytes);
    if file.sha256.as_ref().is_some_and(|known| !known.eq_ignore_ascii_case(&sum)) {
        return Err(format!(
            "{} is not the file that the manifest was made from, its SHA-256 is another: put that file back, or import the records again",
            path.display()
        ));
    }
    let accelerogram = read_auto(&bytes, &path.display().to_string(), options).map_err(|error| error.to_string())?;
    Ok((accelerogram, sum))
}
