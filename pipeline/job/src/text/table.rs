//! Tables as the terminal and the page show them.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

/// Columns with headings, and rows with a cell for each; as text, the lines of a table for the terminal.
#[derive(Clone, Debug, Serialize)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<String>>,
}

/// What a column shows above its cells, and how these stand below it.
#[derive(Clone, Debug, Serialize)]
struct Column {
    heading: String,
    alignment: Alignment,
    /// Whether the terminal parts the column from the one before it by a bar.
    bar: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Alignment {
    Left,
    Right,
}

impl Table {
    /// A table of finished cells: the first column to the left, the others to the right.
    pub fn new<H: Into<String>>(
        headings: impl IntoIterator<Item = H>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        let column = |heading: H| Column { heading: heading.into(), alignment: Alignment::Right, bar: false };
        let columns = headings.into_iter().map(column).collect();
        Self { columns, rows: rows.into_iter().collect() }.with_left(1)
    }

    /// The first `number` columns to the left.
    #[must_use]
    pub fn with_left(mut self, number: usize) -> Self {
        self.columns.iter_mut().take(number).for_each(|column| column.alignment = Alignment::Left);
        self
    }

    /// A table with a row for each of `values`, to which columns are added.
    pub fn from_rows<T: Copy>(values: impl IntoIterator<Item = T>) -> TableOf<T> {
        let values: Vec<T> = values.into_iter().collect();
        TableOf { table: Self { columns: Vec::new(), rows: vec![Vec::new(); values.len()] }, values }
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}

impl Display for Table {
    /// Columns two blanks apart, a rule below the headings, no blanks at the end of a line.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let headings: Vec<String> = self.columns.iter().map(|column| column.heading.clone()).collect();
        let lines = || std::iter::once(&headings).chain(&self.rows);
        let width = |at: usize| lines().map(|cells| cells[at].chars().count()).max().unwrap_or_default();
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let bars = self.columns.iter().filter(|column| column.bar).count();
        let rule = widths.iter().sum::<usize>() + 2 * (bars + widths.len().saturating_sub(1));
        for (index, cells) in lines().enumerate() {
            let padded = self.columns.iter().zip(cells).zip(&widths).map(|((column, cell), &width)| {
                let bar = if column.bar { "| " } else { "" };
                match column.alignment {
                    Alignment::Left => format!("{bar}{cell:<width$}"),
                    Alignment::Right => format!("{bar}{cell:>width$}"),
                }
            });
            let line = padded.collect::<Vec<_>>().join("  ");
            match index {
                0 => write!(formatter, "{}\n{}", line.trim_end(), "-".repeat(rule))?,
                _ => write!(formatter, "\n{}", line.trim_end())?,
            }
        }
        Ok(())
    }
}

/// A table in the making: what its rows are of, and the columns so far.
#[derive(Clone, Debug)]
pub struct TableOf<T> {
    table: Table,
    values: Vec<T>,
}

impl<T: Copy> TableOf<T> {
    /// A column to the left.
    #[must_use]
    pub fn left<C: ToString>(self, heading: impl Into<String>, cell: impl FnMut(T) -> C) -> Self {
        self.column(Column { heading: heading.into(), alignment: Alignment::Left, bar: false }, cell)
    }

    /// A column to the right.
    #[must_use]
    pub fn right<C: ToString>(self, heading: impl Into<String>, cell: impl FnMut(T) -> C) -> Self {
        self.column(Column { heading: heading.into(), alignment: Alignment::Right, bar: false }, cell)
    }

    /// A column to the right, behind a bar.
    #[must_use]
    pub fn bar<C: ToString>(self, heading: impl Into<String>, cell: impl FnMut(T) -> C) -> Self {
        self.column(Column { heading: heading.into(), alignment: Alignment::Right, bar: true }, cell)
    }

    /// The columns that `more` adds, if they are `wanted`.
    #[must_use]
    pub fn when(self, wanted: bool, more: impl FnOnce(Self) -> Self) -> Self {
        if wanted { more(self) } else { self }
    }

    /// The columns that `more` adds for each of `items`.
    #[must_use]
    pub fn each<I>(self, items: impl IntoIterator<Item = I>, more: impl FnMut(Self, I) -> Self) -> Self {
        items.into_iter().fold(self, more)
    }

    fn column<C: ToString>(mut self, column: Column, mut cell: impl FnMut(T) -> C) -> Self {
        self.table.columns.push(column);
        for (row, &value) in self.table.rows.iter_mut().zip(&self.values) {
            row.push(cell(value).to_string());
        }
        self
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The table with the columns so far.
    #[must_use]
    pub fn build(self) -> Table {
        self.table
    }
}

impl<T> From<TableOf<T>> for Table {
    fn from(of: TableOf<T>) -> Self {
        of.table
    }
}

impl<T> Display for TableOf<T> {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        self.table.fmt(formatter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up() {
        let rows = [("Aachen", 1.0), ("X", 22.5)];
        let table = Table::from_rows(&rows).left("site", |row| row.0).right("u", |row| format!("{:.1}", row.1));
        assert_eq!(table.to_string(), "site       u\n------------\nAachen   1.0\nX       22.5");
        let cells = rows.map(|(site, u)| vec![site.to_owned(), format!("{u:.1}")]);
        assert_eq!(table.to_string(), Table::new(["site", "u"], cells).to_string());
    }

    #[test]
    fn a_bar_stands_below_the_bar_above_it() {
        let table =
            Table::from_rows([1, 22]).left("n", |n| n).bar("printed", |n| n).when(false, |of| of.right("not", |n| n));
        assert_eq!(table.to_string(), "n   | printed\n-------------\n1   |       1\n22  |      22");
        let blank = Table::from_rows([1]).left("n", |n| n).each(["a", "b"], |of, name| of.right(name, |_| ""));
        assert_eq!(blank.to_string(), "n  a  b\n-------\n1");
    }
}
