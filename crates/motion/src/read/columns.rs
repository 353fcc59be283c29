//! Plain text of one column (acceleration) or two (time, acceleration).

mod head;

use head::Head;

use super::head::Source;
use super::number::{parse_number, why_no_number};
use super::{ReadOptions, decode};
use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::recording::{RecordFormat, Recording, RecordingDescription};

const DECIMAL_COMMA: &str = " (is a comma a decimal mark? Write a point)";

/// Reads one column (acceleration) or two (time in s, acceleration) from `bytes`; `name` stands
/// in messages.
///
/// Columns are separated by blanks, tabs, commas or semicolons. Blank lines, lines that begin
/// with `#`, `%` or `//`, and lines of words above the values are skipped.
///
/// What the lines above the values say of unit (`units: cm/s^2`, `acc (g)`) and time step
/// (`dt = 0.01 s`) takes precedence over `options`; where they say nothing, or several things,
/// `options` must give the unit, and the time step for one column. For two columns it is the
/// mean step of the times, which may differ from a uniform spacing by a quarter of a step: times
/// printed with enough digits to give the step stay below that, and a missing or repeated line
/// moves the times beside it by about half a step or more. The first time may be any.
///
/// # Errors
///
/// Head: [`MotionError::NotAcceleration`], [`MotionError::HeaderUnit`],
/// [`MotionError::HeaderValue`] where a time step is not a number.
/// [`MotionError::MissingUnit`], [`MotionError::MissingTimeStep`], [`MotionError::Number`],
/// [`MotionError::ColumnCount`], [`MotionError::UnevenTime`], [`MotionError::Gravity`], and
/// [`MotionError::InFile`] where the values make no [`Accelerogram`].
pub fn read_columns(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Accelerogram, MotionError> {
    read(bytes, name, options).map(|recording| recording.accelerogram)
}

/// Reads columns; they say nothing of earthquake and station.
pub(super) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Recording, MotionError> {
    let mut table = Table::parse(&decode(bytes), Source { name, format: RecordFormat::Columns })?;
    let stated = table.head.unit()?;
    let unit = options.unit_or(stated, name);
    let dt_s = match &table.times {
        Some(times) => uniform_step_s(times, table.decimal_comma_hint, name)?,
        None => table.head.dt_s().or(options.dt_s).ok_or_else(|| {
            let name = name.to_owned();
            if unit.is_ok() {
                MotionError::MissingTimeStep { name }
            } else {
                MotionError::MissingUnitAndTimeStep { name }
            }
        })?,
    };
    let unit = unit?;
    let accelerogram = options.accelerogram(name, dt_s, unit, table.accelerations)?;
    Ok(Recording { accelerogram, unit, description: RecordingDescription::default() })
}

/// A time and the line it stands on, for messages.
struct Time {
    time_s: f64,
    line: usize,
}

/// The values of a file.
struct Table {
    /// What the lines above the values say.
    head: Head,
    /// None for one column.
    times: Option<Vec<Time>>,
    /// In the unit of the file.
    accelerations: Vec<f64>,
    /// What may be wrong if the times make no sense.
    decimal_comma_hint: &'static str,
}

impl Table {
    fn parse(text: &str, source: Source) -> Result<Self, MotionError> {
        let mut times = Vec::new();
        let mut accelerations = Vec::new();
        let mut head = Head::default();
        for (index, line) in text.lines().enumerate() {
            let content = line.trim();
            let comment = content.is_empty() || ["#", "%", "//"].iter().any(|mark| content.starts_with(mark));
            let above = accelerations.is_empty();
            if comment || (above && is_head(content)) {
                if above {
                    head.note(source, index + 1, content)?;
                }
                continue;
            }
            let row = parse_row(content, source, index + 1)?;
            let first = accelerations.is_empty();
            let two_columns = first || !times.is_empty();
            let (acceleration, time) = match row {
                Row::One(acceleration) if first || !two_columns => (acceleration, None),
                Row::Two(time_s, acceleration) if two_columns => (acceleration, Some(time_s)),
                _ => {
                    return Err(MotionError::ColumnCount {
                        name: source.name.to_owned(),
                        line: index + 1,
                        found: if two_columns { 1 } else { 2 },
                        expected: if two_columns { "2 as above" } else { "1 as above" },
                        hint: comma_hint(content),
                    });
                }
            };
            accelerations.push(acceleration);
            times.extend(time.map(|time_s| Time { time_s, line: index + 1 }));
        }
        Ok(Self {
            head,
            times: (!times.is_empty()).then_some(times),
            accelerations,
            decimal_comma_hint: comma_hint(text),
        })
    }
}

enum Row {
    One(f64),
    Two(f64, f64),
}

/// A head line begins with a word, or has words and nothing that is or was meant to be a number.
fn is_head(content: &str) -> bool {
    let not_finite = |word: &str| ["nan", "inf", "infinity"].contains(&word);
    let no_value = |token: &str| {
        let word = token.trim_start_matches(['+', '-']).to_lowercase();
        let begins_with_letter = word.starts_with(char::is_alphabetic);
        parse_number(token).is_none()
            && !not_finite(&word)
            && (begins_with_letter || !word.contains(|c: char| c.is_ascii_digit()))
    };
    let mut tokens = content.split(is_separator).map(|token| token.trim_matches('"')).filter(|token| !token.is_empty());
    // One letter may be a digit mistyped: "O.1".
    let first = tokens.clone().next().unwrap_or("");
    let letters = first.find(|c: char| !c.is_alphabetic()).unwrap_or(first.len());
    let begins_with_word = first[..letters].chars().nth(1).is_some() && !not_finite(&first[..letters].to_lowercase());
    begins_with_word
        || content.contains(char::is_alphabetic)
            && tokens.all(|token| {
                // "(m/s2)" and the like
                no_value(token) || token.starts_with(['(', '['])
            })
}

fn is_separator(c: char) -> bool {
    c.is_whitespace() || c == ',' || c == ';'
}

/// A hint where the text has commas.
fn comma_hint(text: &str) -> &'static str {
    if text.contains(',') { DECIMAL_COMMA } else { "" }
}

fn parse_row(content: &str, source: Source, line: usize) -> Result<Row, MotionError> {
    let number = |token: &str| parse_number(token).ok_or_else(|| source.no_number(line, token, why_no_number(token)));
    // One comma or semicolon may end the line; two in a row leave a cell empty.
    let content = content.strip_suffix([',', ';']).unwrap_or(content);
    let (mut columns, mut count) = ([""; 2], 0);
    for cell in content.split([',', ';']) {
        let count_before = count;
        for token in cell.split_whitespace() {
            if let Some(column) = columns.get_mut(count) {
                *column = token;
            }
            count += 1;
        }
        if count == count_before {
            return Err(source.no_number(line, "", "is an empty cell"));
        }
    }
    match count {
        1 => Ok(Row::One(number(columns[0])?)),
        2 => Ok(Row::Two(number(columns[0])?, number(columns[1])?)),
        _ => Err(MotionError::ColumnCount {
            name: source.name.to_owned(),
            line,
            found: count,
            expected: "1 (acceleration) or 2 (time, acceleration)",
            hint: comma_hint(content),
        }),
    }
}

/// The mean step of times that are uniform within the tolerance.
fn uniform_step_s(times: &[Time], hint: &'static str, name: &str) -> Result<f64, MotionError> {
    let [first, .., last] = times else {
        return Err(MotionError::InFile {
            name: name.to_owned(),
            reason: Box::new(MotionError::TooFewSamples { count: times.len() }),
        });
    };
    let dt_s = (last.time_s - first.time_s) / (times.len() - 1) as f64;
    for (i, time) in times.iter().enumerate() {
        let expected_s = first.time_s + i as f64 * dt_s;
        let within = (time.time_s - expected_s).abs() <= 0.25 * dt_s;
        if !(within && dt_s > 0.0) {
            return Err(MotionError::UnevenTime {
                name: name.to_owned(),
                line: time.line,
                time_s: time.time_s,
                expected_s,
                dt_s,
                hint,
            });
        }
    }
    Ok(dt_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unit::AccelerationUnit;

    fn read(text: &str, dt_s: Option<f64>) -> Result<Accelerogram, MotionError> {
        let options = ReadOptions { dt_s, unit: Some(AccelerationUnit::CmPerS2), ..ReadOptions::default() };
        read_columns(text.as_bytes(), "a.txt", &options)
    }

    fn message(text: &str, dt_s: Option<f64>) -> String {
        read(text, dt_s).unwrap_err().to_string()
    }

    #[test]
    fn one_column() {
        let motion = read("# station\n% more\n// yet more\nacc (cm/s2)\n\n100\r\n-2.0e2\n 3D2\n", Some(0.02)).unwrap();
        assert_eq!(motion.dt_s(), 0.02);
        assert_eq!(motion.acceleration_m_s2(), [1.0, -2.0, 3.0]);
        assert_eq!(
            message("1\n2\n", None),
            "a.txt: one column of accelerations and no time step; give the time step in seconds (--dt-s; dt_s in \
             a manifest and in Python), or a file with two columns (time, acceleration)"
        );
        // all that is missing at once
        let both = read_columns(b"1\n2\n", "a.txt", &ReadOptions::default()).unwrap_err().to_string();
        assert!(both.contains("--unit") && both.contains("--dt-s"), "{both}");
    }

    #[test]
    fn two_columns_with_any_separator() {
        for text in [
            "0.00 100\n0.02 -200\n0.04 300\n",
            "time,acceleration\n0.00,100\n0.02,-200\n0.04,300",
            "t [s]; a [cm/s2]\n0.00;100;\n0.02; -200;\n0.04 ;300;\n",
            "0.00\t100\n0.02\t-200\n\n0.04\t300\n\n",
            "  5.00 , 100\n  5.02 , -200\n  5.04 , 300\n",
        ] {
            // The caller's time step is for files without times.
            let motion = read(text, Some(9.0)).unwrap();
            assert!((motion.dt_s() - 0.02).abs() < 1e-15, "{text}");
            assert_eq!(motion.acceleration_m_s2(), [1.0, -2.0, 3.0]);
        }
    }

    #[test]
    fn unit_is_needed() {
        let error = read_columns(b"1\n2\n", "a.txt", &ReadOptions { dt_s: Some(0.01), ..ReadOptions::default() });
        assert_eq!(
            error.unwrap_err().to_string(),
            "a.txt: the file does not say its unit of acceleration; give the unit (--unit; unit in a manifest and in \
             Python), one of: g, m/s2, cm/s2, gal"
        );
    }

    #[test]
    fn several_head_lines() {
        let head = "Event: Chi-Chi, 1999\nStation TCU052\n\ntime (s)  acc (cm/s2)\n\"t\", \"a\"\n";
        for values in ["100\n-200\n300\n", "0.00 100\n0.02 -200\n0.04 300\n"] {
            let motion = read(&format!("{head}{values}"), Some(0.02)).unwrap();
            assert_eq!(motion.acceleration_m_s2(), [1.0, -2.0, 3.0]);
            assert!((motion.dt_s() - 0.02).abs() < 1e-15);
        }
    }

    #[test]
    fn the_head_is_believed_before_the_options() {
        let silent = ReadOptions { gravity_m_s2: 10.0, ..ReadOptions::default() };
        let other =
            ReadOptions { dt_s: Some(9.0), unit: Some(AccelerationUnit::CmPerS2), gravity_m_s2: 10.0, ..silent };
        for options in [silent, other] {
            let motion = read_columns(b"# dt = 0.01\nunits: g\n1\n-2\n", "a.txt", &options).unwrap();
            assert_eq!(motion, Accelerogram::new(0.01, vec![10.0, -20.0]).unwrap());
        }
        // Two things said are nothing said; times are believed before words; below the values nothing is.
        let two = read_columns(b"# dt = 0.01\n# units: g\n# acc (m/s2)\n# dt = 0.02\n100\n-200\n", "a.txt", &other);
        assert_eq!(two.unwrap(), Accelerogram::new(9.0, vec![1.0, -2.0]).unwrap());
        let times = read_columns(b"# dt = 0.01\n0 100\n0.5 200\n", "a.txt", &other).unwrap();
        assert_eq!(times.dt_s(), 0.5);
        assert!(read_columns(b"0 100\n0.5 200\n# units: g\n", "a.txt", &silent).is_err());
        for (text, expected) in [
            ("# velocity (cm/s)\n1\n2\n", "not an acceleration"),
            ("# dt = 0,01\n1\n2\n", "cannot read the time step"),
            ("# dt = 0.0\n1\n2\n", "time step is 0 s"),
        ] {
            assert!(read_columns(text.as_bytes(), "a.txt", &other).unwrap_err().to_string().contains(expected));
        }
    }

    #[test]
    fn printed_times_may_be_rounded() {
        // 1/150 s printed with three decimals: 0, 0.007, 0.013, 0.020, ...
        let lines: Vec<_> = (0..=300).map(|i| format!("{:.3} 1.0", f64::from(i) / 150.0)).collect();
        let text = lines.join("\n");
        let motion = read(&text, None).unwrap();
        assert!((motion.dt_s() - 1.0 / 150.0).abs() < 1e-15);
    }

    #[test]
    fn a_missing_or_repeated_time_is_found_wherever_it_is() {
        let file = |lines: Vec<i32>| {
            let line = |i: &i32| format!("{:.2} 1.0\n", 0.01 * f64::from(*i));
            lines.iter().map(line).collect::<Vec<_>>().concat()
        };
        for gap in 1..99 {
            let missing = file((0..100).filter(|&i| i != gap).collect());
            assert!(matches!(read(&missing, None), Err(MotionError::UnevenTime { .. })), "{gap}");
            let repeated = file((0..=gap).chain(gap..100).collect());
            assert!(matches!(read(&repeated, None), Err(MotionError::UnevenTime { .. })), "{gap}");
        }
        assert!(message("0 1\n1 1\n3 1\n4 1\n5 1\n", None).contains("line 3: time 3 s, expected 2.5 s"));
        for text in ["0 1\n0 1\n", "1 1\n0 1\n", "0,01 1,5\n"] {
            assert!(read(text, None).is_err());
        }
    }

    #[test]
    fn decimal_commas_are_recognised() {
        assert!(message("0,00;0,1\n0,01;0,2\n", None).contains("number of columns 4, expected 1"));
        assert!(message("0,00;0,1\n0,01;0,2\n", None).contains("decimal mark"));
        assert!(message("0,10\n0,12\n0,10\n", Some(0.01)).contains("decimal mark"));
    }

    #[test]
    fn bad_lines() {
        for (text, expected) in [
            ("1\nnan\n", "a.txt, line 2: \"nan\" is not finite"),
            ("nan\n1\n", "a.txt, line 1: \"nan\" is not finite"),
            ("1\n2\nend\n", "a.txt, line 3: \"end\" is not a number"),
            ("0.O1\n0.02\n", "a.txt, line 1: \"0.O1\" is not a number"),
            ("acc\nnan\n1\n", "a.txt, line 2: \"nan\" is not finite"),
            ("NaN 0.1\n1 2\n", "a.txt, line 1: \"NaN\" is not finite"),
            ("O.1 0.2\n1 2\n", "a.txt, line 1: \"O.1\" is not a number"),
            ("acc\n1\nmore words\n", "a.txt, line 3: \"more\" is not a number"),
            ("0 1\n1,,2\n", "a.txt, line 2: \"\" is an empty cell"),
            ("0 1\n2\n", "a.txt, line 2: number of columns 1, expected 2 as above"),
            ("1\n0 1\n", "a.txt, line 2: number of columns 2, expected 1 as above"),
            ("1 2 3\n", "a.txt, line 1: number of columns 3, expected 1 (acceleration) or 2 (time, acceleration)"),
            ("", "a.txt: too few samples: 0; an accelerogram needs at least 2"),
            ("# only\n0.5 1\n", "a.txt: too few samples: 1; an accelerogram needs at least 2"),
        ] {
            assert_eq!(message(text, Some(0.01)), expected);
        }
    }
}
