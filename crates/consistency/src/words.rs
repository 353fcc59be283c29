//! What a site calls its measures, records and targets, for sentences.

use std::fmt;

/// The words of a site, for sentences.
#[derive(Clone, Copy)]
pub struct Words<'a> {
    /// The measure that the set is scaled to: PGV.
    pub scaled_to: &'a str,
    /// Its unit: cm/s.
    pub scaled_to_unit: &'a str,
    /// The other measure: PGA.
    pub other: &'a str,
    /// Its unit: g.
    pub other_unit: &'a str,
    /// Stripe levels of x, `[level]`.
    pub levels: &'a [f64],
    /// Whether each has records of its own.
    pub has_level_sets: bool,
    /// The name of a record, by its position.
    pub record: &'a dyn Fn(usize) -> String,
    /// The name of an earthquake, by the caller's number.
    pub event: &'a dyn Fn(usize) -> String,
    /// The name of a target by its position: 2 % in 50 years.
    pub target: &'a dyn Fn(usize) -> String,
}

impl Words<'_> {
    /// A stripe: its level with the unit.
    pub(crate) fn level(&self, level: usize) -> String {
        let value = self.levels.get(level).copied().unwrap_or(f64::NAN);
        format!("{value} {}", self.scaled_to_unit)
    }
}

impl fmt::Debug for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Words").field("scaled_to", &self.scaled_to).field("other", &self.other).finish_non_exhaustive()
    }
}

/// Invented words, for the tests of sentences.
#[cfg(test)]
pub(crate) fn with_words(test: impl Fn(&Words<'_>)) {
    test(&Words {
        scaled_to: "PGV",
        scaled_to_unit: "cm/s",
        other: "PGA",
        other_unit: "g",
        levels: &[1.0, 2.5, 40.0],
        has_level_sets: false,
        record: &|record| format!("RSN{record}"),
        event: &|event| format!("event {event}"),
        target: &|target| ["2 % in 50 years", "10 % in 50 years"][target].to_owned(),
    });
}
