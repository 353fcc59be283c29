//! Volume 1 and 2 files of CSMIP, formerly CDMG.
//!
//! A component has lines of text, integer and real header values without words between them, a
//! data line with number of points, time step, unit and perhaps a FORTRAN format, and the values; in
//! Volume 2 velocities and displacements follow, which are passed over. Components follow one
//! another. Volume 1 of film records has no data line, but pairs of time and acceleration.
//!
//! # Source
//!
//! Shakal and Huang, Standard tape format for CSMIP strong-motion data tapes, report OSMS 85-03,
//! California Division of Mines and Geology (1985).

mod head;

use head::Head;

use super::fortran::{Format, NumberedLines, read_block};
use super::head::Source;
use super::volume::{FileUnit, after, has, leading_count, leading_number};
use super::{ReadOptions, decode};
use crate::error::MotionError;
use crate::recording::{RecordFormat, Recording};

/// Whether the beginning of a file has one of the titles.
pub(super) fn looks_like(head: &str) -> bool {
    head.lines().filter(|line| !line.trim().is_empty()).take(3).any(is_title)
}

/// Reads every acceleration component of a file.
///
/// # Errors
///
/// [`MotionError::HeaderLacks`], [`MotionError::HeaderValue`], [`MotionError::HeaderUnit`],
/// [`MotionError::MissingUnit`], [`MotionError::Number`], [`MotionError::PointCount`],
/// [`MotionError::UnevenTime`], [`MotionError::NoAcceleration`], [`MotionError::Gravity`], and
/// [`MotionError::InFile`] where values make no accelerogram.
pub(super) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Vec<Recording>, MotionError> {
    let text = decode(bytes);
    let source = Source { name, format: RecordFormat::Csmip };
    let mut lines = text.lines().enumerate().peekable();
    let mut recordings = Vec::new();
    let mut head: Option<Head> = None;
    let mut found = None;
    while let Some((index, line)) = lines.next() {
        let Some(current) = head.as_mut().filter(|head| !(is_title(line) && head.is_past_titles())) else {
            if is_title(line)
                && let Some(head) = head.replace(Head::new(line))
            {
                found = found.or(head.without_data(source)?);
            }
            continue;
        };
        if let Some(data_line) = DataLine::parse(line) {
            current.has_data = true;
            if data_line.is_acceleration() {
                source.begin_acceleration(&mut current.has_acceleration)?;
                recordings.push(data_line.component(source, options, current, index + 1, &mut lines)?);
            } else {
                found = found.or(Some("velocity or displacement"));
            }
        } else {
            current.line(line);
            if current.pairs_follow(lines.peek().map_or("", |(_, line)| line)) {
                current.has_data = true;
                recordings.push(component_of_pairs(source, options, current, &mut lines)?);
            }
        }
    }
    let head =
        head.ok_or_else(|| source.lacks("line with \"Corrected accelerogram\" or \"Uncorrected accelerogram\""))?;
    found = found.or(head.without_data(source)?);
    if recordings.is_empty() {
        let found = found.unwrap_or("something else").to_owned();
        return Err(MotionError::NoAcceleration { name: name.to_owned(), format: source.format, found });
    }
    Ok(recordings)
}

fn is_title(line: &str) -> bool {
    has(line, "corrected accelerogram") || has(line, "response and fourier amplitude spectra")
}

/// The line above the values, in one of its forms:
///
/// - `12000 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.6)`
/// - ` 3251 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)`
/// - `13200 Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)`
struct DataLine<'a> {
    line: &'a str,
    point_count: u64,
    /// What follows the word "at": time step or rate, unit and format.
    rest: &'a str,
}

impl<'a> DataLine<'a> {
    fn parse(line: &'a str) -> Option<Self> {
        let point_count = leading_count(line)?;
        let rest = after(line, "spaced at").or_else(|| after(line, "points at"))?;
        has(line, "points").then_some(Self { line, point_count, rest })
    }

    fn is_acceleration(&self) -> bool {
        has(self.line, "accel")
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
        let value = leading_number(self.rest)
            .ok_or_else(|| source.unreadable(number, "the time step", self.line, "equally spaced at .005 sec"))?;
        let is_rate = has(self.rest, "pts/sec") || has(self.rest, "samples/sec");
        let dt_s = if is_rate { 1.0 / value } else { value };
        let says_unit = has(self.rest, "unit") || has(self.rest, " in ");
        let unit = match FileUnit::find(self.rest) {
            Some(unit) => unit,
            None if says_unit => return Err(source.unknown_unit(number, self.line)),
            None => head.unit_or(source, options)?,
        };
        let values = read_block(source, lines, Format::find(self.line), self.point_count, 1)?;
        unit.recording((source.name, options), dt_s, values, head.describe(), head.stated_peak())
    }
}

/// Reads times and accelerations by turns, five pairs to a line. The times of film records are
/// seldom uniform.
fn component_of_pairs(
    source: Source,
    options: &ReadOptions,
    head: &Head,
    lines: &mut NumberedLines,
) -> Result<Recording, MotionError> {
    const PAIRS_IN_A_LINE: usize = 5;
    let point_count = head.point_count().ok_or_else(|| source.lacks("number of points"))?;
    let unit = head.unit_or(source, options)?;
    let first_line = lines.peek().map_or(0, |(index, _)| index + 1);
    let numbers = read_block(source, lines, Some(Format::from_width(7)), point_count, 2)?;
    let (pairs, _) = numbers.as_chunks::<2>();
    let (Some([begin_s, _]), Some([end_s, _])) = (pairs.first(), pairs.last()) else {
        return Err(source.lacks("value"));
    };
    let dt_s = (end_s - begin_s) / (pairs.len() as f64 - 1.0);
    let expected_s = |index: usize| begin_s + index as f64 * dt_s;
    let uneven = |&(index, &[time_s, _]): &(usize, &[f64; 2])| (time_s - expected_s(index)).abs() > 0.25 * dt_s;
    if let Some((index, &[time_s, _])) = pairs.iter().enumerate().find(uneven) {
        return Err(MotionError::UnevenTime {
            name: source.name.to_owned(),
            line: first_line + index / PAIRS_IN_A_LINE,
            time_s,
            expected_s: expected_s(index),
            dt_s,
            hint: ", or give its Volume 2 file",
        });
    }
    let values = pairs.iter().map(|&[_, value]| value).collect();
    unit.recording((source.name, options), dt_s, values, head.describe(), head.stated_peak())
}

#[cfg(test)]
mod tests;
