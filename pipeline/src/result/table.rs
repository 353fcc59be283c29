//! Tables beside a result file, for spreadsheets and scripts.

mod cells;

use std::path::Path;

use polars::prelude::{Column, DataFrame};
use polars_io::prelude::{CsvWriter, SerWriter};
use uplift_atomic_file::write_whole;

use crate::error::UpliftError;
use crate::text::one_line;
use cells::neutral_column;
pub(crate) use cells::{neutral, plain};

/// Write a comment line and a table, whole or not at all.
///
/// # Errors
/// A file that cannot be written; an earlier one is then as it was.
pub fn write_table(path: &Path, line: &str, columns: Vec<Column>) -> Result<(), UpliftError> {
    write_atomically(path, &table_text(path, line, columns)?)
}

/// The same as it is to be written to `path`. Texts that a spreadsheet would compute have an apostrophe before them.
///
/// # Errors
/// Columns that make no table.
pub(crate) fn table_text(path: &Path, line: &str, columns: Vec<Column>) -> Result<Vec<u8>, UpliftError> {
    let fail = |reason: String| UpliftError::input(format!("{} cannot be written: {reason}", path.display()));
    let mut content = Vec::new();
    if !line.is_empty() {
        content.extend_from_slice(format!("# {}\n", one_line(line)).as_bytes());
    }
    DataFrame::new_infer_height(columns.into_iter().map(neutral_column).collect())
        .and_then(|mut table| CsvWriter::new(&mut content).finish(&mut table))
        .map_err(|error| fail(error.to_string()))?;
    Ok(content)
}

/// Write a file, whole or not at all.
///
/// # Errors
/// A file that cannot be written; an earlier one is then as it was.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), UpliftError> {
    Ok(write_whole(path, content)?)
}
