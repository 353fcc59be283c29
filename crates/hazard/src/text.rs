//! Numbers out of text, and text into messages.

use crate::error::{HazardError, Place};

/// A finite number; `place` is called only where `field` is not one.
///
/// # Errors
/// [`HazardError::Row`] with the field.
pub(crate) fn number(field: &str, place: impl FnOnce() -> Place) -> Result<f64, HazardError> {
    let reason = match field.parse::<f64>() {
        Ok(value) if value.is_finite() => return Ok(value),
        Ok(_) => format!("{} is not a finite number", excerpt(field)),
        Err(_) if field.replace(',', ".").parse::<f64>().is_ok() => {
            format!("{} has a decimal comma: write a decimal point", excerpt(field))
        }
        Err(_) => format!("{} is not a number", excerpt(field)),
    };
    Err(HazardError::Row { place: place(), reason })
}

/// The beginning of a field for a message, with everything unprintable escaped.
pub(crate) fn excerpt(field: &str) -> String {
    let head: String = field.chars().take(40).collect();
    if head.len() < field.len() { format!("{head:?}...") } else { format!("{head:?}") }
}

/// The `end` of a curve for a message that `value` lies beyond it: without the digits that a conversion from another
/// unit made, unless these are what it lies beyond.
pub(crate) fn shown_end(end: f64, value: f64) -> f64 {
    let six_digits: f64 = format!("{end:.5e}").parse().unwrap_or(end);
    if (six_digits < value) == (end < value) && (six_digits > value) == (end > value) { six_digits } else { end }
}

/// The first characters of a text, `count` at most.
pub(crate) fn beginning(text: &str, count: usize) -> &str {
    text.char_indices().nth(count).map_or(text, |(end, _)| &text[..end])
}

/// What a file says of its origin, of a length that every curve of it can keep a copy of.
pub(crate) fn origin(text: &str) -> String {
    const LONGEST: usize = 2000;
    let head = beginning(text, LONGEST);
    if head.len() < text.len() { format!("{head}...") } else { head.to_owned() }
}

/// The fields of a line of CSV, trimmed; a field in quotes may hold the separator.
pub(crate) fn fields(line: &str, separator: char) -> impl Iterator<Item = &str> {
    let mut rest = Some(line);
    std::iter::from_fn(move || {
        let text = rest?;
        let quoted = text.trim_start().strip_prefix('"').and_then(|inner| inner.split_once('"'));
        let (field, after) = match quoted {
            Some((field, after)) if after.trim_start().is_empty() => (field, None),
            Some((field, after)) if after.trim_start().starts_with(separator) => {
                (field, after.split_once(separator).map(|(_, after)| after))
            }
            _ => text.split_once(separator).map_or((text, None), |(field, after)| (field, Some(after))),
        };
        rest = after;
        Some(field.trim())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_of_a_conversion_are_left_out() {
        assert_eq!(shown_end(0.000_101_971_621_297_793, 1e-5), 0.000_101_972);
        assert_eq!([shown_end(174.33, 175.0), shown_end(5.0, 2.0)], [174.33, 5.0]);
        // 0.07 m/s is not 7 cm/s
        let end = 0.07 * 100.0;
        assert_eq!((end > 7.0, shown_end(end, 7.0), shown_end(end, 6.0)), (true, end, 7.0));
    }

    #[test]
    fn quoted_fields() {
        for (line, expected) in [
            ("a,b", vec!["a", "b"]),
            (" \"a,b\" , c,", vec!["a,b", "c", ""]),
            ("", vec![""]),
            ("\"a\"b,c", vec!["\"a\"b", "c"]),
            ("\"a,b", vec!["\"a", "b"]),
            ("\"\",\"x\"", vec!["", "x"]),
        ] {
            assert_eq!(fields(line, ',').collect::<Vec<_>>(), expected, "{line}");
        }
    }
}
