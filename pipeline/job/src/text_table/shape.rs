//! Whether the rows of a table are as wide as its header, and its quotes closed: told by line before it is read.

/// What is wrong with the rows of a table whose cells are parted by `separator`, by its first such line.
///
/// Cells may stand in double quotes, with separators and line ends in them. Lines that begin with `#` are comments.
/// Rows may be shorter than the header: the line and the cells of the first that is, and not blank.
///
/// # Errors
/// No header; a quote that is not closed; a row with more cells than the header.
pub(super) fn check(bytes: &[u8], separator: u8) -> Result<Option<(usize, usize)>, String> {
    let (mut header, mut short) = (None, None);
    let (mut line, mut rest) = (1, bytes);
    while !rest.is_empty() {
        let first = line;
        if rest.starts_with(b"#") || matches!(rest.first(), Some(b'\n' | b'\r')) {
            let end = rest.iter().position(|&byte| byte == b'\n').map_or(rest.len(), |end| end + 1);
            (line, rest) = (line + 1, &rest[end..]);
            continue;
        }
        let row = Row::read(rest, separator);
        let is_blank = rest[..row.bytes].trim_ascii().is_empty();
        line += row.lines;
        rest = &rest[row.bytes..];
        if !row.is_closed {
            return Err(format!("line {first}: a quote (\") is opened and not closed"));
        }
        let Some(columns) = header else {
            header = Some(row.cells);
            continue;
        };
        if row.cells > columns {
            let cells = row.cells;
            return Err(format!(
                "line {first}: it has {cells} cells, and the header has {columns} columns: put cells with a separator \
                 in them into double quotes, or name the columns that are missing"
            ));
        }
        if row.cells < columns && !is_blank {
            short = short.or(Some((first, row.cells)));
        }
    }
    header.map(|_| short).ok_or_else(|| "it is empty: a header row is needed, and rows below".to_owned())
}

/// One row, which may go over several lines.
struct Row {
    cells: usize,
    bytes: usize,
    lines: usize,
    is_closed: bool,
}

impl Row {
    fn read(bytes: &[u8], separator: u8) -> Self {
        let (mut cells, mut lines, mut in_quotes, mut at_start) = (1, 0, false, true);
        for (position, &byte) in bytes.iter().enumerate() {
            lines += usize::from(byte == b'\n');
            match byte {
                // two quotes within quotes leave and enter them
                b'"' if in_quotes => in_quotes = false,
                b'"' if at_start || position > 0 && bytes[position - 1] == b'"' => in_quotes = true,
                _ if in_quotes => {}
                b'\n' => return Self { cells, bytes: position + 1, lines, is_closed: true },
                _ if byte == separator => cells += 1,
                _ => {}
            }
            at_start = byte == separator && !in_quotes;
        }
        Self { cells, bytes: bytes.len(), lines: lines + 1, is_closed: !in_quotes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_rows_and_open_quotes_are_reported_by_their_line() {
        for (table, short) in [
            ("a,b\n1,2\n", None),
            ("a,b\r\n\r\n1\r\n", Some((3, 1))),
            ("a,b\n1,2\n  \n", None),
            ("# c,d,e\na,b\n\"1,5\",2\n", None),
            ("a,b\n\"x\n\"\"y,\"\"\",2\n5\" pipe,1", None),
        ] {
            assert_eq!(check(table.as_bytes(), b','), Ok(short), "{table:?}");
        }
        for (table, words) in [
            ("", "it is empty"),
            ("# only this\n", "it is empty"),
            ("a,b\n1,2,3\n", "line 2: it has 3 cells, and the header has 2 columns"),
            ("# x\na,b\n\"1\n2\",3\n4,5,6\n", "line 5: it has 3 cells"),
            ("a\n1\n\"b\n", "line 3: a quote"),
        ] {
            let told = check(table.as_bytes(), b',').err().unwrap_or_default();
            assert!(told.starts_with(words), "{table:?}: {told}");
        }
    }
}
