//! Cells that a spreadsheet would compute.

use std::borrow::Cow;

use polars::prelude::{Column, DataType, IntoColumn, StringChunked};

/// `text` as a cell that a spreadsheet shows and does not compute: an apostrophe goes before what it would take for a
/// formula. A number stays a number.
pub fn neutral(text: &str) -> Cow<'_, str> {
    if begins_formula(text) && text.trim().parse::<f64>().is_err() {
        Cow::Owned(format!("'{text}"))
    } else {
        Cow::Borrowed(text)
    }
}

/// The text of a cell that [`neutral`] made.
pub fn plain(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|text| begins_formula(text)).unwrap_or(cell)
}

fn begins_formula(text: &str) -> bool {
    text.starts_with(['=', '+', '-', '@', '\t', '\r'])
}

/// A column with its name and texts [`neutral`]; one of numbers as it is.
pub(super) fn neutral_column(mut column: Column) -> Column {
    if *column.dtype() == DataType::String
        && let Ok(texts) = column.str()
        && texts.iter().flatten().any(begins_formula)
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
    fn formulas_are_texts_and_come_back() {
        for text in ["=HYPERLINK(\"x\")", "+1+1", "-2-3", "@SUM(A1)", "\tx", "\rx", "'=1", "-", "a=b", "'quoted", ""] {
            let cell = neutral(text);
            assert!(!cell.starts_with(['=', '+', '-', '@', '\t', '\r']), "{text:?}: {cell:?}");
            assert_eq!(plain(&cell), if text == "'=1" { "=1" } else { text });
        }
        for number in ["-1.5e3", "+2", "-inf", "0.1"] {
            assert_eq!(neutral(number), number);
        }
    }
}
