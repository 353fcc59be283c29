//! ASCII files of K-NET and KiK-net, the strong motion networks of Japan.
//!
//! Seventeen lines of head, each with its name in the first 18 characters, then the counts of the digitiser,
//! eight a line. A count times the scale factor is an acceleration with an offset that nobody has removed.
//!
//! # Source
//!
//! National Research Institute for Earth Science and Disaster Resilience (NIED): About K-NET ASCII format,
//! and the like for KiK-net.

use super::date::moment;
use super::head::Source;
use super::number::parse_number;
use super::volume::behind;
use super::{ReadOptions, decode};
use crate::error::MotionError;
use crate::recording::{Orientation, RecordFormat, Recording, RecordingDescription};
use crate::unit::AccelerationUnit;

/// Number of lines above which no head goes (17 in the specification).
const LONGEST_HEAD: usize = 40;

/// Time by which the data logger is late \[s\]: the first sample was taken so much before the record time.
const TRIGGER_DELAY_S: f64 = 15.0;

/// FDSN code of the networks of NIED; the files do not say it.
const NETWORK: &str = "BO";

/// Whether two lines at least have a name that these files have.
pub(super) fn looks_like(head: &str) -> bool {
    let head = Head::parse(head);
    let own = ["Origin Time", "Station Code", "Sampling Freq", "Duration Time", "Scale Factor", "Last Correction"];
    own.into_iter().filter(|name| head.entry(name).is_some()).count() >= 2
}

/// Reads a file.
///
/// The mean of the whole record is removed, as NIED does to find the maximum acceleration that it states; the
/// file itself is raw. The number of values is at least sampling frequency times duration, and less than a
/// second more: the duration is in whole seconds. Start time is the stated record time less the trigger delay
/// of 15 s, in Japan standard time as every time of the file.
///
/// # Errors
///
/// [`MotionError::HeaderLacks`], [`MotionError::HeaderValue`] where frequency, duration or scale factor is
/// missing or cannot be read; [`MotionError::HeaderUnit`] where the scale factor is of another unit;
/// [`MotionError::Number`], [`MotionError::PointCount`]; [`MotionError::InFile`] where the values make no
/// accelerogram, [`MotionError::Gravity`].
pub(super) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Recording, MotionError> {
    let text = decode(bytes);
    let source = Source { name, format: RecordFormat::Knet };
    let head = Head::parse(&text);
    let frequency_hz = head.positive(source, "Sampling Freq(Hz)", "Hz", "Sampling Freq(Hz) 100Hz")?;
    let duration_s = head.positive(source, "Duration Time(s)", "s", "Duration Time(s)  102")?;
    let (factor, unit) = head.scale_factor(source)?;

    let mut values = Vec::new();
    for (index, line) in text.lines().enumerate().skip(head.line_count) {
        source.numbers(index + 1, line, &mut values)?;
    }
    check_count(source, frequency_hz, duration_s, values.len())?;
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    for value in &mut values {
        *value = (*value - mean) * factor;
    }
    let accelerogram = options.accelerogram(name, 1.0 / frequency_hz, unit, values)?;
    Ok(Recording { accelerogram, unit, description: head.describe() })
}

/// Refuses fewer values than the head states, or more by a second.
fn check_count(source: Source, frequency_hz: f64, duration_s: f64, found: usize) -> Result<(), MotionError> {
    let declared = (frequency_hz * duration_s).round();
    let surplus = found as f64 - declared;
    if (0.0..frequency_hz).contains(&surplus) {
        return Ok(());
    }
    // A number too large for its type is read as the largest.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    source.check_count(declared as u64, found)
}

/// The lines above the counts.
struct Head<'a> {
    lines: Vec<&'a str>,
    /// Their number.
    line_count: usize,
}

impl<'a> Head<'a> {
    /// The head ends after the line of the memo, or before the first that does not begin with a letter.
    fn parse(text: &'a str) -> Self {
        let mut lines = Vec::new();
        for line in text.lines().take(LONGEST_HEAD) {
            let start = line.trim_start();
            if !(start.is_empty() || start.starts_with(|c: char| c.is_ascii_alphabetic())) {
                break;
            }
            lines.push(start.trim_end());
            if behind(start, "Memo").is_some() {
                break;
            }
        }
        Self { line_count: lines.len(), lines }
    }

    /// Line (counted from one) and value behind `name`; none where it is missing or blank.
    fn entry(&self, name: &str) -> Option<(usize, &'a str)> {
        let mut lines = self.lines.iter().enumerate();
        lines
            .find_map(|(index, line)| Some((index + 1, behind(line, name)?.trim())))
            .filter(|(_, value)| !value.is_empty())
    }

    fn text(&self, name: &str) -> Option<String> {
        self.entry(name).map(|(_, value)| value.to_owned())
    }

    /// A number above zero, that `unit` may follow.
    fn positive(
        &self,
        source: Source,
        name: &'static str,
        unit: &str,
        expected: &'static str,
    ) -> Result<f64, MotionError> {
        let (line, value) = self.entry(name).ok_or_else(|| source.lacks(name))?;
        let digits = value.trim_end_matches(|c: char| unit.contains(c)).trim_end();
        parse_number(digits)
            .filter(|number| *number > 0.0)
            .ok_or_else(|| source.unreadable(line, name, value, expected))
    }

    /// Acceleration of one count, and its unit: "3920(gal)/6182761".
    fn scale_factor(&self, source: Source) -> Result<(f64, AccelerationUnit), MotionError> {
        let name = "Scale Factor";
        let (line, text) = self.entry(name).ok_or_else(|| source.lacks(name))?;
        let unreadable = || source.unreadable(line, name, text, "Scale Factor      3920(gal)/6182761");
        let (full_scale, rest) = text.split_once('(').ok_or_else(unreadable)?;
        let (word, counts) = rest.split_once(')').ok_or_else(unreadable)?;
        let counts = counts.trim_start().strip_prefix('/').ok_or_else(unreadable)?;
        let positive = |token: &str| parse_number(token.trim()).filter(|number| *number > 0.0);
        let factor = positive(full_scale).zip(positive(counts)).map(|(full, counts)| full / counts);
        let factor = factor.filter(|factor| factor.is_normal()).ok_or_else(unreadable)?;
        let unit = word.parse().map_err(|_| source.unknown_unit(line, text))?;
        Ok((factor, unit))
    }

    fn describe(&self) -> RecordingDescription {
        let number = |name| self.entry(name).and_then(|(_, value)| parse_number(value));
        let (channel, orientation, sensor) = self.entry("Dir.").map_or((None, None, None), |(_, dir)| component(dir));
        RecordingDescription {
            event_time: self.text("Origin Time"),
            magnitude: number("Mag."),
            station: self.text("Station Code").map(|code| format!("{NETWORK}.{code}")),
            sensor: sensor.map(str::to_owned),
            channel,
            orientation,
            start_time_s: self
                .entry("Record Time")
                .and_then(|(_, time)| moment(time))
                .map(|record_time_s| record_time_s - TRIGGER_DELAY_S),
            stated_pga_m_s2: number("Max. Acc. (gal)")
                .or(number("Max Acc. (gal)"))
                .map(|pga_gal| pga_gal.abs() / 100.0),
            unprocessed: true,
            ..RecordingDescription::default()
        }
    }
}

/// Channel, direction and sensor of a direction code: "N-S" and its like of K-NET, 1 to 6 of KiK-net (in files
/// named NS1, EW1, UD1, NS2, EW2, UD2), whose first three are at the bottom of a borehole.
fn component(dir: &str) -> (Option<String>, Option<Orientation>, Option<&'static str>) {
    let code = dir.replace('-', "").to_uppercase();
    let channel = match code.as_str() {
        "1" => "NS1",
        "2" => "EW1",
        "3" => "UD1",
        "4" => "NS2",
        "5" => "EW2",
        "6" => "UD2",
        other => other,
    };
    let sensor = match channel.get(2..) {
        Some("1") => Some("borehole"),
        Some("2") => Some("surface"),
        _ => None,
    };
    let orientation = match channel.trim_end_matches(['1', '2']) {
        "NS" => Some(Orientation::Azimuth(0.0)),
        "EW" => Some(Orientation::Azimuth(90.0)),
        "UD" => Some(Orientation::Vertical),
        _ => return (Some(dir.to_owned()), None, None),
    };
    (Some(channel.to_owned()), orientation, sensor)
}

#[cfg(test)]
mod tests {
    use super::super::date::seconds_since_1970;
    use super::*;

    /// Ten values a second for half a second.
    const FILE: &str = "Origin Time       2018/01/24 19:51:00\nLat.              41.0\nLong.             142.5\n\
        Depth. (km)       30\nMag.              6.2\nStation Code      ABC001\nStation Lat.      41.5\n\
        Station Long.     140.9\nStation Height(m) 39\nRecord Time       2018/01/24 19:51:05\n\
        Sampling Freq(Hz) 10Hz\nDuration Time(s)  0.5\nDir.              E-W\n\
        Scale Factor      2000(gal)/1000\nMax. Acc. (gal)   -16.000\nLast Correction   2018/01/24 19:51:00\n\
        Memo.             \n     100      102 \n     104     -106     -100 \n";

    fn read_text(text: &str) -> Result<Recording, MotionError> {
        read(text.as_bytes(), "A.NS", &ReadOptions::default())
    }

    fn changed(from: &str, to: &str) -> String {
        assert!(FILE.contains(from), "{from}");
        FILE.replace(from, to)
    }

    fn message(text: &str) -> String {
        read_text(text).unwrap_err().to_string()
    }

    #[test]
    fn everything_that_the_head_says() {
        let Recording { accelerogram, description, .. } = read_text(FILE).unwrap();
        // The mean of the counts is 20, and a count is 2 gal.
        assert_eq!(accelerogram.acceleration_m_s2(), [1.6, 1.64, 1.68, -2.52, -2.4]);
        assert_eq!(accelerogram.dt_s(), 0.1);
        let expected = RecordingDescription {
            event_time: Some("2018/01/24 19:51:00".into()),
            magnitude: Some(6.2),
            station: Some("BO.ABC001".into()),
            channel: Some("EW".into()),
            orientation: Some(Orientation::Azimuth(90.0)),
            start_time_s: seconds_since_1970(2018, 1, 24, 19, 50, 50.0),
            stated_pga_m_s2: Some(0.16),
            unprocessed: true,
            ..RecordingDescription::default()
        };
        assert_eq!(description, expected);
        assert!(looks_like(FILE) && !looks_like("Origin Time of the event\n1\n2\n") && !looks_like(""));
        let dos = FILE.replace('\n', "\r\n");
        for text in [dos.clone(), format!("\u{feff}{dos}\x1a"), FILE.replace("Max. Acc.", "Max Acc.")] {
            assert_eq!(
                read_text(&text).unwrap(),
                Recording {
                    accelerogram: accelerogram.clone(),
                    unit: AccelerationUnit::CmPerS2,
                    description: expected.clone()
                }
            );
        }
    }

    #[test]
    fn direction_codes() {
        for (dir, channel, orientation, sensor) in [
            ("N-S", "NS", Some(Orientation::Azimuth(0.0)), None),
            ("E-W", "EW", Some(Orientation::Azimuth(90.0)), None),
            ("U-D", "UD", Some(Orientation::Vertical), None),
            ("1", "NS1", Some(Orientation::Azimuth(0.0)), Some("borehole")),
            ("2", "EW1", Some(Orientation::Azimuth(90.0)), Some("borehole")),
            ("3", "UD1", Some(Orientation::Vertical), Some("borehole")),
            ("4", "NS2", Some(Orientation::Azimuth(0.0)), Some("surface")),
            ("5", "EW2", Some(Orientation::Azimuth(90.0)), Some("surface")),
            ("6", "UD2", Some(Orientation::Vertical), Some("surface")),
            ("7é", "7é", None, None),
        ] {
            let found = read_text(&changed("E-W", dir)).unwrap().description;
            assert_eq!((found.channel.as_deref(), found.orientation), (Some(channel), orientation));
            assert_eq!(found.sensor.as_deref(), sensor, "{dir}");
        }
    }

    #[test]
    fn the_count_follows_from_the_duration() {
        let file = |duration: &str, values: usize| {
            let head =
                FILE.split_inclusive('\n').take(17).collect::<String>().replace("  0.5", &format!("  {duration}"));
            head + &"5 ".repeat(values)
        };
        // Up to a second more, that the duration in whole seconds leaves out; nothing less.
        for values in [20, 21, 29] {
            assert_eq!(read_text(&file("2", values)).unwrap().accelerogram.len(), values);
        }
        for values in [0, 1, 10, 19, 30, 31] {
            let expected = format!("says 20 points, file has {values}:");
            assert!(message(&file("2", values)).contains(&expected), "{values}");
        }
        assert!(message(&file("1e300", 5)).contains("18446744073709551615 points"));
    }

    #[test]
    fn damage() {
        for (text, expected) in [
            (String::new(), "no Sampling Freq(Hz)"),
            (changed("Duration Time(s)  0.5\n", ""), "no Duration Time(s)"),
            (changed("2000(gal)/1000", ""), "no Scale Factor"),
            (changed("10Hz", "Hz"), "line 11: cannot read Sampling Freq(Hz) in \"Hz\""),
            (changed("10Hz", "-10Hz"), "cannot read Sampling Freq(Hz)"),
            (changed("10Hz", "0Hz"), "cannot read Sampling Freq(Hz)"),
            (changed("10Hz", "1e400Hz"), "cannot read Sampling Freq(Hz)"),
            (changed("  0.5", "  half"), "line 12: cannot read Duration Time(s)"),
            (changed("2000(gal)/1000", "2000(gal)/0"), "line 14: cannot read Scale Factor"),
            (changed("2000(gal)/1000", "2000/1000"), "cannot read Scale Factor"),
            (changed("2000(gal)/1000", "2000(gal)"), "cannot read Scale Factor"),
            (changed("2000(gal)/1000", "1e300(gal)/1e-300"), "cannot read Scale Factor"),
            (changed("(gal)/", "(kine)/"), "line 14: unknown acceleration unit in \"2000(kine)/1000\""),
            (changed("-106", "nan"), "line 19: \"nan\" is not finite"),
            (changed("     100  ", "     nan  "), "line 18: \"nan\" is not finite"),
            (changed("-106", "1e400"), "line 19: \"1e400\" is too large"),
            (changed("     104 ", " 1e308 1e308 "), "must be finite"),
            (changed("-106", "x"), "line 19: \"x\" is not a number"),
        ] {
            let found = message(&text);
            assert!(found.contains(expected), "{found}");
        }
    }
}
