//! Tables that users bring: CSV as programs and spreadsheets of every country write it.

mod shape;

use std::io::Cursor;

use polars::prelude::{Column, DataFrame};
use polars_io::prelude::{CsvParseOptions, CsvReadOptions, SerReader};
use uplift_plausible::{DecimalMarks, with_point};

/// How a zip archive begins.
const ZIP: &[u8] = b"PK\x03\x04";
/// How an HDF5 file begins.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";
/// Bytes in which a file of another kind shows itself.
const HEAD_BYTES: usize = 4096;
/// How text of two bytes a letter begins, either way round.
const UTF_16: [&[u8]; 2] = [b"\xff\xfe", b"\xfe\xff"];

/// All columns of a table with a header row as text: an identifier such as 0012 must stay what it is. Lines that begin
/// with `#` are comments.
///
/// Commas, semicolons or tabs separate the columns. Where it is not commas, numbers may have decimal commas, and get
/// points, but for those in the columns named `texts`.
///
/// # Errors
/// What the file is instead of such a table; numbers that can be read in two ways.
pub fn parse(bytes: &[u8], texts: &[&str]) -> Result<DataFrame, String> {
    parse_with_short_row(bytes, texts).map(|(table, _)| table)
}

/// The same with the line and the cells of the first row that is shorter than the header.
///
/// # Errors
/// As [`parse`].
pub fn parse_with_short_row(bytes: &[u8], texts: &[&str]) -> Result<(DataFrame, Option<(usize, usize)>), String> {
    refuse_what_is_no_text(bytes)?;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let parsed = parse_text(bytes, texts);
    // a table may look like another kind of file, but is not in pieces then
    let is_table = parsed.as_ref().is_ok_and(|(table, _)| table.width() > 1);
    match other_kind(bytes).filter(|_| !is_table) {
        Some(kind) => Err(kind.to_owned()),
        None => parsed,
    }
}

fn parse_text(bytes: &[u8], texts: &[&str]) -> Result<(DataFrame, Option<(usize, usize)>), String> {
    let header = bytes.split(|&byte| byte == b'\n').find(|line| !line.starts_with(b"#")).unwrap_or_default();
    let separator = separator(header);
    let short = shape::check(bytes, separator)?;
    let options = CsvParseOptions::default().with_comment_prefix(Some("#")).with_separator(separator);
    let table = CsvReadOptions::default()
        .with_has_header(true)
        .with_infer_schema_length(Some(0))
        .with_parse_options(options)
        .into_reader_with_file_handle(Cursor::new(bytes))
        .finish()
        .map_err(|error| error.to_string())?;
    let table = if separator == b',' { table } else { with_points(table, texts)? };
    Ok((table, short))
}

/// Refuses what is no text of one byte a letter.
///
/// # Errors
/// What the file is instead.
pub fn refuse_what_is_no_text(bytes: &[u8]) -> Result<(), String> {
    if bytes.starts_with(ZIP) {
        let head = &bytes[..bytes.len().min(HEAD_BYTES)];
        if [&b"[Content_Types].xml"[..], b"xl/"].iter().any(|part| head.windows(part.len()).any(|own| own == *part)) {
            return Err("it is an Excel workbook: save it as \"CSV UTF-8\"".to_owned());
        }
        return Err("it is a zip archive: `uplift records import` takes one of records".to_owned());
    }
    if bytes.starts_with(HDF5) {
        return Err("it is an HDF5 file such as a result (`uplift status` shows what it holds)".to_owned());
    }
    if UTF_16.iter().any(|mark| bytes.starts_with(mark)) {
        return Err("it is UTF-16 text, which Excel and Notepad call Unicode: save it as \"CSV UTF-8\"".to_owned());
    }
    Ok(())
}

/// What a text seems to be that is no table; none where it may be one.
fn other_kind(bytes: &[u8]) -> Option<&'static str> {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(HEAD_BYTES)]);
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    if lines.clone().take(4).any(|line| line.contains("NPTS=")) {
        return Some("it is a record");
    }
    let first = lines.next().unwrap_or_default();
    let is_key = |key: &str| key.chars().all(|letter| letter.is_alphanumeric() || "_-. ".contains(letter));
    // Excel puts `sep=;` before a table
    let is_entry = first.split_once('=').is_some_and(|(key, _)| is_key(key) && key != "sep");
    (first.starts_with('[') || is_entry).then_some("it is a TOML file such as a study or structure")
}

/// What separates the columns of a table with this `header`: what stands there most often.
fn separator(header: &[u8]) -> u8 {
    let count = |mark: u8| header.split(|byte| *byte == mark).count();
    [b'\t', b';', b','].into_iter().max_by_key(|&mark| count(mark)).unwrap_or(b',')
}

/// The table, decimal commas of its columns of numbers replaced.
fn with_points(table: DataFrame, texts: &[&str]) -> Result<DataFrame, String> {
    let is_number = |cell: &str| cell.is_empty() || cell.parse::<f64>().is_ok() || with_point(cell).is_some();
    let cells = |column: &Column| -> Option<Vec<String>> {
        let cells = column.str().ok()?.iter().map(|cell| cell.unwrap_or_default().trim().to_owned());
        Some(cells.collect::<Vec<_>>())
            .filter(|cells| !texts.contains(&column.name().as_str()) && cells.iter().all(|cell| is_number(cell)))
    };
    let mut marks = DecimalMarks::default();
    for column in table.columns() {
        for (row, cell) in cells(column).into_iter().flatten().enumerate() {
            marks.see(|| format!("row {} below the header, {}", row + 1, column.name()), &cell);
        }
    }
    if !marks.are_commas().map_err(|error| error.to_string())? {
        return Ok(table);
    }
    let replaced = table.columns().iter().map(|column| match cells(column) {
        Some(cells) => {
            let cells: Vec<String> = cells.into_iter().map(|cell| with_point(&cell).unwrap_or(cell)).collect();
            Column::new(column.name().clone(), cells)
        }
        None => column.clone(),
    });
    DataFrame::new(table.height(), replaced.collect()).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn a_table_that_looks_like_another_file_is_a_table() {
        for text in [
            "record_id,note\na,NPTS= 5\n",
            "# NPTS=3, DT=0.1\na,b\n1,2\n",
            "sep=;\na;b\n",
            "= odd,b\n1,2\n",
            "[g],b\n1,2\n",
        ] {
            assert_eq!(parse(text.as_bytes(), &[]).unwrap().width(), 2, "{text}");
        }
    }

    #[test]
    fn what_is_no_table_is_named() {
        let workbook = parse(b"PK\x03\x04\x14\x00\x06\x00[Content_Types].xml", &[]).unwrap_err();
        assert!(workbook.contains("an Excel workbook"), "{workbook}");
        let record = "a title\nwith, a comma\nsecond\nNPTS=  3, DT= .01\n1 2 3\n";
        for (text, kind) in [
            ("kind = \"block\"\nheight_m = 1\n", "a TOML file"),
            ("[study]\nname = \"x, y, z\"\n", "a TOML file"),
            (record, "a record"),
        ] {
            let error = parse(text.as_bytes(), &[]).unwrap_err();
            assert!(error.contains(kind), "{error}");
        }
    }
}
