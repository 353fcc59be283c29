//! What the words above columns of numbers say of unit and time step.
//!
//! Such words are free text. Only what can hardly mean anything else is taken: `units: cm/s^2`, a unit behind
//! the name of the column (`acc (g)`, `acceleration in m/s2`, `acceleration_m_s2`), `dt = 0.01`,
//! `time step: 5 ms`. Lines about a peak or about gravity are not about the unit of the column.

use crate::error::MotionError;
use crate::read::excerpt;
use crate::read::head::Source;
use crate::read::number::parse_number;
use crate::unit::AccelerationUnit;

/// Longest line that is looked at \[bytes\].
const LONGEST_LINE: usize = 1000;

/// Line below which none is looked at.
const LAST_LINE: usize = 200;

/// What the lines above the values say.
#[derive(Default)]
pub(super) struct Head {
    units: Vec<AccelerationUnit>,
    steps_s: Vec<f64>,
    /// A unit that is not one of acceleration, or not known.
    refusal: Option<MotionError>,
}

impl Head {
    /// The unit; none where nothing is said, or several things.
    ///
    /// # Errors
    ///
    /// [`MotionError::NotAcceleration`] and [`MotionError::HeaderUnit`] where only another unit is named.
    pub(super) fn unit(&mut self) -> Result<Option<AccelerationUnit>, MotionError> {
        match (self.units.as_slice(), self.refusal.take()) {
            ([], Some(refusal)) => Err(refusal),
            (units, _) => Ok(only(units)),
        }
    }

    /// The time step \[s\]; none where nothing is said, or several things.
    pub(super) fn dt_s(&self) -> Option<f64> {
        only(&self.steps_s)
    }

    /// Takes note of what a line above the values says; `source` and `line` are for messages.
    ///
    /// # Errors
    ///
    /// [`MotionError::HeaderValue`] where a time step is not a number.
    pub(super) fn note(&mut self, source: Source, line: usize, text: &str) -> Result<(), MotionError> {
        if text.len() > LONGEST_LINE || line > LAST_LINE {
            return Ok(());
        }
        let lower = text.trim_start_matches(['#', '%', '/']).to_lowercase();
        let words = words(&lower);
        let other_subject = ["pga", "pgv", "pgd", "peak", "max", "max.", "maximum", "gravity"];
        if !words.iter().any(|word| other_subject.contains(word)) {
            for candidate in (0..words.len()).filter_map(|at| unit_at(&words, at)) {
                let (name, short) = (source.name.to_owned(), excerpt(text));
                match candidate {
                    Unit::Acceleration(unit) => self.units.push(unit),
                    Unit::Other => self.refusal = Some(MotionError::NotAcceleration { name, line, text: short }),
                    Unit::Unknown => self.refusal = Some(source.unknown_unit(line, text)),
                }
            }
        }
        for at in 0..words.len() {
            if let Some((digits, unit_s)) = step_at(&words, at) {
                let unreadable = || source.unreadable(line, "the time step", text, "dt = 0.01 s");
                let number = parse_number(digits).ok_or_else(unreadable)?;
                self.steps_s.push(number * unit_s);
            }
        }
        Ok(())
    }
}

/// The one thing that all of `found` are.
fn only<T: Copy + PartialEq>(found: &[T]) -> Option<T> {
    found.first().copied().filter(|first| found.iter().all(|other| other == first))
}

/// Words, and each mark of punctuation for itself; a comma inside a number stays there.
fn words(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut start = 0;
    let mut before = ' ';
    for (at, c) in text.char_indices() {
        let end = at + c.len_utf8();
        let in_number =
            c == ',' && before.is_ascii_digit() && text[end..].starts_with(|next: char| next.is_ascii_digit());
        if (c.is_whitespace() || "()[]{},;:=\"'".contains(c)) && !in_number {
            words.extend([&text[start..at], text[at..end].trim()].into_iter().filter(|word| !word.is_empty()));
            start = end;
        }
        before = c;
    }
    words.extend(Some(&text[start..]).filter(|word| !word.is_empty()));
    words
}

fn is_mark(word: &str) -> bool {
    word.starts_with(|c: char| "()[]{},;:=\"'".contains(c))
}

enum Unit {
    Acceleration(AccelerationUnit),
    /// Of velocity or displacement.
    Other,
    /// Of acceleration, but not one that is known.
    Unknown,
}

const ACCELERATION: &[&str] = &["acc", "accel", "acceleration", "accelerations", "accelerogram"];
const VELOCITY_OR_DISPLACEMENT: &[&str] = &["vel", "velocity", "velocities", "disp", "displacement", "displacements"];

/// Whether a word, up to its first underscore, is one of `quantity`.
fn names(word: &str, quantity: &[&str]) -> bool {
    let stem = word.split('_').next().unwrap_or(word).trim_end_matches('.');
    quantity.contains(&stem)
}

/// The unit that the word at `at` announces.
fn unit_at(words: &[&str], at: usize) -> Option<Unit> {
    let word = words.get(at)?.trim_end_matches('.');
    if names(word, ACCELERATION) {
        let suffixes = [("_m_s2", "m/s2"), ("_cm_s2", "cm/s2"), ("_gal", "gal"), ("_g", "g")];
        if let Some((_, unit)) = suffixes.into_iter().find(|(suffix, _)| word.ends_with(suffix)) {
            return known(unit);
        }
    }
    let bracketed = words.get(at + 1).is_some_and(|next| ["(", "["].contains(next));
    let announces = ["unit", "units"].contains(&word)
        || names(word, ACCELERATION)
        || names(word, VELOCITY_OR_DISPLACEMENT)
        || (bracketed && ["a", "ag"].contains(&word));
    if !announces {
        return None;
    }
    let between = ["of", "in", "is", "are", "unit", "units", "series", "history", "time", "t", "s", "sec", "seconds"];
    let behind = words.get(at + 1..)?;
    let skips = |word: &str| is_mark(word) || between.contains(&word) || names(word, ACCELERATION);
    let skipped = behind.iter().take_while(|word| skips(word)).count();
    let candidate = behind.get(skipped)?.trim_end_matches('.');
    // "acceleration (g): 0.35" gives a value.
    let mut after = behind.get(skipped + 1..)?.iter().filter(|word| ![")", "]"].contains(*word)).peekable();
    after.next_if(|word| ["=", ":"].contains(*word));
    if after.peek().is_some_and(|word| begins_number(word)) {
        return None;
    }
    let velocities = ["m/s", "cm/s", "mm/s", "m/sec", "cm/sec", "mm/sec"];
    let is_velocity = velocities.contains(&candidate);
    if names(word, VELOCITY_OR_DISPLACEMENT) {
        (is_velocity || ["m", "cm", "mm"].contains(&candidate)).then_some(Unit::Other)
    } else if is_velocity {
        Some(if word.starts_with("unit") { Unit::Other } else { Unit::Unknown })
    } else {
        known(candidate)
    }
}

/// What unit a word is.
fn known(word: &str) -> Option<Unit> {
    if let Ok(unit) = word.parse() {
        return Some(Unit::Acceleration(unit));
    }
    let per_second_squared = ["/s2", "/s^2", "/s**2", "/s²", "/s/s", "/sec2", "/sec^2", "/sec**2", "/sec²", "/sec/sec"];
    let unknown = ["%g", "mg"].contains(&word) || per_second_squared.iter().any(|end| word.ends_with(end));
    unknown.then_some(Unit::Unknown)
}

fn begins_number(word: &str) -> bool {
    word.trim_start_matches(['+', '-', '.']).starts_with(|c: char| c.is_ascii_digit())
}

/// The digits of the time step that the words from `at` on give, and their unit in s.
fn step_at<'a>(words: &[&'a str], at: usize) -> Option<(&'a str, f64)> {
    let names: [&[&str]; 6] =
        [&["dt"], &["dt_s"], &["time", "step"], &["time_step"], &["timestep"], &["sampling", "interval"]];
    let name = names.into_iter().find(|name| words[at..].starts_with(name))?;
    let mut rest = words.get(at + name.len()..)?.iter().copied();
    let mut unit_s = None;
    let number = loop {
        match rest.next()? {
            "(" | "[" | ")" | "]" => {}
            "=" | ":" => break rest.next().filter(|word| begins_number(word))?,
            word => unit_s = Some(time_unit_s(word)?),
        }
    };
    let end = number.find(|c: char| !(c.is_ascii_digit() || "+-.,e".contains(c))).unwrap_or(number.len());
    let (digits, glued) = number.split_at(end);
    if !glued.is_empty() {
        // With another unit than of time, none of it is a number.
        return Some(time_unit_s(glued).map_or((number, 1.0), |unit_s| (digits, unit_s)));
    }
    let behind = rest.find(|word| !["(", "["].contains(word)).and_then(time_unit_s);
    Some((digits, unit_s.or(behind).unwrap_or(1.0)))
}

/// A unit of time in s.
fn time_unit_s(word: &str) -> Option<f64> {
    match word.trim_end_matches('.') {
        "s" | "sec" | "secs" | "second" | "seconds" => Some(1.0),
        "ms" | "msec" | "milliseconds" => Some(1e-3),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::RecordFormat;
    use AccelerationUnit::{CmPerS2, G, MPerS2};
    use proptest::prelude::*;

    fn noted(text: &str) -> Result<(Option<AccelerationUnit>, Option<f64>), MotionError> {
        let (mut head, source) = (Head::default(), Source { name: "a.txt", format: RecordFormat::Columns });
        for (index, line) in text.lines().enumerate() {
            head.note(source, index + 1, line)?;
        }
        Ok((head.unit()?, head.dt_s()))
    }

    #[test]
    fn units_that_are_said() {
        for (text, unit) in [
            ("# units: cm/s^2", CmPerS2),
            ("%Units = g", G),
            ("// acceleration in units of G.", G),
            ("# units: s, m/s2", MPerS2),
            ("# units: time s; acceleration gal", CmPerS2),
            ("# units: g (g = 9.81 m/s2)", G),
            ("time (s), acc (g)", G),
            ("t [s]; a [cm/s2]", CmPerS2),
            ("acceleration [m/s2]", MPerS2),
            ("Acceleration (m/s²)", MPerS2),
            ("\"time (s)\",\"accel. (cm/sec/sec)\"", CmPerS2),
            ("# time in s, acceleration in m/s**2", MPerS2),
            ("# Acceleration time history, cm/s2", CmPerS2),
            ("time_s,acceleration_m_s2", MPerS2),
            ("time_s,acc_g", G),
            ("time_s,acceleration_cm_s2", CmPerS2),
            ("# acceleration (g), dt = 0.01", G),
            ("# velocity step (m/s)\n# units: g", G),
        ] {
            assert_eq!(noted(text).unwrap().0, Some(unit), "{text}");
        }
    }

    #[test]
    fn what_says_no_unit() {
        for text in [
            "# PGA (g): 0.35",
            "# peak acceleration (g)",
            "# acceleration (g): 0.35",
            "# acceleration (g) 0.35",
            "# acc = 0.3 g",
            "# gravity: 9.81 m/s2",
            "# acceleration of gravity in m/s2",
            "# station G, g and cm/s2",
            "# unit weight 25 kN/m3",
            "# units: SI",
            "# accuracy: mg",
            "# accelerometer g",
            "# units: m, s, kg",
            "# units: n/a",
            "# units",
            "time acceleration",
            "# units: g\n# acceleration in m/s2",
            "# velocity and displacement are zero at the end",
            "",
        ] {
            assert_eq!(noted(text).unwrap().0, None, "{text}");
        }
    }

    #[test]
    fn units_that_are_refused() {
        for text in ["# units: cm/s", "time (s), velocity (m/s)", "t [s], disp [cm]", "displacement in mm"] {
            let message = noted(text).unwrap_err().to_string();
            assert_eq!(message, format!("a.txt, line 1: \"{text}\": not an acceleration; give the acceleration file"));
        }
        for text in ["# units: ft/s2", "acceleration (m/s)", "acceleration (mm/s^2)", "acc [%g]", "acc in mg"] {
            let message = noted(&format!("words\n{text}")).unwrap_err().to_string();
            assert!(
                message.starts_with(&format!("a.txt, line 2: unknown acceleration unit in \"{text}\"")),
                "{message}"
            );
        }
    }

    #[test]
    fn steps_that_are_said() {
        for (text, dt_s) in [
            ("# dt = 0.01", 0.01),
            ("# dt: 0.005 s", 0.005),
            ("% DT= .0050 SEC, 4000 points", 0.005),
            ("dt=5ms", 0.005),
            ("# dt (ms) = 20", 0.02),
            ("dt [s]: 1.0e-2", 0.01),
            ("# time step = 0.01s, units: g", 0.01),
            ("# Sampling interval (s): 0.004", 0.004),
            ("# dt_s = 0.02", 0.02),
            ("# time_step: 0.02\n# dt = 0.02", 0.02),
        ] {
            assert_eq!(noted(text).unwrap().1, Some(dt_s), "{text}");
        }
        for text in ["# dt", "# dt =", "# dt: variable", "# dt 0.01", "# width = 3", "# dt = 0.01\n# dt = 0.02"] {
            assert_eq!(noted(text).unwrap().1, None, "{text}");
        }
        for text in ["# dt = 0,01", "# dt = 0.0.1", "# dt = 1e999", "# dt=200Hz"] {
            let message = noted(text).unwrap_err().to_string();
            assert!(message.contains(&format!("line 1: cannot read the time step in \"{text}\"")), "{message}");
        }
    }

    proptest! {
        #[test]
        fn any_words_give_an_answer(
            text in "((acc|vel|units|dt|time|step|=|:|[(]|[)]|,| |0|1|[.]|é|²|g|cm/s|m/s2|\n){0,30})",
        ) {
            let _ = noted(&text);
        }
    }
}
