//! A sheet being filled: texts stay texts, and what is no number is said in words.

use rust_xlsxwriter::{Format, FormatAlign, FormatBorder, Worksheet, XlsxError};

/// Most characters of a cell.
const LONGEST_CELL: usize = 32_767;

/// How cells look.
pub(super) struct Formats {
    heading: Format,
    last_heading: Format,
    text: Format,
    word: Format,
    numbers: [Format; 7],
}

/// How a number is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shown {
    /// As it is.
    Plain,
    /// With four decimals: strengths, metres.
    FourDecimals,
    /// A share, with the sign % in its cell; a column with % in its heading has per cent.
    Percent,
    /// A whole number.
    Whole,
    /// With one decimal: per cent.
    OneDecimal,
    /// As a power of ten: rates.
    Power,
    /// Whole, as the head of a column.
    WholeHeading,
}

const SHOWN: [(Shown, &str); 7] = [
    (Shown::Plain, "General"),
    (Shown::FourDecimals, "0.0000"),
    (Shown::Percent, "0.00%"),
    (Shown::Whole, "0"),
    (Shown::OneDecimal, "0.0"),
    (Shown::Power, "0.000E+00"),
    (Shown::WholeHeading, "0"),
];

impl Formats {
    pub(super) fn new() -> Self {
        let heading = Format::new().set_bold();
        let number = |(shown, pattern): (Shown, &str)| {
            let format = if shown == Shown::WholeHeading { heading.clone() } else { Format::new() };
            format.set_num_format(pattern)
        };
        Self {
            last_heading: heading.clone().set_border_bottom(FormatBorder::Thin),
            text: Format::new().set_text_wrap().set_align(FormatAlign::Top),
            word: Format::new().set_align(FormatAlign::Right),
            numbers: SHOWN.map(number),
            heading,
        }
    }

    fn format(&self, shown: Shown) -> &Format {
        let index = SHOWN.iter().position(|(way, _)| *way == shown).unwrap_or_default();
        &self.numbers[index]
    }
}

/// A sheet being filled.
pub(crate) struct Sheet<'a> {
    sheet: &'a mut Worksheet,
    formats: &'a Formats,
}

impl<'a> Sheet<'a> {
    pub(super) fn new(sheet: &'a mut Worksheet, formats: &'a Formats) -> Self {
        Self { sheet, formats }
    }

    /// A heading; the last line of headings has a rule below it.
    pub(crate) fn heading(&mut self, at: (usize, usize), text: &str, last: bool) -> Result<(), XlsxError> {
        let format = if last { &self.formats.last_heading } else { &self.formats.heading };
        let (row, column) = place(at)?;
        self.sheet.write_string_with_format(row, column, clipped(text, LONGEST_CELL), format)?;
        Ok(())
    }

    pub(crate) fn text(&mut self, at: (usize, usize), text: &str) -> Result<(), XlsxError> {
        let (row, column) = place(at)?;
        self.sheet.write_string(row, column, clipped(text, LONGEST_CELL))?;
        Ok(())
    }

    /// A text that may be long.
    pub(super) fn long_text(&mut self, at: (usize, usize), text: &str) -> Result<(), XlsxError> {
        let (row, column) = place(at)?;
        self.sheet.write_string_with_format(row, column, clipped(text, LONGEST_CELL), &self.formats.text)?;
        Ok(())
    }

    /// A number; `infinite` in place of one that is infinite, nothing where there is none.
    pub(crate) fn number(
        &mut self,
        at: (usize, usize),
        value: f64,
        shown: Shown,
        infinite: &str,
    ) -> Result<(), XlsxError> {
        let (row, column) = place(at)?;
        if value.is_finite() {
            self.sheet.write_number_with_format(row, column, value, self.formats.format(shown))?;
        } else if value.is_infinite() {
            self.sheet.write_string_with_format(row, column, infinite, &self.formats.word)?;
        }
        Ok(())
    }

    /// What stays in sight: so many `rows` and `columns`; and how wide the first and the other columns are, in
    /// characters.
    pub(crate) fn finish(&mut self, (rows, columns): (usize, usize), widths: &[f64]) -> Result<(), XlsxError> {
        let (row, column) = place((rows, columns))?;
        self.sheet.set_freeze_panes(row, column)?;
        for (column, &width) in widths.iter().enumerate() {
            self.sheet.set_column_width(place((0, column))?.1, width)?;
        }
        Ok(())
    }
}

/// Row and column as Excel counts them.
fn place((row, column): (usize, usize)) -> Result<(u32, u16), XlsxError> {
    match (u32::try_from(row), u16::try_from(column)) {
        (Ok(row), Ok(column)) => Ok((row, column)),
        _ => Err(XlsxError::RowColumnLimitError),
    }
}

/// The beginning of a `text` that is too long.
pub(super) fn clipped(text: &str, longest: usize) -> String {
    // Excel counts in units of UTF-16
    if text.encode_utf16().count() <= longest {
        return text.to_owned();
    }
    let mut units = 1;
    let fits = |letter: &char| {
        units += letter.len_utf16();
        units <= longest
    };
    text.chars().take_while(fits).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_clipped_to_what_a_cell_holds() {
        assert_eq!(clipped("spectra", 7), "spectra");
        assert_eq!(clipped("spectra", 6), "spect…");
        // two units a letter
        assert_eq!(clipped("𝒖𝒖𝒖", 5), "𝒖𝒖…");
        assert_eq!(clipped("𝒖𝒖𝒖", 6), "𝒖𝒖𝒖");
    }
}
