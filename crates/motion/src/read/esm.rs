//! ASCII files of the Engineering Strong Motion database and of ITACA, the Italian archive.
//!
//! A head of lines `KEY: value`, then one acceleration a line. Number and order of the keys differ between
//! the versions of the head (43 lines in the first ITACA files, 55 in DYNA 1.0, 64 in DYNA 1.2), so each is
//! sought by its name. The same head stands above velocities, displacements and response spectra: only
//! `DATA_TYPE` tells them apart.
//!
//! # Source
//!
//! User information of ITACA (names of files, streams and types of data); heads of files DYNA 1.2 of the
//! Engineering Strong Motion database, <https://esm-db.eu>.

use super::date::moment;
use super::head::Source;
use super::number::parse_number;
use super::{ReadOptions, decode, excerpt};
use crate::error::MotionError;
use crate::recording::{Orientation, RecordFormat, Recording, RecordingDescription};
use crate::unit::AccelerationUnit;

/// Number of lines above which no head goes (64 in the longest known).
const LONGEST_HEAD: usize = 200;

/// Whether a line has a key that only these files have.
pub(super) fn looks_like(head: &str) -> bool {
    let own = ["EVENT_DATE_YYYYMMDD", "SAMPLING_INTERVAL_S"];
    head.lines().take(LONGEST_HEAD).filter_map(|line| line.split_once(':')).any(|(key, _)| own.contains(&key.trim()))
}

/// Reads a file of accelerations.
///
/// The unit is that of the head, or else that of `options`. Raw is a record whose head says that its baseline
/// was not corrected and names no filter.
///
/// # Errors
///
/// [`MotionError::NoAcceleration`] and [`MotionError::NotAcceleration`] for velocities, displacements and
/// spectra; [`MotionError::HeaderLacks`] without time step or number of values, [`MotionError::HeaderValue`]
/// where one cannot be read; [`MotionError::HeaderUnit`], [`MotionError::MissingUnit`];
/// [`MotionError::Number`], [`MotionError::CutNumber`], [`MotionError::PointCount`]; [`MotionError::InFile`] where the
/// values make no accelerogram, [`MotionError::Gravity`].
pub(super) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Recording, MotionError> {
    let text = decode(bytes);
    let source = Source { name, format: RecordFormat::Esm };
    let head = Head::parse(&text);
    head.check_data_type(name)?;
    let (line, step) = head.entry("SAMPLING_INTERVAL_S").ok_or_else(|| source.lacks("SAMPLING_INTERVAL_S"))?;
    let dt_s = parse_number(step)
        .ok_or_else(|| source.unreadable(line, "SAMPLING_INTERVAL_S", step, "SAMPLING_INTERVAL_S: 0.005000"))?;
    let (line, count) = head.entry("NDATA").ok_or_else(|| source.lacks("NDATA"))?;
    let point_count = count.parse().map_err(|_| source.unreadable(line, "NDATA", count, "NDATA: 19128"))?;
    let unit = head.unit(source, options)?;

    let values = source.all_numbers(&text, head.line_count, point_count)?;
    let accelerogram = options.accelerogram(name, dt_s, unit, values)?;
    Ok(Recording { accelerogram, unit, description: head.describe() })
}

/// The lines above the values.
struct Head<'a> {
    /// Line (counted from one), key and value of those that have a value.
    entries: Vec<(usize, &'a str, &'a str)>,
    /// Number of lines.
    line_count: usize,
}

impl<'a> Head<'a> {
    /// The head ends at the first line that is neither `KEY: value` nor words nor blank.
    fn parse(text: &'a str) -> Self {
        let mut head = Self { entries: Vec::new(), line_count: 0 };
        for line in text.lines().take(LONGEST_HEAD) {
            if let Some((key, value)) = line.split_once(':') {
                head.entries.push((head.line_count + 1, key.trim(), value.trim()));
            } else if !(line.trim().is_empty() || is_word(line)) {
                break;
            }
            head.line_count += 1;
        }
        head.entries.retain(|(_, _, value)| !(value.is_empty() || value.eq_ignore_ascii_case("none")));
        head
    }

    /// Line and value of `key`; none where it is missing or blank.
    fn entry(&self, key: &str) -> Option<(usize, &'a str)> {
        self.entries.iter().find(|(_, found, _)| *found == key).map(|&(line, _, value)| (line, value))
    }

    fn text(&self, key: &str) -> Option<String> {
        self.entry(key).map(|(_, value)| value.to_owned())
    }

    fn number(&self, key: &str) -> Option<f64> {
        self.entry(key).and_then(|(_, value)| parse_number(value))
    }

    /// Refuses what is not acceleration.
    fn check_data_type(&self, name: &str) -> Result<(), MotionError> {
        let Some((_, data_type)) = self.entry("DATA_TYPE") else { return Ok(()) };
        let mut words = data_type
            .split_whitespace()
            .map(str::to_uppercase)
            .filter(|word| !["PROCESSED", "UNPROCESSED", "CORRECTED", "UNCORRECTED"].contains(&word.as_str()));
        if words.next().as_deref() == Some("ACCELERATION") && words.next().is_none() {
            return Ok(());
        }
        let found = excerpt(&data_type.to_lowercase());
        Err(MotionError::NoAcceleration { name: name.to_owned(), format: RecordFormat::Esm, found })
    }

    fn unit(&self, source: Source, options: &ReadOptions) -> Result<AccelerationUnit, MotionError> {
        let Some((line, word)) = self.entry("UNITS") else { return options.unit_or(None, source.name) };
        word.parse().map_err(|_| {
            if ["cm/s", "m/s", "cm", "m"].contains(&word.to_lowercase().as_str()) {
                MotionError::NotAcceleration { name: source.name.to_owned(), line, text: excerpt(word) }
            } else {
                source.unknown_unit(line, word)
            }
        })
    }

    fn describe(&self) -> RecordingDescription {
        let positive = |key| self.number(key).filter(|value| *value > 0.0);
        let channel = self.text("STREAM").or_else(|| self.text("COMPONENT"));
        let station = self.text("STATION_CODE").map(|code| match self.text("NETWORK") {
            Some(network) => format!("{network}.{code}"),
            None => code,
        });
        let buried = self.number("SENSOR_DEPTH_M").is_some_and(|depth_m| depth_m > 0.0);
        RecordingDescription {
            event: self.text("EVENT_NAME").or_else(|| self.text("EVENT_ID")),
            event_time: self.event_time(),
            magnitude: ["MAGNITUDE_W", "MAGNITUDE_L", "MAGNITUDE_S"].into_iter().find_map(|key| self.number(key)),
            epicentral_distance_km: self.number("EPICENTRAL_DISTANCE_KM"),
            rupture_distance_km: None,
            station,
            station_name: self.text("STATION_NAME"),
            vs30_m_s: positive("VS30_M/S"),
            sensor: self.text("LOCATION").or_else(|| buried.then(|| "borehole".to_owned())),
            orientation: channel.as_deref().and_then(orientation),
            channel,
            low_cut_hz: positive("LOW_CUT_FREQUENCY_HZ"),
            start_time_s: self.start_time_s(),
            stated_pga_m_s2: self.number("PGA_CM/S^2").map(|pga_cm_s2| pga_cm_s2.abs() / 100.0),
            unprocessed: self.is_raw(),
        }
    }

    fn event_time(&self) -> Option<String> {
        let (_, date) = self.entry("EVENT_DATE_YYYYMMDD")?;
        Some(self.entry("EVENT_TIME_HHMMSS").map_or(date.to_owned(), |(_, time)| format!("{date}_{time}")))
    }

    /// The first sample. The first ITACA files say only its time of day: it is that nearest to the earthquake.
    fn start_time_s(&self) -> Option<f64> {
        if let Some((_, stated)) = self.entry("DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS") {
            return moment(stated);
        }
        let (_, date) = self.entry("EVENT_DATE_YYYYMMDD")?;
        let (_, time) = self.entry("TIME_FIRST_SAMPLE_S")?;
        let event_s = moment(&self.event_time()?)?;
        let day_s = 86_400.0;
        let start_s = moment(&format!("{date}_{time}"))?;
        Some(start_s - ((start_s - event_s) / day_s).round() * day_s)
    }

    fn is_raw(&self) -> bool {
        let says = |key, word: &str| self.entry(key).is_some_and(|(_, value)| value.to_uppercase().starts_with(word));
        let corrected =
            self.entry("BASELINE_CORRECTION").is_some() && !says("BASELINE_CORRECTION", "BASELINE NOT REMOVED");
        let filtered = ["FILTER_TYPE", "LOW_CUT_FREQUENCY_HZ", "HIGH_CUT_FREQUENCY_HZ"]
            .into_iter()
            .any(|key| self.entry(key).is_some());
        // What is left blank may have been done all the same.
        let stated = says("BASELINE_CORRECTION", "BASELINE NOT REMOVED") || says("DATA_TYPE", "UNPROCESSED");
        stated && !corrected && !filtered
    }
}

/// Whether a line without colon begins with a word, and not with what should be a number.
fn is_word(line: &str) -> bool {
    let word = line.split_whitespace().next().unwrap_or("").to_lowercase();
    word.starts_with(char::is_alphabetic) && !["nan", "inf", "infinity"].contains(&word.as_str())
}

/// Direction of a stream (its last letter) or of a component of the first ITACA files.
fn orientation(channel: &str) -> Option<Orientation> {
    let channel = channel.to_uppercase();
    match channel.as_str() {
        "NS" => return Some(Orientation::Azimuth(0.0)),
        "WE" | "EW" => return Some(Orientation::Azimuth(90.0)),
        "UP" | "UD" => return Some(Orientation::Vertical),
        _ => {}
    }
    match channel.chars().last()? {
        'N' => Some(Orientation::Azimuth(0.0)),
        'E' => Some(Orientation::Azimuth(90.0)),
        'Z' => Some(Orientation::Vertical),
        // Axes that are not those of the compass: 1 and 2, or 2 and 3, beside Z.
        '1' => Some(Orientation::Horizontal(1)),
        '2' => Some(Orientation::Horizontal(2)),
        '3' => Some(Orientation::Horizontal(3)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::date::seconds_since_1970;
    use super::*;

    const HEAD: &str = "EVENT_NAME: SOMEWHERE\nEVENT_ID: XX-1\nEVENT_DATE_YYYYMMDD: 20190728\n\
        EVENT_TIME_HHMMSS: 160908\nMAGNITUDE_W: 5.1\nMAGNITUDE_L: 4.6\nNETWORK: XX\nSTATION_CODE: ABC\n\
        STATION_NAME: Hall: north, Düzce\n\
        LOCATION: 00\nSENSOR_DEPTH_M: \nVS30_M/S: 560\nEPICENTRAL_DISTANCE_KM: 12.5\n\
        DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20190728_160919.870\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 3\n\
        STREAM: HNE\nUNITS: cm/s^2\nPGA_CM/S^2: -300.0\nBASELINE_CORRECTION: BASELINE REMOVED\n\
        FILTER_TYPE: BUTTERWORTH\nLOW_CUT_FREQUENCY_HZ: 0.100\nHEADER_FORMAT: DYNA 1.2\n\
        DATA_TYPE: ACCELERATION\nPROCESSING: manual\nUSER5: \n";
    const VALUES: &str = "100.000000\n-300.000000\n0.000000\n";

    fn read_text(text: &str) -> Result<Recording, MotionError> {
        read(text.as_bytes(), "A.ASC", &ReadOptions::default())
    }

    fn changed(from: &str, to: &str) -> String {
        assert!(HEAD.contains(from), "{from}");
        HEAD.replace(from, to) + VALUES
    }

    fn message(text: &str) -> String {
        read_text(text).unwrap_err().to_string()
    }

    #[test]
    fn everything_that_the_head_says() {
        let text = format!("{HEAD}{VALUES}");
        let Recording { accelerogram, description, .. } = read_text(&text).unwrap();
        assert_eq!(accelerogram.acceleration_m_s2(), [1.0, -3.0, 0.0]);
        assert_eq!(accelerogram.dt_s(), 0.005);
        let some = |text: &str| Some(text.to_owned());
        let expected = RecordingDescription {
            event: some("SOMEWHERE"),
            event_time: some("20190728_160908"),
            magnitude: Some(5.1),
            epicentral_distance_km: Some(12.5),
            rupture_distance_km: None,
            station: some("XX.ABC"),
            station_name: some("Hall: north, Düzce"),
            vs30_m_s: Some(560.0),
            sensor: some("00"),
            channel: some("HNE"),
            orientation: Some(Orientation::Azimuth(90.0)),
            low_cut_hz: Some(0.1),
            start_time_s: seconds_since_1970(2019, 7, 28, 16, 9, 19.87),
            stated_pga_m_s2: Some(3.0),
            unprocessed: false,
        };
        assert_eq!(description, expected);
        assert!(looks_like(&text) && !looks_like("PEER\nNPTS= 3, DT= 0.1\n") && !looks_like(""));
        // Line ends of DOS, Latin-1 and byte order marks make no difference.
        let dos = text.replace('\n', "\r\n");
        let latin1: Vec<u8> = text.chars().map(|c| c as u8).collect();
        for bytes in [dos.clone().into_bytes(), format!("\u{feff}{dos}\x1a").into_bytes(), latin1] {
            assert_eq!(read(&bytes, "x", &ReadOptions::default()).unwrap().description, expected);
        }
    }

    #[test]
    fn what_is_blank_is_not_said() {
        let blank: String = HEAD
            .lines()
            .map(|line| match line.split_once(':').unwrap() {
                (key @ ("SAMPLING_INTERVAL_S" | "NDATA" | "UNITS"), value) => format!("{key}:{value}\n"),
                (key, _) => format!("{key}: \n"),
            })
            .collect();
        assert_eq!(read_text(&(blank + VALUES)).unwrap().description, RecordingDescription::default());
        let text = changed("MAGNITUDE_W: 5.1", "MAGNITUDE_W: ").replace("EVENT_NAME: SOMEWHERE", "EVENT_NAME: None");
        let text = text.replace("LOCATION: 00", "LOCATION: ").replace("SENSOR_DEPTH_M: ", "SENSOR_DEPTH_M: 30.0");
        let description = read_text(&text.replace("NETWORK: XX", "NETWORK: ")).unwrap().description;
        assert_eq!(description.magnitude, Some(4.6));
        assert_eq!(description.event.as_deref(), Some("XX-1"));
        assert_eq!(description.sensor.as_deref(), Some("borehole"));
        assert_eq!(description.station.as_deref(), Some("ABC"));
    }

    #[test]
    fn raw_records() {
        let raw = "BASELINE_CORRECTION: BASELINE NOT REMOVED";
        let bare = changed("BASELINE_CORRECTION: BASELINE REMOVED", raw)
            .replace("FILTER_TYPE: BUTTERWORTH", "FILTER_TYPE: ")
            .replace("LOW_CUT_FREQUENCY_HZ: 0.100", "LOW_CUT_FREQUENCY_HZ: ");
        for (text, unprocessed) in [
            (bare.clone(), true),
            (changed("BASELINE_CORRECTION: BASELINE REMOVED", raw), false),
            (bare.replace("NOT REMOVED", "REMOVED"), false),
            (bare.replace(raw, ""), false),
            (bare.replace(raw, "").replace("DATA_TYPE: ", "DATA_TYPE: UNPROCESSED "), true),
        ] {
            assert_eq!(read_text(&text).unwrap().description.unprocessed, unprocessed, "{text}");
        }
    }

    #[test]
    fn the_first_itaca_files() {
        let text = "EVENT_NAME: L'AQUILA\nEVENT_DATE_YYYYMMDD: 20090406\nEVENT_TIME_HHMMSS: 235950\nSTATION_CODE: AQG\n\
            TIME_FIRST_SAMPLE_S: 000005.500\nSAMPLING_INTERVAL_S: 0.005\nNDATA: 2\nCOMPONENT: WE\nUNITS: cm/s^2\n\
            DATA_TYPE: PROCESSED ACCELERATION\n1.0\n2.0\n";
        let Recording { accelerogram, description, .. } = read_text(text).unwrap();
        assert_eq!(accelerogram.acceleration_m_s2(), [0.01, 0.02]);
        assert_eq!(description.channel.as_deref(), Some("WE"));
        assert_eq!(description.orientation, Some(Orientation::Azimuth(90.0)));
        assert_eq!(description.start_time_s, seconds_since_1970(2009, 4, 7, 0, 0, 5.5));
    }

    #[test]
    fn directions() {
        for (stream, expected) in [
            ("HNN", Some(Orientation::Azimuth(0.0))),
            ("HGE", Some(Orientation::Azimuth(90.0))),
            ("HLZ", Some(Orientation::Vertical)),
            ("HN2", Some(Orientation::Horizontal(2))),
            ("HN3", Some(Orientation::Horizontal(3))),
            ("NS", Some(Orientation::Azimuth(0.0))),
            ("UP", Some(Orientation::Vertical)),
            ("HNX", None),
        ] {
            let found = read_text(&changed("STREAM: HNE", &format!("STREAM: {stream}"))).unwrap().description;
            assert_eq!(found.orientation, expected, "{stream}");
        }
    }

    #[test]
    fn other_quantities_are_refused() {
        for other in
            ["VELOCITY", "DISPLACEMENT", "ACCELERATION RESPONSE SPECTRUM", "PSEUDO-VELOCITY RESPONSE SPECTRUM", "SA"]
        {
            let found = message(&changed("DATA_TYPE: ACCELERATION", &format!("DATA_TYPE: {other}")));
            let expected = format!("no acceleration in this esm file, only {};", other.to_lowercase());
            assert!(found.contains(&expected), "{found}");
        }
        let silent = changed("DATA_TYPE: ACCELERATION\n", "").replace("UNITS: cm/s^2", "UNITS: cm/s");
        assert_eq!(message(&silent), "A.ASC, line 18: \"cm/s\": not an acceleration; give the acceleration file");
    }

    #[test]
    fn units() {
        let options = ReadOptions { unit: Some(AccelerationUnit::MPerS2), ..ReadOptions::default() };
        let read = |text: String| read(text.as_bytes(), "A.ASC", &options).map(|r| r.accelerogram.pga_m_s2());
        assert_eq!(read(changed("UNITS: cm/s^2", "UNITS: cm/s2")).unwrap(), 3.0);
        assert_eq!(read(changed("UNITS: cm/s^2", "UNITS: ")).unwrap(), 300.0);
        assert!(message(&changed("UNITS: cm/s^2", "UNITS: ")).contains("give the unit"));
        let unknown = message(&changed("UNITS: cm/s^2", "UNITS: counts"));
        assert!(unknown.contains("line 18: unknown acceleration unit in \"counts\""), "{unknown}");
    }

    #[test]
    fn damage() {
        for (text, expected) in [
            (String::new(), "no SAMPLING_INTERVAL_S"),
            (HEAD.to_owned(), "says 3 points, file has 0"),
            (changed("NDATA: 3", "NDATA: 4"), "says 4 points, file has 3"),
            (changed("NDATA: 3", "NDATA: 18446744073709551615"), "says 18446744073709551615 points"),
            (changed("NDATA: 3", "NDATA: 1e400"), "line 16: cannot read NDATA in \"1e400\""),
            (changed("NDATA: 3", "NDATA: -3"), "cannot read NDATA"),
            (changed("NDATA: 3\n", ""), "no NDATA"),
            (changed("0.005000", "0,005"), "line 15: cannot read SAMPLING_INTERVAL_S in \"0,005\""),
            (changed("0.005000", ""), "no SAMPLING_INTERVAL_S"),
            (changed("0.005000", "0.0"), "time step is 0 s"),
            (format!("{HEAD}1.0\nnan\n2.0\n"), "line 28: \"nan\" is not finite"),
            (format!("{HEAD}nan\n1.0\n2.0\n"), "line 27: \"nan\" is not finite"),
            (format!("{HEAD}1.0\n1e400\n2.0\n"), "line 28: \"1e400\" is too large"),
            (format!("{HEAD}1.0\nEVENT: x\n2.0\n"), "line 28: \"EVENT:\" is not a number"),
        ] {
            let found = message(&text);
            assert!(found.contains(expected), "{found}");
        }
        // However long it is, a head is not kept beyond the longest known.
        assert!(message(&"KEY: value\n".repeat(10_000)).contains("no SAMPLING_INTERVAL_S"));
    }
}
