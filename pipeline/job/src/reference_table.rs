//! A table of a paper to compare with: a CSV file with a header row.

use std::path::Path;

use polars::prelude::{Column, DataFrame, DataType};
use uplift_atomic_file::read_file;

use crate::error::JobError;
use crate::table::plain;
use crate::text_table;

/// The most that a table of a paper has, and then some.
const LARGEST_BYTES: u64 = 64 << 20;

/// A reference table, its cells as text.
#[derive(Debug)]
pub struct ReferenceTable {
    name: String,
    frame: DataFrame,
}

impl ReferenceTable {
    /// Reads the table at `path`; lines that begin with `#` are comments.
    ///
    /// # Errors
    /// A file that cannot be read, or is not CSV with a header row.
    pub fn read(path: &Path) -> Result<Self, JobError> {
        Self::read_as("reference", path)
    }

    /// The same of another table that a user brings, `what` in messages.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_as(what: &str, path: &Path) -> Result<Self, JobError> {
        let name = format!("{what} {}", path.display());
        let fail = |reason: String| JobError::input(format!("{name}: {reason}"));
        let bytes = read_file(path, LARGEST_BYTES).map_err(|error| JobError::input(format!("{what} {error}")))?;
        let frame = text_table::parse(&bytes, &[]).map_err(fail)?;
        Ok(Self { name, frame })
    }

    /// The table of these `columns`, every cell as text; `name` in messages.
    ///
    /// # Errors
    /// Columns that make no table.
    pub fn from_columns(name: String, columns: Vec<Column>) -> Result<Self, JobError> {
        let frame = columns
            .into_iter()
            .map(|column| column.cast(&DataType::String))
            .collect::<Result<Vec<_>, _>>()
            .and_then(DataFrame::new_infer_height)
            .map_err(|error| JobError::input(format!("{name}: {error}")))?;
        Ok(Self { name, frame })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.frame.height()
    }

    /// Names of its columns.
    pub fn columns(&self) -> Vec<String> {
        self.frame.get_column_names().iter().map(ToString::to_string).collect()
    }

    /// Whether there is such a column.
    pub fn has(&self, column: &str) -> bool {
        self.frame.get_column_index(column).is_some()
    }

    /// A cell, empty where there is none.
    pub fn text(&self, column: &str, row: usize) -> String {
        let cell = self.frame.column(column).ok().and_then(|column| column.str().ok()?.get(row).map(str::to_owned));
        plain(cell.unwrap_or_default().trim()).to_owned()
    }

    /// A cell as a number.
    ///
    /// # Errors
    /// A cell that is not one, or is not there.
    pub fn number<T: std::str::FromStr>(&self, column: &str, row: usize) -> Result<T, JobError> {
        let cell = self.text(column, row);
        cell.parse().map_err(|_| self.fail(format!("row {}, {column}: {cell:?} is not a number", row + 1)))
    }

    /// What is wrong with the table.
    pub fn fail(&self, reason: impl std::fmt::Display) -> JobError {
        JobError::input(format!("{}: {reason}", self.name))
    }
}
