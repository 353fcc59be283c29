//! Words in the text heads of strong motion volumes: the layouts of CSMIP and COSMOS descend from
//! the one of Caltech and say the same things in the same words.

use super::ReadOptions;
use super::date::seconds_since_1970;
use super::number::parse_number;
use crate::error::MotionError;
use crate::recording::{Orientation, Recording, RecordingDescription};
use crate::unit::AccelerationUnit;

/// What is after `key` (in small letters) in `text`, written in any case.
pub(super) fn after<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    // Small ASCII letters stand at the same places as the capital ones.
    let at = text.to_ascii_lowercase().find(key)?;
    text.get(at + key.len()..)
}

/// What is behind `key` at the beginning of `text`, written in any case.
pub(super) fn behind<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    text.get(..key.len()).filter(|begin| begin.eq_ignore_ascii_case(key))?;
    text.get(key.len()..)
}

/// Whether `text` has `key` (in small letters), written in any case.
pub(super) fn has(text: &str, key: &str) -> bool {
    after(text, key).is_some()
}

/// `text` with single blanks and of moderate length; none where nothing is left.
pub(super) fn words(text: &str) -> Option<String> {
    const LONGEST: usize = 80;
    let mut result = String::new();
    for word in text.split_whitespace().take(LONGEST) {
        if !result.is_empty() {
            result.push(' ');
        }
        result.extend(word.chars().take(LONGEST));
    }
    if let Some((end, _)) = result.char_indices().nth(LONGEST) {
        result.truncate(end);
    }
    (!result.is_empty()).then_some(result)
}

/// The whole number at the beginning of a line.
pub(super) fn leading_count(line: &str) -> Option<u64> {
    let line = line.trim_start();
    let digits = line.split(|c: char| !c.is_ascii_digit()).next()?;
    // More points than can be counted are too many all the same.
    (!digits.is_empty()).then(|| digits.parse().unwrap_or(u64::MAX))
}

/// The number at the beginning of `text`, behind blanks and signs of equality.
pub(super) fn leading_number(text: &str) -> Option<f64> {
    let text = text.trim_start_matches(|c: char| c.is_whitespace() || c == '=' || c == ':');
    let end = text.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).unwrap_or(text.len());
    parse_number(text.get(..end)?)
}

/// A unit of acceleration, and by how much one of the file is more than one of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FileUnit {
    pub(super) unit: AccelerationUnit,
    pub(super) factor: f64,
}

impl FileUnit {
    /// The unit called `word`; beside those of [`AccelerationUnit`] the ones that only volumes have.
    pub(super) fn from_word(word: &str) -> Option<Self> {
        let word = word.trim().trim_end_matches('.').to_ascii_lowercase();
        let (unit, factor) = match word.as_str() {
            "mg" => (AccelerationUnit::G, 1e-3),
            "ug" | "micro g" | "microg" => (AccelerationUnit::G, 1e-6),
            "g/10" => (AccelerationUnit::G, 0.1),
            "in/sec2" | "in/s2" | "in/s/s" | "in/sec/sec" => (AccelerationUnit::CmPerS2, 2.54),
            word => (word.parse().ok()?, 1.0),
        };
        Some(Self { unit, factor })
    }

    /// The first unit among the words of `text`.
    pub(super) fn find(text: &str) -> Option<Self> {
        text.split(|c: char| c.is_whitespace() || "(),;:=".contains(c)).find_map(Self::from_word)
    }

    /// `value`, in this unit, in m/s².
    pub(super) fn to_m_s2(self, value: f64, options: &ReadOptions) -> f64 {
        self.unit.to_m_s2(self.factor * value, options.gravity_m_s2)
    }

    /// The component of `values` in this unit, of the file `name`, with what its head says and the peak that it states.
    pub(super) fn recording(
        self,
        (name, options): (&str, &ReadOptions),
        dt_s: f64,
        mut values: Vec<f64>,
        description: RecordingDescription,
        stated: Option<(f64, Self)>,
    ) -> Result<Recording, MotionError> {
        if self.factor != 1.0 {
            for value in &mut values {
                *value *= self.factor;
            }
        }
        let accelerogram = options.accelerogram(name, dt_s, self.unit, values)?;
        let stated_pga_m_s2 = stated.map(|(value, unit)| unit.to_m_s2(value, options).abs());
        let description = RecordingDescription { stated_pga_m_s2, ..description };
        Ok(Recording { accelerogram, unit: self.unit, description })
    }
}

/// The peak that a text states, e.g. `=  77.280  cm/sec/sec  at`: value and unit.
pub(super) fn stated_peak(text: &str) -> Option<(f64, FileUnit)> {
    let value = leading_number(text)?;
    let number_end = text.find(|c: char| c.is_ascii_digit() || c == '.')?;
    let unit = text.get(number_end..)?.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    let unit = unit.split_whitespace().next()?.trim_end_matches(',');
    Some((value, FileUnit::from_word(unit)?))
}

/// The moment magnitude in a text like `ML=4.9, Mw=4.8(CIT)`, else another.
pub(super) fn magnitude(text: &str) -> Option<f64> {
    let lower = text.to_ascii_lowercase();
    ["mw", "ml", "ms", "mb", "md", "m"].into_iter().find_map(|key| {
        lower.match_indices(key).find_map(|(at, _)| {
            let alone = !lower.get(..at)?.ends_with(|c: char| c.is_ascii_alphanumeric());
            let rest = lower.get(at + key.len()..)?.trim_start();
            let value = leading_number(rest).filter(|_| alone && rest.starts_with(['=', ':']))?;
            plausible_magnitude(value)
        })
    })
}

/// A value that a magnitude can have.
pub(super) fn plausible_magnitude(value: f64) -> Option<f64> {
    (value > 0.0 && value < 11.0).then_some(value)
}

/// The direction in words: `340 deg`, `Up`, `H1`, `Tran`.
pub(super) fn orientation(text: &str) -> Option<Orientation> {
    let word = text.split(|c: char| c.is_whitespace() || ",;:(".contains(c)).find(|word| !word.is_empty())?;
    if let Some(degrees) = parse_number(word) {
        return (0.0..=360.0).contains(&degrees).then_some(Orientation::Azimuth(degrees));
    }
    match word.to_ascii_lowercase().as_str() {
        "up" | "down" | "dn" | "down." | "vert" | "vert." | "vertical" | "ud" | "z" => Some(Orientation::Vertical),
        "h1" | "long" | "long." | "longitudinal" | "radl" | "radial" => Some(Orientation::Horizontal(1)),
        "h2" | "tran" | "tran." | "trans" | "transverse" | "tang" | "tangential" => Some(Orientation::Horizontal(2)),
        _ => None,
    }
}

/// The moment in a text like `06/16/2005, 20:53:04.400 UTC` or `2018/11/30 17:29:39`, in seconds
/// since the beginning of 1970.
pub(super) fn moment_s(text: &str) -> Option<f64> {
    let text = text.split(|c: char| c.is_ascii_alphabetic() || c == '(').next()?;
    let mut parts = text.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter(|part| !part.is_empty());
    let first: u32 = parts.next()?.parse().ok()?;
    let second: u32 = parts.next()?.parse().ok()?;
    let third: u32 = parts.next()?.parse().ok()?;
    let (year, month, day) = if first > 31 { (first, second, third) } else { (third, first, second) };
    let hour = parts.next()?.parse().ok()?;
    let minute = parts.next()?.parse().ok()?;
    let seconds = parts.next().map_or(Some(0.0), parse_number)?;
    // The first accelerogram is of 1933.
    let year = match year {
        0..33 => year + 2000,
        33..100 => year + 1900,
        year => year,
    };
    seconds_since_1970(year.into(), month, day, hour, minute, seconds)
}

/// The origin time that stands in a text, if it has been determined.
pub(super) fn origin_time(text: &str) -> Option<String> {
    words(text).filter(|words| words.contains(|c: char| c.is_ascii_digit()) && !has(words, "determined"))
}

/// The name of the earthquake on the line that begins with it; date and time follow behind blanks,
/// or stand in place of the name.
pub(super) fn event_name(line: &str) -> Option<String> {
    const WEEKDAYS: [&str; 7] = ["mon ", "tue ", "wed ", "thu ", "fri ", "sat ", "sun "];
    let begins_with_weekday = |text: &str| {
        text.get(..4).is_some_and(|begin| WEEKDAYS.iter().any(|weekday| begin.eq_ignore_ascii_case(weekday)))
    };
    let line = line.trim();
    let rest = ["record of", "rcrd of"].into_iter().find_map(|key| behind(line, key));
    let mut name = rest.unwrap_or(line).trim_start();
    let date = name.match_indices(" of ").find(|(at, _)| name.get(at + 4..).is_some_and(begins_with_weekday));
    if let Some((at, _)) = date {
        name = name.get(..at)?;
    }
    let name = name.split("  ").next()?;
    words(name).filter(|name| !begins_with_weekday(name) && !name.eq_ignore_ascii_case("earthquake"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_any_kind() {
        assert_eq!(after("É Peak Acceleration = 1", "peak acceleration"), Some(" = 1"));
        assert_eq!(words("  a \t b  "), Some("a b".to_owned()));
        assert_eq!(words(" \t "), None);
        assert_eq!(words(&"é ".repeat(1000)).unwrap().chars().count(), 80);
        assert_eq!(words(&"é".repeat(1000)).unwrap().chars().count(), 80);
        assert_eq!(leading_count("  7000  acceleration"), Some(7000));
        assert_eq!(leading_count("99999999999999999999999 pts"), Some(u64::MAX));
        assert_eq!(leading_count("pts"), None);
        assert_eq!(leading_number(" =  -.167 g"), Some(-0.167));
        assert_eq!(leading_number(" nan"), None);
    }

    #[test]
    fn units() {
        let options = ReadOptions { gravity_m_s2: 10.0, ..ReadOptions::default() };
        for (text, m_s2) in [
            ("sec, in cm/sec2. (8f10.6)", 0.02),
            ("SEC.  (UNITS: CM/SEC/SEC)", 0.02),
            ("in units of g .      Format: (8f9.6)", 20.0),
            ("ARE SEC AND G/10.", 2.0),
            ("mg", 0.02),
            ("ug", 0.000_02),
            ("in/sec2", 0.0508),
            ("gal", 0.02),
        ] {
            let found = FileUnit::find(text).unwrap().to_m_s2(2.0, &options);
            assert!((found - m_s2).abs() < 1e-15, "{text}: {found}");
        }
        assert_eq!(FileUnit::find("spaced at .005 sec, in cm/sec. (8f10.7)"), None);
        let cm = FileUnit { unit: AccelerationUnit::CmPerS2, factor: 1.0 };
        assert_eq!(stated_peak(" =    77.280    cm/sec/sec  at   30.585"), Some((77.28, cm)));
        assert_eq!(stated_peak("=  -161.962 cm/sec2  at"), Some((-161.962, cm)));
        assert_eq!(stated_peak(":    416.015 cm/s/s , at").unwrap().0, 416.015);
        assert_eq!(stated_peak("  =   .079 g , at").unwrap().0, 0.079);
        assert_eq!(stated_peak("  =  -.055 G, AT").unwrap().0, -0.055);
        for text in ["", "=", "= nan cm/s2", "= 101730, at", "= 1.0", "= 12703.000 counts"] {
            assert_eq!(stated_peak(text), None, "{text}");
        }
    }

    #[test]
    fn magnitudes() {
        for (text, expected) in [
            ("H= 12km(SCSN) ML=4.9, Mw=4.8(CIT), Ms=4.2(NEIC)", Some(4.8)),
            ("HYPOCENTER(CIT): 34.215N, H=18KM. ML=6.6, MW=6.7(CIT); MS=6.7(NEIC)", Some(6.7)),
            ("H=   km       ML=     Mw= ", None),
            ("(NCSN) M=4.8", Some(4.8)),
            ("PRELIMINARY SOLUTION.  ML=6.5(BRK)", Some(6.5)),
            ("To be determined.  ML:  To be determined.", None),
            ("M6.02 at 2014, H=9km", None),
            ("Mw=99", None),
        ] {
            assert_eq!(magnitude(text), expected, "{text}");
        }
    }

    #[test]
    fn directions() {
        for (text, expected) in [
            ("340 deg", Some(Orientation::Azimuth(340.0))),
            (" 360 Deg     from", Some(Orientation::Azimuth(360.0))),
            ("Up", Some(Orientation::Vertical)),
            ("  DOWN ", Some(Orientation::Vertical)),
            ("H1", Some(Orientation::Horizontal(1))),
            ("Tran", Some(Orientation::Horizontal(2))),
            ("Other", None),
            ("400 deg", None),
            ("", None),
        ] {
            assert_eq!(orientation(text), expected, "{text}");
        }
    }

    #[test]
    fn moments() {
        for (text, expected) in [
            ("06/16/2005, 20:53:04.400 UTC (Q=2) RcrdId: 23075", Some(1_118_955_184.4)),
            (" 2005/06/16 20:53:04.400 UTC", Some(1_118_955_184.4)),
            ("  6-16-05, 20:53 UTC (Q=2)", Some(1_118_955_180.0)),
            ("05/02/83, 16:42:48.2 PDT", Some(420_741_768.2)),
            ("02/30/83, 16:42:48.2", None),
            ("To be determined", None),
            ("1/15/2014", None),
            ("99999999999/1/1 1:1:1", None),
            ("", None),
        ] {
            assert_eq!(moment_s(text), expected, "{text}");
        }
    }

    #[test]
    fn names_of_earthquakes() {
        for (line, expected) in [
            ("Somewhere in Los Angeles, CA            June 16,2005 13:53 PDT", Some("Somewhere in Los Angeles, CA")),
            ("Record of Point MacKenzie Earthquake of Fri Nov 30, 2018 17:29 UTC", Some("Point MacKenzie Earthquake")),
            ("Record of nc71126864      Earthquake of Mon Dec 20, 2021 20:13 UTC", Some("nc71126864")),
            ("Record of                 Earthquake of Sun Jun 17, 2018  11:34 PDT", None),
            ("Rcrd of Wed Jan 15, 2014 01:35:00.0 PST", None),
            ("COALINGA EARTHQUAKE", Some("COALINGA EARTHQUAKE")),
            ("Record of", None),
            ("é", Some("é")),
            ("", None),
        ] {
            assert_eq!(event_name(line).as_deref(), expected, "{line}");
        }
        assert_eq!(origin_time(" 2018/11/30 17:29:29    UTC").as_deref(), Some("2018/11/30 17:29:29 UTC"));
        assert_eq!(origin_time("  To be determined"), None);
    }
}
