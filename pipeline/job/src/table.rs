//! Tables beside a result file, for spreadsheets and scripts.

pub mod cells;

use std::path::Path;

use polars::prelude::{Column, DataFrame};
use polars_io::prelude::{CsvWriter, SerWriter};
use uplift_atomic_file::write_whole;

use crate::error::JobError;
use crate::outputs::{metadata_path, metadata_text};
use crate::text::one_line;
use cells::neutral_column;
pub use cells::{neutral, plain};

/// Write a table, and beside it what `line` says of it ([`metadata_path`]); each whole or not at all.
///
/// # Errors
/// A file that cannot be written; an earlier one is then as it was.
pub fn write_table(path: &Path, line: &str, columns: Vec<Column>) -> Result<(), JobError> {
    let names: Vec<String> = columns.iter().map(|column| column.name().to_string()).collect();
    let table = table_text(path, "", columns)?;
    // first, since a table without it is nobody's
    write_metadata(path, line, names.iter().map(String::as_str))?;
    write_atomically(path, &table)
}

/// Write what stands beside the table at `path`: `line`, where its numbers come from, and the names of its columns.
///
/// # Errors
/// A file that cannot be written; an earlier one is then as it was.
pub fn write_metadata<'a>(path: &Path, line: &str, columns: impl Iterator<Item = &'a str>) -> Result<(), JobError> {
    write_atomically(&metadata_path(path), metadata_text(path, line, columns).as_bytes())
}

/// A table as it is to be written to `path`, behind a comment of one `line` unless that is empty. Texts that a
/// spreadsheet would compute have an apostrophe before them.
///
/// # Errors
/// Columns that make no table.
pub fn table_text(path: &Path, line: &str, columns: Vec<Column>) -> Result<Vec<u8>, JobError> {
    let fail = |reason: String| JobError::input(format!("{} cannot be written: {reason}", path.display()));
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
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), JobError> {
    Ok(write_whole(path, content)?)
}
