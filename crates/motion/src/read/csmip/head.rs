//! What the head of a component of CSMIP says.

use crate::error::MotionError;
use crate::read::ReadOptions;
use crate::read::fortran::{Format, read_header};
use crate::read::head::Source;
use crate::read::number::parse_number;
use crate::read::volume::{
    FileUnit, after, behind, event_name, has, leading_count, magnitude, moment_s, orientation, origin_time,
    stated_peak, words,
};
use crate::recording::RecordingDescription;

/// Lines of text and of header values of Volume 1.
const VOLUME_1_TEXT: usize = 13;
const VOLUME_1_HEAD: usize = VOLUME_1_TEXT + 7 + 7;

/// Most lines that are kept; the longest head, of Volume 2, has 45.
const MOST_LINES: usize = 100;

/// Which processing a file has seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Volume {
    /// Uncorrected accelerograms.
    One,
    /// Corrected accelerograms.
    Two,
    /// Response spectra.
    Three,
}

/// Head of a component: everything above its values.
pub(super) struct Head<'a> {
    volume: Volume,
    /// All lines from the title on.
    lines: Vec<&'a str>,
    /// Whether values followed.
    pub(super) has_data: bool,
    /// Whether they are accelerations.
    pub(super) has_acceleration: bool,
}

impl<'a> Head<'a> {
    pub(super) fn new(title: &'a str) -> Self {
        let volume = if has(title, "spectra") {
            Volume::Three
        } else if has(title, "uncorrected") {
            Volume::One
        } else {
            Volume::Two
        };
        Self { volume, lines: vec![title], has_data: false, has_acceleration: false }
    }

    /// Whether a title would begin another component: each volume repeats those of the lower ones.
    pub(super) fn is_past_titles(&self) -> bool {
        self.lines.len() > 3
    }

    /// Takes a line; what follows the first values is not of interest.
    pub(super) fn line(&mut self, line: &'a str) {
        if !self.has_data && self.lines.len() < MOST_LINES {
            self.lines.push(line);
        }
    }

    /// What a component without values holds instead.
    ///
    /// # Errors
    ///
    /// [`MotionError::HeaderLacks`] where there should have been accelerations.
    pub(super) fn without_data(&self, source: Source) -> Result<Option<&'static str>, MotionError> {
        match self.volume {
            _ if self.has_data => Ok(None),
            Volume::Three => Ok(Some("response spectra")),
            Volume::One | Volume::Two => Err(source.lacks(
                "data line like \"12000 points of accel data equally spaced at .005 sec, in cm/sec2. (8f10.6)\"",
            )),
        }
    }

    /// Whether the whole head of a film record is there and `next`, the line after it, has values.
    pub(super) fn pairs_follow(&self, next: &str) -> bool {
        let is_number = |token: &str| parse_number(token).is_some();
        self.volume == Volume::One
            && !self.has_data
            && self.lines.len() == VOLUME_1_HEAD
            && next.split_whitespace().next().is_some_and(is_number)
            && !next.contains(|c: char| c.is_ascii_alphabetic())
    }

    /// What follows `key` (in small letters) on the first line that has it.
    fn after(&self, key: &str) -> Option<&'a str> {
        self.lines.iter().find_map(|line| after(line, key))
    }

    /// What follows `key` (in small letters) on the first line that begins with it.
    fn line_after(&self, key: &str) -> Option<&'a str> {
        self.lines.iter().find_map(|line| behind(line.trim_start(), key))
    }

    /// `NO. OF POINTS =  12080`
    pub(super) fn point_count(&self) -> Option<u64> {
        leading_count(self.after("no. of points")?.trim_start_matches([' ', '=', ':']))
    }

    /// The unit that the text of Volume 1 names, else the caller's.
    ///
    /// # Errors
    ///
    /// [`MotionError::MissingUnit`].
    pub(super) fn unit_or(&self, source: Source, options: &ReadOptions) -> Result<FileUnit, MotionError> {
        let named = self.after("units of").map(|text| text.split("  ").next().unwrap_or(text));
        let given = || Ok(FileUnit { unit: options.unit_or(None, source.name)?, factor: 1.0 });
        named.and_then(FileUnit::find).map_or_else(given, Ok)
    }

    /// The peak that the head states. Volume 1 prints it to a thousandth of g; its real-header value 7
    /// has more digits.
    pub(super) fn stated_peak(&self) -> Option<(f64, FileUnit)> {
        const HALF_PRINTED_DIGIT: f64 = 0.000_5;
        if self.volume == Volume::Two {
            return stated_peak(self.after("peak acceleration")?);
        }
        let (printed, unit) = stated_peak(after(self.line_after("units of")?, "max")?)?;
        let mut first_reals = self.lines.get(VOLUME_1_TEXT + 7)?.lines().enumerate().peekable();
        let precise = read_header(&mut first_reals, Some(Format::from_width(10)), 8).get(6).copied();
        let same = |value: &f64| (value.abs() - printed.abs()).abs() <= HALF_PRINTED_DIGIT * 1.001;
        Some((precise.filter(same).unwrap_or(printed), unit))
    }

    /// What the head says beside the motion.
    pub(super) fn describe(&self) -> RecordingDescription {
        let (station, station_name) = self.station();
        let channel = self.line_after("chan").unwrap_or("").trim_start();
        let (number, direction) = channel.split_once(':').unwrap_or(("", ""));
        let mut direction_words = direction.split_whitespace();
        let first = direction_words.next().unwrap_or("");
        let is_degrees = parse_number(first).is_some();
        let second = direction_words.next().filter(|word| is_degrees && has(word, "deg"));
        let name = words(&format!("Chan {number}: {first} {}", second.unwrap_or("")));
        let titles = if self.volume == Volume::Two { 2 } else { 1 };
        RecordingDescription {
            event: self.lines.get(titles).and_then(|line| event_name(line)),
            event_time: self.origin_time(),
            magnitude: self.after("hypocenter").and_then(magnitude),
            station,
            station_name,
            sensor: sensor(direction),
            channel: name.filter(|_| !first.is_empty()),
            orientation: orientation(direction),
            low_cut_hz: self.low_cut_hz(),
            start_time_s: self.after("start time:").or_else(|| self.after("trigger time:")).and_then(moment_s),
            unprocessed: self.volume == Volume::One,
            ..RecordingDescription::default()
        }
    }

    /// `(ORIGIN(BRK): 05/02/83, 23:42:38.5 UTC)`
    fn origin_time(&self) -> Option<String> {
        let (_, time) = self.after("(origin")?.split_once(':')?;
        origin_time(time.trim_end().trim_end_matches(')'))
    }

    /// Number or code of the station, and the name on the line below. The identifier of the record,
    /// where it is one of a data centre (`15481673.CI.WLT.--.HN`), gives the network.
    fn station(&self) -> (Option<String>, Option<String>) {
        let keys = ["station no.", "station id."];
        let position =
            self.lines.iter().position(|line| keys.iter().any(|key| behind(line.trim_start(), key).is_some()));
        let Some((at, line)) = position.and_then(|at| Some((at, self.lines.get(at)?))) else { return (None, None) };
        let code = line.split_whitespace().nth(2).unwrap_or("");
        let identifier = self.lines.get(at.saturating_sub(1)).and_then(|line| line.split_whitespace().next());
        let mut parts = identifier.unwrap_or("").split('.').skip(1);
        let station = match (parts.next(), parts.next()) {
            (Some(network), Some(of_record)) if of_record == code => words(&format!("{network}.{code}")),
            _ => words(code),
        };
        let name = self.lines.get(at + 1).and_then(|line| line.trim().split("  ").next()).and_then(words);
        (station, name)
    }

    /// `bandpass filtered with 3 dB pts at   .30 and 40.00 cyc/sec`, or
    /// `WITH RAMPS AT  .050- .100 AND 23.00-25.00 CYC/SEC`, where the ramp ends at the corner.
    fn low_cut_hz(&self) -> Option<f64> {
        let band = after(self.after("filtered with")?, " at ")?;
        let low = band.get(..band.to_ascii_lowercase().find("and")?)?;
        let corner = low.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter_map(parse_number).next_back();
        corner.filter(|&corner_hz| corner_hz > 0.0)
    }
}

/// Where the sensor is, behind the direction: `360 Deg   (Sta Chn: 1)   Location: Roof - North`.
fn sensor(direction: &str) -> Option<String> {
    let text = match after(direction, "location:") {
        Some(text) => text,
        None => direction.trim_start().split_once("  ")?.1,
    };
    let text = text.trim();
    words(text.strip_prefix('(').and_then(|text| text.split_once(')')).map_or(text, |(_, text)| text))
}
