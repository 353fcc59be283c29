//! Tables beside a result file, for spreadsheets and scripts.

use std::borrow::Cow;
use std::path::Path;

use polars::prelude::{Column, DataFrame, DataType, IntoColumn, NamedFrom, PlSmallStr, Series, StringChunked};
use polars_io::prelude::{CsvWriter, SerWriter};
use uplift_atomic_file::write_whole;

use crate::error::JobError;
use crate::outputs::{metadata_path, metadata_text};
use crate::text::one_line;

/// A table in the making: columns with a cell for each of its rows.
pub struct ColumnsOf<R> {
    rows: Vec<R>,
    columns: Vec<Column>,
}

impl<R: Copy> ColumnsOf<R> {
    /// A table of `rows`, without columns.
    pub fn new(rows: impl IntoIterator<Item = R>) -> Self {
        Self { rows: rows.into_iter().collect(), columns: Vec::new() }
    }

    /// One more column: the `cell` of each row.
    #[must_use]
    pub fn with<C, A: ?Sized>(mut self, name: impl Into<PlSmallStr>, cell: impl FnMut(R) -> C) -> Self
    where
        Series: NamedFrom<Vec<C>, A>,
    {
        let cells: Vec<C> = self.rows.iter().copied().map(cell).collect();
        self.columns.push(Column::new(name.into(), cells));
        self
    }

    /// One more column for each of `items`.
    #[must_use]
    pub fn each<I>(self, items: impl IntoIterator<Item = I>, more: impl FnMut(Self, I) -> Self) -> Self {
        items.into_iter().fold(self, more)
    }

    /// The columns.
    pub fn build(self) -> Vec<Column> {
        self.columns
    }
}

/// Write a table, and beside it what `line` says of it ([`metadata_path`]); each whole or not at all.
///
/// # Errors
/// A file that cannot be written; an earlier one is then as it was.
pub fn write_table(path: &Path, line: &str, columns: Vec<Column>) -> Result<(), JobError> {
    let names: Vec<String> = columns.iter().map(|column| column.name().to_string()).collect();
    let table = table_text(path, "", columns)?;
    // first, since a table without it is nobody's
    write_metadata(path, line, names.iter().map(String::as_str))?;
    write_atomically(path, &table).inspect_err(|_| {
        if !path.exists() {
            // of no table, if it cannot be taken away either
            let _ = std::fs::remove_file(metadata_path(path));
        }
    })
}

/// Columns of texts, each with its name.
pub fn text_columns(columns: Vec<(String, Vec<String>)>) -> Vec<Column> {
    columns.into_iter().map(|(name, cells)| Column::new(name.into(), cells)).collect()
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

/// `text` as a cell that a spreadsheet shows and does not compute: an apostrophe goes before what it would take for a
/// formula, and what a terminal obeys is spelt out. A number stays a number.
pub fn neutral(text: &str) -> Cow<'_, str> {
    let text = one_line(text);
    if begins_formula(&text) && text.trim().parse::<f64>().is_err() { Cow::Owned(format!("'{text}")) } else { text }
}

/// The text of a cell that [`neutral`] made.
pub fn plain(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|text| begins_formula(text)).unwrap_or(cell)
}

fn begins_formula(text: &str) -> bool {
    text.starts_with(['=', '+', '-', '@', '\t', '\r'])
}

/// A column with its name and texts [`neutral`]; one of numbers as it is.
fn neutral_column(mut column: Column) -> Column {
    if *column.dtype() == DataType::String
        && let Ok(texts) = column.str()
        && texts.iter().flatten().any(|text| matches!(neutral(text), Cow::Owned(_)))
    {
        let texts: StringChunked = texts.iter().map(|text| text.map(neutral)).collect();
        column = texts.with_name(column.name().clone()).into_column();
    }
    let name = neutral(column.name()).into_owned();
    column.rename(name.into());
    column
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_cell_commands_a_terminal() {
        let columns = vec![Column::new("a\u{202e}b".into(), ["c\u{9b}2J\u{2066}", "=\u{1b}[2J", "d, \"e\""])];
        let text = String::from_utf8(table_text(Path::new("t.csv"), "", columns).unwrap()).unwrap();
        assert_eq!(text, "a\\u{202e}b\nc\\u{9b}2J\\u{2066}\n'=\\u{1b}[2J\n\"d, \"\"e\"\"\"\n");
    }

    #[test]
    fn formulas_are_texts_and_come_back() {
        for text in ["=HYPERLINK(\"x\")", "+1+1", "-2-3", "@SUM(A1)", "\tx", "\rx", "'=1", "-", "a=b", "'quoted", ""] {
            let cell = neutral(text);
            assert!(!cell.starts_with(['=', '+', '-', '@', '\t', '\r']), "{text:?}: {cell:?}");
            assert_eq!(plain(&cell), if text == "'=1" { "=1".into() } else { one_line(text) });
        }
        for number in ["-1.5e3", "+2", "-inf", "0.1"] {
            assert_eq!(neutral(number), number);
        }
    }
}
