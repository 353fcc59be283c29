//! The COSMOS strong motion data format, version 1.
//!
//! A component has some lines of text, the first with `(Format v01.20 with 13 text lines)`, then
//! integer and real header values and comments, each under a line with their number, then a data
//! line with quantity, number of points, unit and FORTRAN format, then the values. Components
//! follow one another; velocities and displacements among them are passed over.
//!
//! # Source
//!
//! COSMOS Strong Motion Data Format, version 1.20, Consortium of Organizations for Strong-Motion
//! Observation Systems (2001).

mod head;

use head::Head;

use super::fortran::{Format, NumberedLines, read_block, read_header};
use super::head::Source;
use super::volume::{FileUnit, after, has, leading_count, leading_number, words};
use super::{ReadOptions, decode, excerpt};
use crate::error::MotionError;
use crate::recording::{RecordFormat, Recording};
use crate::unit::AccelerationUnit;

/// Whether the beginning of a file has the line that names the format.
pub(super) fn looks_like(head: &str) -> bool {
    head.lines().filter(|line| !line.trim().is_empty()).take(3).any(is_first_line)
}

/// Reads every acceleration component of a file.
///
/// # Errors
///
/// [`MotionError::HeaderLacks`], [`MotionError::HeaderValue`], [`MotionError::HeaderUnit`],
/// [`MotionError::MissingUnit`], [`MotionError::CountsWithoutScale`], [`MotionError::Number`],
/// [`MotionError::PointCount`], [`MotionError::NoAcceleration`], [`MotionError::Gravity`], and
/// [`MotionError::InFile`] where values make no accelerogram.
pub(super) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Vec<Recording>, MotionError> {
    let text = decode(bytes);
    let source = Source { name, format: RecordFormat::Cosmos };
    let mut lines = text.lines().enumerate().peekable();
    let mut recordings = Vec::new();
    let mut head: Option<Head> = None;
    let mut found = None;
    while let Some((index, line)) = lines.next() {
        if is_first_line(line) {
            if let Some(head) = head.take() {
                found = found.or(head.without_data(source)?);
            }
            head = Some(Head::new(line));
        } else if let Some(head) = &mut head {
            if let Some(data_line) = DataLine::parse(line) {
                head.has_data = true;
                if data_line.is_acceleration(head) {
                    source.begin_acceleration(&mut head.has_acceleration)?;
                    recordings.push(data_line.component(source, options, head, index + 1, &mut lines)?);
                } else {
                    found = found.or(words(data_line.quantity));
                }
            } else {
                read_head_line(line, head, &mut lines);
            }
        }
    }
    let head = head.ok_or_else(|| source.lacks("line with \"(Format v01.20 with 13 text lines)\""))?;
    found = found.or(head.without_data(source)?);
    if recordings.is_empty() {
        let found = found.unwrap_or_else(|| "something else".to_owned());
        return Err(MotionError::NoAcceleration { name: name.to_owned(), format: source.format, found });
    }
    Ok(recordings)
}

fn is_first_line(line: &str) -> bool {
    after(line, "(format v").is_some_and(|rest| has(rest, "text line"))
}

/// Reads a line between the first and the data line, with the header values under it.
fn read_head_line<'a>(line: &'a str, head: &mut Head<'a>, lines: &mut NumberedLines<'a>) {
    let header_count = leading_count(line).filter(|_| has(line, "header") && has(line, "value"));
    match header_count {
        Some(count) if has(line, "integer") => head.integers = read_header(lines, Format::find(line), count),
        Some(count) if has(line, "real") => head.reals = read_header(lines, Format::find(line), count),
        _ if line.trim_start().starts_with('|') => head.comment(line),
        _ => head.text(line),
    }
}

/// The line above the values: `14000 acceleration pts, approx 140 secs, units=cm/sec2 (04), Format=(8F10.5)`.
struct DataLine<'a> {
    line: &'a str,
    point_count: u64,
    /// What the points are, e.g. "raw accel."
    quantity: &'a str,
    /// What follows.
    rest: &'a str,
}

/// What the values of a data line are.
enum Unit {
    Acceleration(FileUnit),
    Counts,
}

impl<'a> DataLine<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let point_count = leading_count(line)?;
        let rest = after(line, "pts")?;
        let quantity = line.get(..line.len() - rest.len() - "pts".len())?;
        let quantity = quantity.trim_start().trim_start_matches(|c: char| c.is_ascii_digit()).trim();
        let is_data_line = ["unit", "sec", "format"].into_iter().any(|key| has(rest, key));
        is_data_line.then_some(Self { line, point_count, quantity, rest })
    }

    /// Whether the points are accelerations: as the line says, else the head.
    fn is_acceleration(&self, head: &Head) -> bool {
        let other = ["vel", "dis", "spect", "strain", "press", "rot", "ang"];
        has(self.quantity, "acc") || (!other.into_iter().any(|key| has(self.quantity, key)) && head.is_acceleration())
    }

    /// Reads the component under this line, the `number`th of the file.
    fn component(
        &self,
        source: Source,
        options: &ReadOptions,
        head: &Head,
        number: usize,
        lines: &mut NumberedLines,
    ) -> Result<Recording, MotionError> {
        let dt_s = self.time_step_s(source, head)?;
        let (unit, stated) = match self.unit(source, options, head, number)? {
            Unit::Acceleration(unit) => (unit, head.stated_peak(unit)),
            // The peak in counts holds the offset of the recorder.
            Unit::Counts => (self.scale_of_counts(source, head, number)?, None),
        };
        let values = read_block(source, lines, Format::find(self.line), self.point_count, 1)?;
        unit.recording((source.name, options), dt_s, values, head.describe(), stated)
    }

    /// The time step: real-header value 62 in milliseconds, else the rate on this line. It must make
    /// the rounded duration on this line, which also tells a value in seconds.
    fn time_step_s(&self, source: Source, head: &Head) -> Result<f64, MotionError> {
        let duration_s = after(self.rest, "approx").and_then(leading_number).filter(|&duration_s| duration_s >= 1.0);
        // Of a record that was cut or padded after the line was written, the duration is a rough one.
        let agrees = |dt_s: f64, factor: f64| {
            let ratio = duration_s.map(|duration_s| self.point_count as f64 * dt_s / duration_s);
            ratio.is_none_or(|ratio| ratio > factor.recip() && ratio < factor)
        };
        let value = head.real(62).filter(|&value| value > 0.0);
        let rate_hz = self.rest.split_once("pts/sec").and_then(|(before, _)| before.split_whitespace().next_back());
        let from_rate = rate_hz.and_then(|text| text.parse::<f64>().ok()).map(f64::recip);
        value
            .map(|value| value / 1000.0)
            .filter(|&dt_s| agrees(dt_s, 10.0))
            .or(value.filter(|&dt_s| agrees(dt_s, 2.0)))
            .or(from_rate.filter(|&dt_s| agrees(dt_s, 10.0)))
            .ok_or_else(|| {
                source
                    .lacks("time step (real-header value 62, in milliseconds) that agrees with its points and duration")
            })
    }

    /// The unit by name and by code (table 2 of the format), which may not contradict each other.
    fn unit(&self, source: Source, options: &ReadOptions, head: &Head, number: usize) -> Result<Unit, MotionError> {
        let unknown = || source.unknown_unit(number, self.line);
        let text = after(self.rest, "units").unwrap_or("");
        let text = text.trim_start_matches(|c: char| c.is_whitespace() || c == '=' || c == ':');
        let word = text.split(['(', ',']).next().unwrap_or("").trim();
        let code = text.get(word.len()..).unwrap_or("").trim_start();
        let code = code.strip_prefix('(').and_then(|code| code.split(')').next()?.trim().parse::<f64>().ok());
        let by_code = code.or_else(|| head.integer(3).filter(|_| word.is_empty())).and_then(unit_of_code);
        let by_word = match word.to_ascii_lowercase().as_str() {
            "" => None,
            "counts" | "count" => Some(Unit::Counts),
            word => Some(Unit::Acceleration(FileUnit::from_word(word).ok_or_else(unknown)?)),
        };
        match (by_word, by_code) {
            (Some(Unit::Acceleration(a)), Some(Unit::Acceleration(b))) if a != b => Err(unknown()),
            (Some(Unit::Acceleration(_)), Some(Unit::Counts)) | (Some(Unit::Counts), Some(Unit::Acceleration(_))) => {
                Err(unknown())
            }
            (Some(unit), _) | (None, Some(unit)) => Ok(unit),
            (None, None) if code.is_some() => Err(unknown()),
            (None, None) => Ok(Unit::Acceleration(FileUnit { unit: options.unit_or(None, source.name)?, factor: 1.0 })),
        }
    }

    /// The acceleration of one count: least significant bit of the recorder \[µV\] by sensitivity of
    /// the sensor \[V/g\] and its gain, real-header values 22, 42 and 47.
    fn scale_of_counts(&self, source: Source, head: &Head, number: usize) -> Result<FileUnit, MotionError> {
        let positive = |index| head.real(index).filter(|&value| value > 0.0);
        let scale = || {
            let factor = positive(22)? * 1e-6 / (positive(42)? * positive(47).unwrap_or(1.0));
            (factor.is_finite() && factor > 0.0).then_some(FileUnit { unit: AccelerationUnit::G, factor })
        };
        scale().ok_or_else(|| MotionError::CountsWithoutScale {
            name: source.name.to_owned(),
            line: number,
            text: excerpt(self.line),
        })
    }
}

/// Table 2 of the format.
fn unit_of_code(code: f64) -> Option<Unit> {
    let (unit, factor) = match code {
        2.0 => (AccelerationUnit::G, 1.0),
        4.0 | 10.0 => (AccelerationUnit::CmPerS2, 1.0),
        7.0 => (AccelerationUnit::CmPerS2, 2.54),
        11.0 => (AccelerationUnit::G, 1e-3),
        12.0 => (AccelerationUnit::G, 1e-6),
        50.0 => return Some(Unit::Counts),
        _ => return None,
    };
    Some(Unit::Acceleration(FileUnit { unit, factor }))
}

#[cfg(test)]
mod tests;
