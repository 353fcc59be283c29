//! Blocks of numbers that a file describes by a FORTRAN format, e.g. `(8F10.5)`.
//!
//! Fixed-width fields may touch each other. Where every field of a line is as the format says, the
//! widths separate the numbers; else the blanks and signs do.

use std::iter::{Enumerate, Peekable};
use std::str::Lines;

use super::head::Source;
use super::number::parse_number;
use crate::error::MotionError;

/// The lines of a file with their index, from zero.
pub(super) type NumberedLines<'a> = Peekable<Enumerate<Lines<'a>>>;

/// One edit descriptor of a FORTRAN format; its repeat count makes no difference.
///
/// # Source
///
/// FORTRAN 77 (ANSI X3.9-1978), section 13.5.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Format {
    kind: Kind,
    /// Characters of a field.
    width: usize,
    /// Digits after the point, where the format says so.
    decimals: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// `I`
    Integer,
    /// `F`
    Fixed,
    /// `E`, `D`, `G`, with or without exponent
    Exponent,
}

impl Format {
    /// Numbers with a point in fields of `width` characters.
    pub(super) fn from_width(width: usize) -> Self {
        Self { kind: Kind::Exponent, width, decimals: None }
    }

    /// The last format in parentheses on a line.
    pub(super) fn find(line: &str) -> Option<Self> {
        line.split('(').skip(1).filter_map(|piece| Self::parse(piece.split(')').next()?)).last()
    }

    /// Reads e.g. `8F10.5`, `10I8`, `1P,5E15.7E3`.
    fn parse(text: &str) -> Option<Self> {
        const WIDEST: usize = 64;
        let text: String = text.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_uppercase()).collect();
        let (scale, text) = match text.split_once('P') {
            Some((scale, rest)) => (scale.parse::<i8>().ok()?, rest.trim_start_matches(',').to_owned()),
            None => (0, text),
        };
        let descriptor = text.trim_start_matches(|c: char| c.is_ascii_digit());
        let (kind, size) = match descriptor.split_at_checked(1)? {
            ("I", size) => (Kind::Integer, size),
            // A scale factor would move the point.
            ("F", size) if scale == 0 => (Kind::Fixed, size),
            ("E", size) => (Kind::Exponent, size.trim_start_matches(['S', 'N'])),
            ("D" | "G", size) => (Kind::Exponent, size),
            _ => return None,
        };
        let size = size.split('E').next()?;
        let (width, decimals) = match size.split_once('.') {
            Some((width, decimals)) => (width.parse().ok()?, Some(decimals.parse().ok()?)),
            None => (size.parse().ok()?, None),
        };
        (1..=WIDEST).contains(&width).then_some(Self { kind, width, decimals })
    }

    /// Appends the numbers of a line every field of which is as the format says; on failure the
    /// values are as before.
    fn numbers(self, line: &str, values: &mut Vec<f64>) -> Option<()> {
        let before = values.len();
        let read = self.fields(line)?.try_for_each(|field| {
            let token = field.trim_start();
            values.push(parse_number(token).filter(|_| self.fits(token))?);
            Some(())
        });
        if read.is_none() {
            values.truncate(before);
        }
        read
    }

    /// The fields of a line, the last of which is as wide as the others.
    fn fields(self, line: &str) -> Option<impl Iterator<Item = &str>> {
        let line = line.trim_end();
        let whole = line.is_ascii() && line.len().is_multiple_of(self.width);
        whole.then(|| (0..line.len()).step_by(self.width).filter_map(move |at| line.get(at..at + self.width)))
    }

    /// Whether a number is written with the digits that the format asks for.
    fn fits(self, token: &str) -> bool {
        let after_point = token.split_once('.').map(|(_, after)| after);
        match (self.kind, after_point) {
            (Kind::Integer, after_point) => after_point.is_none() && !token.contains(['e', 'E', 'd', 'D']),
            (_, None) => false,
            (Kind::Fixed, Some(after)) => self.decimals.is_none_or(|decimals| after.len() == decimals),
            (Kind::Exponent, Some(after)) => {
                let digits = after.bytes().take_while(u8::is_ascii_digit).count();
                self.decimals.is_none_or(|decimals| digits == decimals)
            }
        }
    }

    /// A number other than zero that is written without the point of the format. FORTRAN would put
    /// one before its last digits, every other program behind it.
    fn without_point(self, line: &str) -> Option<&str> {
        let doubtful = |token: &&str| {
            let digits = token.trim_start_matches(['+', '-']);
            digits.bytes().all(|byte| byte.is_ascii_digit()) && digits.bytes().any(|byte| byte != b'0')
        };
        let has_point = self.kind != Kind::Integer && self.decimals.is_some_and(|decimals| decimals > 0);
        line.split_whitespace().find(doubtful).filter(|_| has_point)
    }
}

/// Reads the numbers of a block to the next line of text: `declared` points of `per_point` numbers.
///
/// # Errors
///
/// [`MotionError::Number`], and [`MotionError::PointCount`] where there are not as many.
pub(super) fn read_block(
    source: Source,
    lines: &mut NumberedLines,
    format: Option<Format>,
    declared: u64,
    per_point: usize,
) -> Result<Vec<f64>, MotionError> {
    let wanted = declared.saturating_mul(per_point as u64);
    // Grows with what the file holds, never with what it declares.
    let mut values = Vec::new();
    while let Some(&(index, line)) = lines.peek() {
        if let Err(error) = read_line(source, index + 1, line, format, &mut values) {
            if values.len() as u64 == wanted || is_text(line) {
                break;
            }
            return Err(error);
        }
        lines.next();
    }
    if values.len() as u64 > wanted {
        source.check_count(declared, values.len().div_ceil(per_point))?;
    } else if (values.len() as u64) < wanted {
        source.check_count(declared, values.len() / per_point)?;
    }
    Ok(values)
}

fn read_line(
    source: Source,
    number: usize,
    line: &str,
    format: Option<Format>,
    values: &mut Vec<f64>,
) -> Result<(), MotionError> {
    if let Some(format) = format {
        if format.numbers(line, values).is_some() {
            return Ok(());
        }
        if let Some(token) = format.without_point(line) {
            return Err(source.no_number(number, token, "has no decimal point, though the declared format has one"));
        }
    }
    source.numbers(number, line, values)
}

/// Reads up to `count` header values to the next line of text; what is not a number becomes NaN, for a
/// header value that nobody needs may be anything.
pub(super) fn read_header(lines: &mut NumberedLines, format: Option<Format>, count: u64) -> Vec<f64> {
    let mut values = Vec::new();
    while (values.len() as u64) < count {
        let Some((_, line)) = lines.next_if(|(_, line)| !is_text(line)) else { break };
        if format.and_then(|format| format.numbers(line, &mut values)).is_none() {
            values.extend(line.split_whitespace().map(|token| parse_number(token).unwrap_or(f64::NAN)));
        }
    }
    values
}

/// Whether a line has a word of four letters or more, which no number has.
fn is_text(line: &str) -> bool {
    let is_word = |word: &str| word.len() >= 4 && !word.eq_ignore_ascii_case("infinity");
    line.split(|c: char| !c.is_ascii_alphabetic()).any(is_word)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::format_push_string)]
    use super::*;
    use crate::recording::RecordFormat;
    use proptest::prelude::*;

    const SOURCE: Source = Source { name: "x", format: RecordFormat::Cosmos };

    fn block(text: &str, format: &str, declared: u64) -> Result<Vec<f64>, String> {
        let format = Format::find(format);
        let mut lines = text.lines().enumerate().peekable();
        read_block(SOURCE, &mut lines, format, declared, 1).map_err(|error| error.to_string())
    }

    #[test]
    fn formats() {
        let format = |kind, width, decimals| Some(Format { kind, width, decimals });
        for (text, expected) in [
            ("units=cm/sec2(04),Format=(8F10.5)", format(Kind::Fixed, 10, Some(5))),
            ("Format= (10I8)", format(Kind::Integer, 8, None)),
            ("Format  (1F14.9  )", format(Kind::Fixed, 14, Some(9))),
            ("in cm/sec2. (8f10.6)    ", format(Kind::Fixed, 10, Some(6))),
            ("(5e15.7)", format(Kind::Exponent, 15, Some(7))),
            ("(1P,5E15.7E3)", format(Kind::Exponent, 15, Some(7))),
            ("(1P5D15.7)", format(Kind::Exponent, 15, Some(7))),
            ("(5ES15.7)", format(Kind::Exponent, 15, Some(7))),
            ("(5(E15.7))", format(Kind::Exponent, 15, Some(7))),
            ("(G12)", format(Kind::Exponent, 12, None)),
            ("(1PF10.5)", None),
            ("(UNITS: G)", None),
            ("units=g (02)", None),
            ("(8F0.5)", None),
            ("(8F99999999999999999999.5)", None),
            ("(8F65.5)", None),
            ("(8F10.é)", None),
            ("(é", None),
            ("(", None),
            ("8F10.5", None),
        ] {
            assert_eq!(Format::find(text), expected, "{text}");
        }
    }

    #[test]
    fn fields_that_touch_are_split_by_their_width() {
        assert_eq!(block("1.500002.50000-3.0000", "(8F7.5)", 3), Ok(vec![1.5, 2.5, -3.0]));
        assert_eq!(
            block(" 1.500 2.500123.50012.500", "(8F7.3)", 1).unwrap_err(),
            "x, line 1: \"2.500123.50012.500\" is not a number"
        );
        assert_eq!(block("  1.500  2.500123.500-12.500", "(8F7.3)", 4), Ok(vec![1.5, 2.5, 123.5, -12.5]));
        assert_eq!(block("1234567887654321-1234567", "(10I8)", 3), Ok(vec![12_345_678.0, 87_654_321.0, -1_234_567.0]));
        assert_eq!(block("-1.50000E+00 2.50000D-01", "(6E12.5)", 2), Ok(vec![-1.5, 0.25]));
    }

    #[test]
    fn blanks_tell_where_the_format_does_not_fit() {
        // Too wide for their fields, one digit more, shifted, and another letter.
        assert_eq!(block("-0.50000-12.34567 0.25000", "(10F8.5)", 3), Ok(vec![-0.5, -12.345_67, 0.25]));
        assert_eq!(block(" 1.500 2.5000", "(8F6.3)", 2), Ok(vec![1.5, 2.5]));
        assert_eq!(block("1.500 2.500", "(8F8.3)", 2), Ok(vec![1.5, 2.5]));
        assert_eq!(block("  -11547   12", "(1I6)", 2), Ok(vec![-11547.0, 12.0]));
        assert_eq!(block("3.4e-04\n0\n 0.000\n", "(1F9.3)", 3), Ok(vec![3.4e-4, 0.0, 0.0]));
        assert_eq!(block("1 2", "", 2), Ok(vec![1.0, 2.0]));
    }

    #[test]
    fn a_number_without_its_point_is_refused() {
        let message = block("   0.50000   1250000", "(8F10.5)", 2).unwrap_err();
        assert!(message.starts_with("x, line 1: \"1250000\" has no decimal point"), "{message}");
    }

    #[test]
    fn where_a_block_ends() {
        assert_eq!(block("1.0 2.0\n\n3.0\nEnd-of-data for Chan 1\n", "", 3), Ok(vec![1.0, 2.0, 3.0]));
        assert_eq!(block("1.0\n/&  -- \n", "", 1), Ok(vec![1.0]));
        for (text, found) in [("1.0\n 12 points of veloc data", 1), ("1.0\n2.0\n3.0\nEnd of data", 3), ("", 0)] {
            let message = block(text, "", 2).unwrap_err();
            assert!(message.contains(&format!("says 2 points, file has {found}")), "{message}");
        }
        for (text, reason) in [
            ("1.0 nan", "\"nan\" is not finite"),
            ("-Infinity", "is not finite"),
            ("1e400", "is too large"),
            ("1.0x", "is not a number"),
            ("/&", "is not a number"),
        ] {
            let message = block(text, "(2F5.1)", u64::MAX).unwrap_err();
            assert!(message.contains("line 1") && message.contains(reason), "{message}");
        }
    }

    #[test]
    fn headers_need_not_be_read_whole() {
        let read = |text: &str, format, count| {
            let mut lines = text.lines().enumerate().peekable();
            let values = read_header(&mut lines, Format::find(format), count);
            (values.iter().map(|v| if v.is_nan() { -1.0 } else { *v }).collect::<Vec<_>>(), lines.next().map(|l| l.0))
        };
        assert_eq!(read("   1   2\n   3\n   4\n", "(2I4)", 3), (vec![1.0, 2.0, 3.0], Some(2)));
        assert_eq!(
            read("12341234\n  nan 1\n100 Real-header", "(2I4)", u64::MAX),
            (vec![1234.0, 1234.0, -1.0, 1.0], Some(2))
        );
        assert_eq!(read("", "", u64::MAX), (vec![], None));
    }

    proptest! {
        #[test]
        fn what_a_format_writes_comes_back(
            values in prop::collection::vec(-999_999..9_999_999_i32, 1..40), per_row in 1..9_usize,
        ) {
            // Seven digits in eight places with the point: fields touch wherever a number is long.
            let mut text = String::new();
            for row in values.chunks(per_row) {
                for &value in row {
                    text += &format!("{:8.3}", f64::from(value) / 1000.0);
                }
                text += "\n";
            }
            let found = block(&text, &format!("({per_row}F8.3)"), values.len() as u64).unwrap();
            let written: Vec<f64> = values.iter().map(|&value| f64::from(value) / 1000.0).collect();
            prop_assert_eq!(found, written);
        }

        #[test]
        fn any_text_gives_an_answer(text in "[-+0-9.eEdD() I\\n%é]{0,80}", format in "\\([0-9PIFEDGé., ]{0,8}\\)?") {
            if let Ok(values) = block(&text, &format, 3) {
                prop_assert_eq!(values.len(), 3);
            }
            let mut lines = text.lines().enumerate().peekable();
            prop_assert!(read_header(&mut lines, Format::find(&format), u64::MAX).len() <= text.len());
        }
    }
}
