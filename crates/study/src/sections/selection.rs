//! The section `[records.select]`, which records are used: ranges of magnitude, distance and the like.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Serialize, Serializer};
use serde_json::json;

use crate::keys::{Boolean, Key, SectionKeys, Special, boolean, special};
use crate::reading::{Field, Section, Value};

pub(crate) const KEYS: SectionKeys = SectionKeys::new(
    "records.select",
    &[
        &range("magnitude", "range of magnitude (column of the manifest)"),
        &range("rrup_km", "range of the closest distance to the rupture, km (column)"),
        &range("repi_km", "range of the distance to the epicentre, km (column)"),
        &range("vs30", "range of the mean shear-wave velocity of the upper 30 m, m/s (column)"),
        &range("lowest_usable_hz", "range of the lowest usable frequency, Hz (column)"),
        &range("pga_g", "range of the PGA of the pair, g, combined as `intensity` says (of the record itself)"),
        &range("pgv_cm_s", "range of the PGV of the pair, cm/s (of the record itself)"),
        &range(
            "d5_75_s",
            "range of the significant duration, s, geometric mean of the components (of the record itself)",
        )
        .also(&["d5_95_s"]),
        &PULSE_LIKE,
    ],
);
const PULSE_LIKE: Key<Boolean> = boolean("pulse_like").without_default("").meaning(
    "`true` or `false`: only motions with, or only motions without a velocity pulse (Shahi and Baker 2014; of the \
     record itself)",
);

/// A range of one of the [`CRITERIA`].
const fn range(name: &'static str, meaning: &'static str) -> Key<Special> {
    const NUMBER: &str = r"\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\s*";
    let schema = || json!({ "type": "string", "pattern": format!("^({NUMBER}:({NUMBER})?|\\s*:{NUMBER})$") });
    special(name, schema).without_default("").meaning(meaning)
}

/// A quantity by which records are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Criterion {
    /// Its key in a study file, and its column where a manifest holds it.
    pub key: &'static str,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// What it is.
    pub meaning: &'static str,
}

impl Criterion {
    /// What it is, with its unit: a line of help.
    pub fn words(self) -> String {
        let (first, rest) = self.meaning.split_at(1);
        let unit = if self.unit.is_empty() { "" } else { ", " };
        format!("{}{rest}{unit}{}", first.to_uppercase(), self.unit)
    }
}

/// Every quantity that a range can be given for.
pub const CRITERIA: [Criterion; 9] = [
    Criterion { key: "magnitude", unit: "", meaning: "magnitude" },
    Criterion { key: "rrup_km", unit: "km", meaning: "closest distance to the rupture" },
    Criterion { key: "repi_km", unit: "km", meaning: "distance to the epicentre" },
    Criterion { key: "vs30", unit: "m/s", meaning: "mean shear-wave velocity of the upper 30 m" },
    Criterion { key: "lowest_usable_hz", unit: "Hz", meaning: "lowest usable frequency" },
    Criterion { key: "pga_g", unit: "g", meaning: "PGA of the pair" },
    Criterion { key: "pgv_cm_s", unit: "cm/s", meaning: "PGV of the pair" },
    Criterion { key: "d5_75_s", unit: "s", meaning: "significant duration D5-75" },
    Criterion { key: "d5_95_s", unit: "s", meaning: "significant duration D5-95" },
];

/// A range with both ends; an end that is not given is infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Least value, -∞ if open.
    pub from: f64,
    /// Largest value, ∞ if open.
    pub to: f64,
}

impl Range {
    /// How a range is written, for messages.
    pub const ACCEPTED: &'static str = "\"6.5:7.5\", \"6.5:\" or \":7.5\"";

    /// Reads `6.5:7.5`, `6.5:` or `:7.5`; none for anything else, an empty range among it.
    pub fn parse(text: &str) -> Option<Self> {
        let (from, to) = text.split_once(':')?;
        let end = |word: &str, open: f64| match word.trim() {
            "" => Some(open),
            number => number.parse::<f64>().ok().filter(|value| value.is_finite()),
        };
        let range = Self { from: end(from, f64::NEG_INFINITY)?, to: end(to, f64::INFINITY)? };
        let bounded = range.from.is_finite() || range.to.is_finite();
        (bounded && range.from <= range.to).then_some(range)
    }

    /// Whether `value` lies between the ends, which belong to it.
    pub fn contains(self, value: f64) -> bool {
        self.from <= value && value <= self.to
    }
}

/// As [`Range::parse`] reads it.
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let end = |value: f64| if value.is_finite() { value.to_string() } else { String::new() };
        write!(f, "{}:{}", end(self.from), end(self.to))
    }
}

/// What a record must satisfy to be used; everything passes an empty one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordSelection {
    /// Ranges, in the order of [`CRITERIA`].
    pub ranges: Vec<(Criterion, Range)>,
    /// Only motions with a velocity pulse, or only motions without.
    pub pulse_like: Option<bool>,
}

impl RecordSelection {
    /// Whether everything passes.
    pub fn is_empty(&self) -> bool {
        self.ranges.is_empty() && self.pulse_like.is_none()
    }
}

/// In words, e.g. "magnitude 6.5:7.5, not pulse-like".
impl fmt::Display for RecordSelection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ranges = self.ranges.iter().map(|(criterion, range)| format!("{} {range}", criterion.key));
        let pulse = self.pulse_like.map(|yes| if yes { "pulse-like" } else { "not pulse-like" }.to_owned());
        f.write_str(&ranges.chain(pulse).collect::<Vec<_>>().join(", "))
    }
}

/// As the section of a study file.
impl Serialize for RecordSelection {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        #[serde(untagged)]
        enum Value {
            Range(String),
            PulseLike(bool),
        }
        let ranges = self.ranges.iter().map(|(criterion, range)| (criterion.key, Value::Range(range.to_string())));
        let pulse_like = self.pulse_like.map(|truth| ("pulse_like", Value::PulseLike(truth)));
        // by the alphabet
        ranges.chain(pulse_like).collect::<BTreeMap<_, _>>().serialize(serializer)
    }
}

/// Reads the section.
pub(crate) fn read(mut section: Section<'_>) -> Option<RecordSelection> {
    let mut ranges = Some(Vec::new());
    for criterion in CRITERIA {
        let Some(field) = section.field(criterion.key) else { continue };
        match (&mut ranges, read_range(&field)) {
            (Some(ranges), Some(range)) => ranges.push((criterion, range)),
            _ => ranges = None,
        }
    }
    let pulse_like = section.optional(&PULSE_LIKE);
    section.finish();
    Some(RecordSelection { ranges: ranges?, pulse_like: pulse_like? })
}

fn read_range(field: &Field<'_>) -> Option<Range> {
    let Value::Text(text) = &field.node.value else {
        return field.wrong_type("a range", &format!("write {}", Range::ACCEPTED));
    };
    Range::parse(text).or_else(|| {
        let help = format!("write {}, the smaller number first", Range::ACCEPTED);
        field.refuse(format!("{} is not a range", field.node.describe()), help)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges() {
        for (text, inside, outside) in
            [("6.5:7.5", [6.5, 7.5], [6.4, 7.6]), ("6.5:", [6.5, 1e9], [6.4, -1.0]), (":7.5", [-9.0, 7.5], [7.6, 8.0])]
        {
            let range = Range::parse(text).unwrap();
            assert_eq!(range.to_string(), text);
            assert!(inside.iter().all(|&value| range.contains(value)));
            assert!(!outside.iter().any(|&value| range.contains(value)));
            assert!(!range.contains(f64::NAN));
        }
        for text in ["", ":", "7", "7:6", "a:b", "1:2:3", "nan:", ":inf"] {
            assert!(Range::parse(text).is_none(), "{text}");
        }
    }

    #[test]
    fn in_words() {
        let selection =
            RecordSelection { ranges: vec![(CRITERIA[0], Range::parse("6.5:7.5").unwrap())], pulse_like: Some(false) };
        assert_eq!(selection.to_string(), "magnitude 6.5:7.5, not pulse-like");
        assert!(RecordSelection::default().is_empty() && !selection.is_empty());
    }
}
