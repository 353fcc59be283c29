//! The kinds of study, each from its plan to its result file, with the same files in its folder.

pub mod displacement;
mod error;
pub mod shake_table;
pub mod uniform_risk;

use std::path::{Path, PathBuf};

pub use error::StudiesError;
use polars::prelude::Column;
use uplift_job::events::Events;
use uplift_job::table::write_table;
use uplift_result::ResultFile;

/// A table beside a result: its place, and its columns.
pub type Table = (PathBuf, Vec<Column>);

/// Writes `tables` of the result in `file`, and beside each where it comes from; their places.
///
/// They are made of the file alone, so that a run that was killed before them is finished from it.
///
/// # Errors
/// A file that cannot be written.
pub fn write_tables(file: &ResultFile, tables: impl IntoIterator<Item = Table>) -> Result<Vec<PathBuf>, StudiesError> {
    let line = file.line()?;
    let write = |(path, columns): Table| {
        write_table(&path, &line, columns)?;
        Ok(path)
    };
    tables.into_iter().map(write).collect()
}

/// Says, where the tables beside the result at `path` cannot be written, that nothing is lost.
pub(crate) fn complete_result<'a, E>(path: &'a Path, events: &'a dyn Events) -> impl FnOnce(&E) + 'a {
    |_| events.note(&format!("{} is complete: only the tables beside it are missing", path.display()))
}
