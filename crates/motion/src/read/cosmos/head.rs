//! What the head of a COSMOS component says.

use crate::error::MotionError;
use crate::read::date::seconds_since_1970;
use crate::read::head::Source;
use crate::read::volume::{
    FileUnit, after, behind, event_name, has, leading_number, magnitude, moment_s, orientation, origin_time,
    plausible_magnitude, stated_peak, words,
};
use crate::recording::{Orientation, RecordingDescription};

/// Most lines of text that are kept; there should be 13.
const MOST_LINES: usize = 100;

/// Most words of a line that is read again for every header value.
const MOST_WORDS: usize = 100;

/// Head of a component: everything above its data line.
pub(super) struct Head<'a> {
    /// First line, e.g. "Corrected acceleration    (Format v01.20 with 13 text lines)".
    title: &'a str,
    /// The lines of text after the first.
    lines: Vec<&'a str>,
    /// Integer-header values; NaN where one cannot be read.
    pub(super) integers: Vec<f64>,
    /// Real-header values; NaN where one cannot be read.
    pub(super) reals: Vec<f64>,
    /// Station, channel, network and location in a comment.
    scnl: Option<&'a str>,
    /// Whether a data line followed.
    pub(super) has_data: bool,
    /// Whether they are accelerations.
    pub(super) has_acceleration: bool,
}

impl<'a> Head<'a> {
    pub(super) fn new(title: &'a str) -> Self {
        Self {
            title,
            lines: Vec::new(),
            integers: Vec::new(),
            reals: Vec::new(),
            scnl: None,
            has_data: false,
            has_acceleration: false,
        }
    }

    /// Takes a line of text; what follows the header values is no longer of interest.
    pub(super) fn text(&mut self, line: &'a str) {
        if self.integers.is_empty() && !self.has_data && self.lines.len() < MOST_LINES {
            self.lines.push(line);
        }
    }

    /// Takes a comment, of which only `|<SCNL>BMR.BNZ.AK.--` counts.
    pub(super) fn comment(&mut self, line: &'a str) {
        if let Some(rest) = after(line, "<scnl>") {
            self.scnl = rest.split_whitespace().next();
        }
    }

    /// What a component without data line holds instead.
    ///
    /// # Errors
    ///
    /// [`MotionError::HeaderLacks`] where there should have been accelerations.
    pub(super) fn without_data(&self, source: Source) -> Result<Option<String>, MotionError> {
        if self.has_data {
            Ok(None)
        } else if self.is_acceleration() {
            Err(source.lacks(
                "data line like \"14000 acceleration pts, approx 140 secs, units=cm/sec2 (04), Format=(8F10.5)\"",
            ))
        } else {
            Ok(words(self.quantity()))
        }
    }

    /// Whether the first line names accelerations.
    pub(super) fn is_acceleration(&self) -> bool {
        has(self.quantity(), "acc")
    }

    /// Whether the data are raw or uncorrected: by the first line, or by processing stage 0 or 1.
    fn is_unprocessed(&self) -> bool {
        let in_words = ["uncorrected", "raw"].into_iter().any(|word| has(self.quantity(), word));
        in_words || self.integer(1).is_some_and(|stage| stage < 2.0)
    }

    /// "Corrected acceleration" and its like.
    fn quantity(&self) -> &'a str {
        self.title.split('(').next().unwrap_or("")
    }

    /// Real-header value `number`, counted from one, if it is known.
    pub(super) fn real(&self, number: usize) -> Option<f64> {
        self.known(&self.reals, number)
    }

    /// Integer-header value `number`, counted from one, if it is known.
    pub(super) fn integer(&self, number: usize) -> Option<f64> {
        self.known(&self.integers, number)
    }

    fn known(&self, values: &[f64], number: usize) -> Option<f64> {
        // Version 1.00 had other tables.
        let version = after(self.title, "(format v").and_then(leading_number);
        if version.is_some_and(|version| version < 1.1) {
            return None;
        }
        // What stands for unknown is on the last line of text.
        let line = self.line("values used").and_then(|line| line.split_once(':'));
        let words = line.map_or("", |(_, numbers)| numbers).split([',', ' ']).take(MOST_WORDS);
        let mut unknown = words.filter_map(|word| word.trim().parse().ok());
        let value = *values.get(number.checked_sub(1)?)?;
        (value.is_finite() && value != -999.0 && !unknown.any(|unknown: f64| unknown == value)).then_some(value)
    }

    /// What follows `key` (in small letters) on the first line that begins with it.
    fn line(&self, key: &str) -> Option<&'a str> {
        self.lines.iter().find_map(|line| behind(line.trim_start(), key))
    }

    /// The peak that the head states: real-header value 64 in the unit of the data, else the text.
    pub(super) fn stated_peak(&self, unit: FileUnit) -> Option<(f64, FileUnit)> {
        let in_text = || {
            let line = self.lines.iter().find(|line| has(line, "max") && !has(line, "uncor max"))?;
            stated_peak(after(line, "max")?)
        };
        self.real(64).map(|value| (value, unit)).or_else(in_text)
    }

    /// What the head says beside the motion.
    pub(super) fn describe(&self) -> RecordingDescription {
        let [code, channel, network, location] = self.scnl_parts();
        let unprocessed = self.is_unprocessed();
        let hypocentre = self.line("hypocenter");
        let magnitude =
            || [13, 15, 14, 16].into_iter().find_map(|number| self.real(number).and_then(plausible_magnitude));
        let station = code.map(|code| network.map_or(code.to_owned(), |network| format!("{network}.{code}")));
        let (station_code, station_name) = self.station();
        let sensor_text = self.line("sta cha").and_then(|line| after(line, "location:")).and_then(words);
        let low_cut = || self.lines.iter().find_map(|line| leading_number(after(line, "filtered below")?));
        RecordingDescription {
            event: self.lines.first().and_then(|line| event_name(line)),
            event_time: self.line("origin:").and_then(origin_time),
            magnitude: magnitude().or_else(|| hypocentre.and_then(self::magnitude)),
            epicentral_distance_km: self.real(17).filter(|&distance_km| distance_km >= 0.0),
            station: station.as_deref().and_then(words).or(station_code),
            station_name,
            // Some writers give km/s.
            vs30_m_s: self.real(4).filter(|&v| v > 0.0).map(|v| if v < 10.0 { 1000.0 * v } else { v }),
            sensor: location.and_then(words).or(sensor_text),
            channel: channel.and_then(words).or_else(|| Some(format!("Chan {}", words(self.channel_line()?)?))),
            orientation: self.orientation(channel),
            low_cut_hz: self.real(54).or_else(low_cut).filter(|&corner_hz| !unprocessed && corner_hz > 0.0),
            start_time_s: self.start_time_s(),
            unprocessed,
            ..RecordingDescription::default()
        }
    }

    /// Station, channel, network and location, those that are given.
    fn scnl_parts(&self) -> [Option<&'a str>; 4] {
        let mut parts =
            self.scnl.unwrap_or("").split('.').map(|part| Some(part).filter(|part| !part.trim_matches('-').is_empty()));
        std::array::from_fn(|_| parts.next().flatten())
    }

    /// Code and name of the station: `Statn No: 01-23075  Code:CE-J2236  CDMG Yucaipa - Bryant & Oak Glen`.
    fn station(&self) -> (Option<String>, Option<String>) {
        /// Column in which the name begins.
        const NAME: usize = 40;
        let Some(line) = self.line("statn no:") else {
            // Version 1.00: `Station: TCU071 CWB`
            return (self.line("station:").and_then(|rest| rest.split_whitespace().next()).and_then(words), None);
        };
        let (number, rest) = after(line, "code:")
            .map_or((line, ""), |rest| (line.get(..line.len() - rest.len() - "code:".len()).unwrap_or(""), rest));
        let code = rest.split_whitespace().next().unwrap_or("").trim_matches('-').replacen('-', ".", 1);
        let number: String = number.split_whitespace().collect();
        let name: String = line.chars().skip(NAME - "statn no:".len()).collect();
        (words(&code).or_else(|| words(&number)), words(&name))
    }

    /// `1: 340 deg` of `Sta Chan   1: 340 deg (Rcrdr Chan  1) Location: ...`.
    fn channel_line(&self) -> Option<&'a str> {
        let line = self.line("sta cha")?;
        let line = line.strip_prefix(['n', 'N']).unwrap_or(line).trim_start_matches([':', ' ']);
        let end = line.to_ascii_lowercase().find("location").unwrap_or(line.len());
        line.get(..end)?.split('(').next()
    }

    /// The direction in words on the same line.
    fn direction(&self) -> Option<Orientation> {
        let line = self.channel_line()?;
        // A number alone is that of the channel.
        let number_end = line.find(|c: char| !(c.is_ascii_digit() || c == '?'))?;
        orientation(line.get(number_end..)?)
    }

    /// The direction by name, by code (integer-header value 54), by letter, and in words.
    fn orientation(&self, channel: Option<&str>) -> Option<Orientation> {
        let letter = channel.filter(|channel| channel.len() == 3).and_then(|channel| channel.chars().next_back());
        let by_letter = match letter {
            // Processing programs give vertical channels an azimuth of zero or 360.
            Some('Z') => return Some(Orientation::Vertical),
            Some('N') => Some(Orientation::Azimuth(0.0)),
            Some('E') => Some(Orientation::Azimuth(90.0)),
            Some('1' | 'X') => Some(Orientation::Horizontal(1)),
            Some('2' | 'Y') => Some(Orientation::Horizontal(2)),
            _ => None,
        };
        let by_code = self.integer(54).and_then(|code| match code {
            1.0..=360.0 => Some(Orientation::Azimuth(code)),
            400.0..=402.0 => Some(Orientation::Vertical),
            500.0 | 600.0 | 700.0 => Some(Orientation::Horizontal(1)),
            501.0 | 601.0 | 701.0 => Some(Orientation::Horizontal(2)),
            _ => None,
        });
        by_code.or(by_letter).or_else(|| self.direction())
    }

    /// Time of the first sample: integer-header values 40 and 42 to 45 and real-header value 30, else
    /// the text.
    fn start_time_s(&self) -> Option<f64> {
        let whole =
            |number| self.integer(number).filter(|value| (0.0..10_000.0).contains(value) && value.fract() == 0.0);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // within range, see above
        let small = |number| whole(number).map(|value| value as u32);
        let by_values = || {
            let (year, month, day) = (small(40)?, small(42)?, small(43)?);
            seconds_since_1970(year.into(), month, day, small(44)?, small(45)?, self.real(30)?)
        };
        by_values().or_else(|| self.line("rcrd start time:").and_then(moment_s))
    }
}
