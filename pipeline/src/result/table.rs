//! Tables beside a result file, for spreadsheets and scripts.

use std::path::Path;

use polars::prelude::{Column, CsvWriter, DataFrame, SerWriter};
use uplift_atomic_file::write_whole;

use crate::error::UpliftError;

/// Write a comment line and a table, whole or not at all.
///
/// # Errors
/// A file that cannot be written; an earlier one is then as it was.
pub fn write_table(path: &Path, line: &str, columns: Vec<Column>) -> Result<(), UpliftError> {
    let fail = |reason: String| UpliftError::input(format!("{} cannot be written: {reason}", path.display()));
    let mut content = Vec::new();
    if !line.is_empty() {
        content.extend_from_slice(format!("# {line}\n").as_bytes());
    }
    DataFrame::new_infer_height(columns)
        .and_then(|mut table| CsvWriter::new(&mut content).finish(&mut table))
        .map_err(|error| fail(error.to_string()))?;
    write_atomically(path, &content)
}

/// Write a file, whole or not at all.
///
/// # Errors
/// A file that cannot be written; an earlier one is then as it was.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), UpliftError> {
    Ok(write_whole(path, content)?)
}
