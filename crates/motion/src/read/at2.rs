//! The AT2 layout of the PEER strong motion databases.
//!
//! Four lines of head, the third with the unit and the fourth with number of points and time
//! step, then the values row by row in fixed-width fields. The fourth line has two dialects,
//! `NPTS= 4000, DT= .0050 SEC` (what follows is free) and the older `4000 0.0050 NPTS, DT`.

use super::head::Source;
use super::number::parse_number;
use super::{ReadOptions, decode, excerpt};
use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::recording::{Orientation, RecordFormat, Recording, RecordingDescription};
use crate::unit::AccelerationUnit;

/// Number of lines among which the one with NPTS and DT is sought (it should be the fourth).
const LONGEST_HEAD: usize = 10;

/// Longest line that says event, date, station and component \[bytes\].
const LONGEST_EVENT: usize = 1000;

/// Head of an AT2 file.
#[derive(Debug, Clone, PartialEq)]
pub struct At2Header {
    /// Every line above the values, trimmed.
    pub lines: Vec<String>,
    /// Unit that the head states, if it does.
    pub unit: Option<AccelerationUnit>,
    /// Number of points.
    pub point_count: u64,
    /// Time step \[s\].
    pub dt_s: f64,
}

impl At2Header {
    /// The second line: by convention event, date, station and component.
    pub fn event(&self) -> &str {
        self.lines.get(1).map_or("", String::as_str)
    }
}

/// An AT2 file.
#[derive(Debug, Clone, PartialEq)]
pub struct At2Record {
    /// Its head.
    pub header: At2Header,
    /// The record.
    pub accelerogram: Accelerogram,
}

/// Reads an AT2 file from `bytes`; `name` stands in messages. Of `options` only gravity counts,
/// and the unit where the head says none.
///
/// # Errors
///
/// Head: [`MotionError::NoPointCount`], [`MotionError::HeaderValue`],
/// [`MotionError::NotAcceleration`], [`MotionError::HeaderUnit`], [`MotionError::MissingUnit`].
/// Values: [`MotionError::Number`], [`MotionError::CutNumber`], [`MotionError::PointCount`] where their number is not
/// NPTS.
/// [`MotionError::InFile`] where they make no [`Accelerogram`], [`MotionError::Gravity`].
pub fn read_at2(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<At2Record, MotionError> {
    let text = decode(bytes);
    let source = Source { name, format: RecordFormat::At2 };
    let header = parse_header(&text, source)?;
    let unit = options.unit_or(header.unit, name)?;
    let values = source.all_numbers(&text, header.lines.len(), header.point_count)?;
    let accelerogram = options.accelerogram(name, header.dt_s, unit, values)?;
    Ok(At2Record { header, accelerogram })
}

/// Reads an AT2 file; the second line of its head says "event, date, station, component".
pub(super) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Recording, MotionError> {
    let At2Record { header, accelerogram } = read_at2(bytes, name, options)?;
    let unit = options.unit_or(header.unit, name)?;
    Ok(Recording { description: describe(header.event()), accelerogram, unit })
}

/// Whether the head has a line with NPTS and DT.
pub(super) fn looks_like(head: &str) -> bool {
    head.lines().take(LONGEST_HEAD).any(is_point_line)
}

fn describe(event: &str) -> RecordingDescription {
    // Takes apart a line that can be one; the parts of another would take many times its memory.
    let event = if event.len() > LONGEST_EVENT { "" } else { event };
    let parts: Vec<&str> = event.split(',').map(str::trim).collect();
    let part = |index: usize| parts.get(index).filter(|part| !part.is_empty()).map(|&part| part.to_owned());
    // Names of stations may hold commas: the component is the last part, in degrees or in letters.
    let channel = if parts.len() > 3 { part(parts.len() - 1) } else { None };
    let station_name = (parts.len() > 3).then(|| parts[2..parts.len() - 1].join(", "));
    RecordingDescription {
        event: part(0),
        event_time: part(1),
        station_name,
        orientation: channel.as_deref().and_then(orientation),
        channel,
        ..RecordingDescription::default()
    }
}

/// The direction of a component as PEER names it.
fn orientation(component: &str) -> Option<Orientation> {
    let word = component.trim().to_uppercase();
    if ["UP", "DWN", "DOWN", "DN", "V", "VER", "VERT", "VERTICAL", "UD", "Z"].contains(&word.as_str()) {
        return Some(Orientation::Vertical);
    }
    word.parse::<f64>().ok().filter(|degrees| (0.0..=360.0).contains(degrees)).map(Orientation::Azimuth)
}

fn is_point_line(line: &str) -> bool {
    find_word(line, "NPTS").is_some() && find_word(line, "DT").is_some()
}

fn parse_header(text: &str, source: Source) -> Result<At2Header, MotionError> {
    let mut lines = Vec::new();
    let mut unit = None;
    for (index, line) in text.lines().take(LONGEST_HEAD).enumerate() {
        lines.push(line.trim().to_owned());
        if is_point_line(line) {
            let (point_count, dt_s) = parse_point_line(line, source, index + 1)?;
            return Ok(At2Header { lines, unit, point_count, dt_s });
        }
        // The title above may mention anything.
        if index > 0 && find_word(line, "UNITS").is_some() {
            unit = Some(parse_unit_line(line, source, index + 1)?);
        }
    }
    Err(MotionError::NoPointCount { name: source.name.to_owned(), searched: LONGEST_HEAD })
}

/// "ACCELERATION TIME SERIES IN UNITS OF G" and its like.
fn parse_unit_line(line: &str, source: Source, number: usize) -> Result<AccelerationUnit, MotionError> {
    let upper = line.to_ascii_uppercase();
    let other = ["VELOCITY", "DISPLACEMENT", "SPECTR"];
    if !upper.contains("ACC") && other.iter().any(|quantity| upper.contains(quantity)) {
        return Err(MotionError::NotAcceleration { name: source.name.to_owned(), line: number, text: excerpt(line) });
    }
    let after = find_word(line, "UNITS").map_or("", |end| &line[end..]);
    after
        .split(|c: char| c.is_whitespace() || ",;:=()[]".contains(c))
        .map(|word| word.trim_end_matches('.'))
        .find(|word| !word.is_empty() && !word.eq_ignore_ascii_case("of"))
        .and_then(|word| word.parse().ok())
        .ok_or_else(|| source.unknown_unit(number, line))
}

/// Number of points and time step \[s\].
fn parse_point_line(line: &str, source: Source, number: usize) -> Result<(u64, f64), MotionError> {
    let unreadable = |key| source.unreadable(number, key, line, "NPTS= 4000, DT= .0050 SEC");
    let (point_count, dt_s) = if let Some(assigned) = assigned_value(line, "NPTS") {
        (Some(assigned), assigned_value(line, "DT"))
    } else {
        let mut leading = line.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty());
        (leading.next(), leading.next())
    };
    let point_count = point_count.and_then(|token| token.parse().ok());
    let dt_s = dt_s.and_then(parse_number);
    Ok((point_count.ok_or_else(|| unreadable("NPTS"))?, dt_s.ok_or_else(|| unreadable("DT"))?))
}

/// The token after "`key` =" (or ":"). A comma ends it unless it continues into a digit: then it
/// is a decimal mark, and stays in the token so that it is refused.
fn assigned_value<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    let after = line[find_word(line, key)?..].trim_start();
    let value = after.strip_prefix(['=', ':'])?.trim_start();
    let mut chars = value.char_indices().peekable();
    while let Some((end, c)) = chars.next() {
        let continues = chars.peek().is_some_and(|(_, next)| next.is_ascii_digit());
        if !(c.is_ascii_digit() || "+-.eEdD".contains(c) || (c == ',' && continues)) {
            return Some(&value[..end]);
        }
    }
    Some(value)
}

/// Where `word` (in capitals) ends in `line`, written in any case and not inside another word.
fn find_word(line: &str, word: &str) -> Option<usize> {
    let bytes = line.as_bytes();
    let letter = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_alphabetic);
    (0..(bytes.len() + 1).saturating_sub(word.len()))
        .find(|&start| {
            bytes[start..start + word.len()].eq_ignore_ascii_case(word.as_bytes())
                && !letter(start.checked_sub(1).and_then(|before| bytes.get(before)))
                && !letter(bytes.get(start + word.len()))
        })
        .map(|start| start + word.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    const VALUES: &str = "  .1000000E-01 -.2000000E-01\n  .3000000E-01\n";

    fn file(unit_line: &str, point_line: &str, values: &str) -> String {
        format!("PEER STRONG MOTION DATABASE RECORD\nEvent, 1/2/1999, Düzce, 270\n{unit_line}\n{point_line}\n{values}")
    }

    fn read(text: &str) -> Result<At2Record, MotionError> {
        let options = ReadOptions { gravity_m_s2: 10.0, ..ReadOptions::default() };
        read_at2(text.as_bytes(), "RSN1.AT2", &options)
    }

    fn message(text: &str) -> String {
        read(text).unwrap_err().to_string()
    }

    const UNIT: &str = "ACCELERATION TIME SERIES IN UNITS OF G";
    const POINTS: &str = "NPTS=  3, DT=  0.005000 SEC";

    #[test]
    fn dialects_of_the_point_line() {
        for point_line in [
            POINTS,
            "NPTS= 3, DT= .00500 SEC",
            "NPTS=3,DT=.005SEC",
            "NPTS=   3, DT=   .0050 SEC,   4 POLE @    33.00000 HZ,  -5 POLE @      .07000",
            "npts = 3 , dt = 5.0D-03 sec",
            "NPTS: 3, DT: 0.005",
            "   3    0.0050    NPTS, DT",
            "3, .005, npts, dt",
        ] {
            let record = read(&file(UNIT, point_line, VALUES)).unwrap();
            assert_eq!(record.header.dt_s, 0.005, "{point_line}");
            assert_eq!(record.accelerogram.acceleration_m_s2(), [0.1, -0.2, 0.3]);
            assert_eq!(record.header.event(), "Event, 1/2/1999, Düzce, 270");
            assert_eq!(record.header.point_count, 3);
            assert_eq!(record.header.lines.len(), 4);
        }
    }

    #[test]
    fn encodings_and_line_ends() {
        let plain = read(&file(UNIT, POINTS, VALUES)).unwrap().accelerogram;
        let dos = file(UNIT, POINTS, VALUES).replace('\n', "\r\n") + "\r\n  \r\n\x1a";
        assert_eq!(read(&dos).unwrap().accelerogram, plain);
        assert_eq!(read(&format!("\u{feff}{dos}")).unwrap().accelerogram, plain);
        let latin1: Vec<u8> = file(UNIT, POINTS, VALUES).chars().map(|c| c as u8).collect();
        assert!(std::str::from_utf8(&latin1).is_err());
        let record = read_at2(&latin1, "x", &ReadOptions { gravity_m_s2: 10.0, ..ReadOptions::default() }).unwrap();
        assert_eq!(record.accelerogram, plain);
        assert!(record.header.event().contains("Düzce"));
    }

    #[test]
    fn units() {
        for (line, first_m_s2) in [
            ("Acceleration time history in units of g", 0.1),
            ("ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=30.0 Hz", 0.1),
            ("ACCELERATION TIME SERIES IN UNITS OF CM/SEC/SEC", 1e-4),
            ("Acceleration, units: m/s2", 0.01),
        ] {
            let record = read(&file(line, POINTS, VALUES)).unwrap();
            assert_eq!(record.accelerogram.acceleration_m_s2()[0], first_m_s2, "{line}");
        }
        assert_eq!(
            message(&file("VELOCITY TIME SERIES IN UNITS OF CM/S", POINTS, VALUES)),
            "RSN1.AT2, line 3: \"VELOCITY TIME SERIES IN UNITS OF CM/S\": not an acceleration; give the acceleration \
             file"
        );
        assert!(
            message(&file("DISPLACEMENT TIME SERIES IN UNITS OF CM", POINTS, VALUES)).contains("not an acceleration")
        );
        assert_eq!(
            message(&file("ACCELERATION TIME SERIES IN UNITS OF FT/S2", POINTS, VALUES)),
            "RSN1.AT2, line 3: unknown acceleration unit in \"ACCELERATION TIME SERIES IN UNITS OF FT/S2\"; known \
             units: g, m/s2, cm/s2, gal. Convert the values and correct the line, or remove the unit from the \
             line and give that of the values (--unit; unit in a manifest and in Python)"
        );
        assert!(message(&file("ACCELERATION IN UNITS OF", POINTS, VALUES)).contains("unknown acceleration unit"));

        // No unit in the file: the caller's.
        let silent = file("ACCELERATION TIME SERIES", POINTS, VALUES);
        assert!(message(&silent).contains("give the unit"));
        let options = ReadOptions { unit: Some(AccelerationUnit::MPerS2), ..ReadOptions::default() };
        let record = read_at2(silent.as_bytes(), "x", &options).unwrap();
        assert_eq!(record.accelerogram.acceleration_m_s2(), [0.01, -0.02, 0.03]);
    }

    #[test]
    fn wrong_counts_name_both() {
        let more = "NPTS=  4001, DT=  0.005000 SEC";
        assert_eq!(
            message(&file(UNIT, more, VALUES)),
            "RSN1.AT2: header says 4001 points, file has 3: the file is damaged or cut; get it again"
        );
        assert!(message(&file(UNIT, "NPTS= 2, DT= .005 SEC", VALUES)).contains("says 2 points, file has 3"));
        // No memory for what is only declared.
        let huge = "NPTS= 18446744073709551615, DT= .005 SEC";
        assert!(message(&file(UNIT, huge, VALUES)).contains("18446744073709551615 points, file has 3"));
    }

    #[test]
    fn bad_values_name_line_and_token() {
        for (values, line, token, reason) in [
            (".1 .2\nNaN\n", 6, "NaN", "is not finite"),
            (".1 inf .2\n", 5, "inf", "is not finite"),
            (".1\n.2\n.3x\n", 7, ".3x", "is not a number"),
            ("0,1 0,2 0,3\n", 5, "0,1", "is not a number: is its comma a decimal mark? Write a point"),
            (
                ".1 ****** .2",
                5,
                "******",
                "is a number too wide for its field: the program that wrote the file lost it",
            ),
        ] {
            assert_eq!(message(&file(UNIT, POINTS, values)), format!("RSN1.AT2, line {line}: \"{token}\" {reason}"));
        }
    }

    #[test]
    fn a_file_cut_within_a_number_is_called_cut() {
        assert_eq!(
            message(&file(UNIT, "NPTS= 9, DT= .005 SEC", ".1 .2\n.3 -.1700506E\n\n")),
            "RSN1.AT2, line 6: \"-.1700506E\" is not a number after 2 of 9 points: the file is cut; get it again"
        );
        // what follows shows that nothing is cut there
        let more = message(&file(UNIT, "NPTS= 9, DT= .005 SEC", ".1 .2E\n.3\n"));
        assert_eq!(more, "RSN1.AT2, line 5: \".2E\" is not a number");
    }

    #[test]
    fn bad_heads() {
        assert!(message("").contains("no line with NPTS and DT"));
        assert!(message("a\nb\nc\nWIDTH and INPTS\n1 2 3\n").contains("no line with NPTS and DT"));
        for (point_line, key) in [
            ("NPTS= , DT= .005 SEC", "NPTS"),
            ("NPTS= -3, DT= .005 SEC", "NPTS"),
            ("NPTS= 1e400, DT= .005 SEC", "NPTS"),
            ("NPTS= 3, DT= SEC", "DT"),
            ("NPTS= 3, DT= 0,005 SEC", "DT"),
            ("NPTS= 3, DT .005 SEC", "DT"),
            ("NPTS, DT 3 .005", "NPTS"),
            ("3 NPTS, DT .005", "DT"),
        ] {
            let found = message(&file(UNIT, point_line, VALUES));
            assert!(found.contains(&format!("line 4: cannot read {key} in \"{point_line}\"")), "{found}");
        }
        for dt in ["0.0", "-.005"] {
            let found = message(&file(UNIT, &format!("NPTS= 3, DT= {dt} SEC"), VALUES));
            assert!(found.contains("RSN1.AT2: time step is"), "{found}");
        }
        assert!(message(&file(UNIT, "NPTS= 0, DT= .005 SEC", "")).contains("at least 2"));
    }
}
