//! A table while it is read: it learns its keys as they are asked for.

use std::ops::RangeInclusive;

use uplift_motion::IntensityMeasure;

use super::suggestion::{MEASURES, did_you_mean, measure_by_its_key, other_unit};
use super::{Field, Finding, Findings, LARGEST_INTEGER, Origin, Rule, Table};
use crate::error::MOST_LISTED;

/// A table being read. It learns its keys as they are asked for; [`Section::finish`] reports the others.
pub(crate) struct Section<'a> {
    path: String,
    origin: Origin,
    table: Option<&'a Table>,
    known: Vec<&'static str>,
    pub(crate) findings: &'a Findings,
}

impl<'a> Section<'a> {
    /// The whole document.
    pub(crate) fn root(table: &'a Table, findings: &'a Findings) -> Self {
        Self::new(String::new(), Origin::Study, Some(table), findings)
    }

    /// The section at `path`, absent without a `table`.
    pub(super) fn new(path: String, origin: Origin, table: Option<&'a Table>, findings: &'a Findings) -> Self {
        Self { path, origin, table, known: Vec::new(), findings }
    }

    /// Whether the document has this section.
    pub(crate) fn is_present(&self) -> bool {
        self.table.is_some()
    }

    /// The keys that the document has here.
    pub(crate) fn keys(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        self.table.into_iter().flat_map(|table| &table.entries).map(|entry| entry.key.as_str())
    }

    /// The value of `key`, if given.
    pub(crate) fn field(&mut self, key: &'static str) -> Option<Field<'a>> {
        if !self.known.contains(&key) {
            self.known.push(key);
            #[cfg(test)]
            self.findings.asked.borrow_mut().insert(self.join(key));
        }
        let entry = self.table?.get(key)?;
        Some(Field { key: self.join(key), node: &entry.node, findings: self.findings })
    }

    /// The section of `key` within this one; absent if it is not given or no table.
    pub(crate) fn section(&mut self, key: &'static str) -> Section<'a> {
        match self.field(key) {
            Some(field) => field.section(),
            None => Self::new(self.join(key), self.origin.clone(), None, self.findings),
        }
    }

    /// The number of `key` \[`unit`\], or `default` where it is not given.
    pub(crate) fn number_or(&mut self, key: &'static str, unit: &str, rule: Rule, default: f64) -> Option<f64> {
        self.field(key).map_or(Some(default), |field| field.number(unit, rule))
    }

    /// The truth of `key`, or `default` where it is not given.
    pub(crate) fn boolean_or(&mut self, key: &'static str, default: bool) -> Option<bool> {
        self.field(key).map_or(Some(default), |field| field.boolean())
    }

    /// The word of `key` among `choices`, or `default` where it is not given.
    pub(crate) fn choice_or<T: Copy>(&mut self, key: &'static str, choices: &[(&str, T)], default: T) -> Option<T> {
        self.field(key).map_or(Some(default), |field| field.choice(choices))
    }

    /// The whole number of `key` in `range`, or `default` where it is not given.
    pub(crate) fn integer_or(&mut self, key: &'static str, range: RangeInclusive<u64>, default: u64) -> Option<u64> {
        self.field(key).map_or(Some(default), |field| field.integer(*range.start(), *range.end()))
    }

    /// The `seed` of this section, or `default` where it is not given.
    pub(crate) fn seed_or(&mut self, default: u64) -> Option<u64> {
        self.integer_or("seed", 0..=LARGEST_INTEGER, default)
    }

    /// Records a mistake about `key`, one that this section should have or should not.
    pub(crate) fn mistake(&self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.findings.add(Finding {
            key: self.join(key),
            origin: self.origin.clone(),
            message: message.into(),
            help: Some(help.into()),
        });
    }

    /// Reports the keys that nobody asked for.
    pub(crate) fn finish(self) {
        let entries = self.table.iter().flat_map(|table| &table.entries);
        let mut unknown: Vec<_> = entries.filter(|entry| !self.known.contains(&entry.key.as_str())).collect();
        unknown.sort_by_key(|entry| entry.key_origin.place_in_list());
        for (index, entry) in unknown.into_iter().enumerate() {
            let what = if entry.node.is_sections() { "section" } else { "key" };
            let measures = self.path == MEASURES || self.known.contains(&IntensityMeasure::Pgv.key());
            let help = || {
                let meant = did_you_mean_key(&entry.key, &self.known, measures, self.path.is_empty());
                meant.unwrap_or_else(|| {
                    let place = if self.path.is_empty() { "the file".to_owned() } else { format!("`{}`", self.path) };
                    format!("{place} has {}", self.known.join(", "))
                })
            };
            self.findings.add(Finding {
                key: self.join(&entry.key),
                origin: entry.key_origin.clone(),
                message: format!("unknown {what} `{}`", entry.key),
                // looked for only where it can be listed
                help: (index < MOST_LISTED).then(help),
            });
        }
    }

    fn join(&self, key: &str) -> String {
        match (self.path.as_str(), key) {
            ("", key) => key.to_owned(),
            (path, "") => path.to_owned(),
            (path, key) => format!("{path}.{key}"),
        }
    }
}

/// What an unknown key was meant to be; `measures` tells whether keys here are the names of measures, `is_top` whether
/// it stands before all sections.
fn did_you_mean_key(key: &str, known: &[&str], measures: bool, is_top: bool) -> Option<String> {
    let measure = || measures.then(|| measure_by_its_key(key, is_top)).flatten();
    other_unit(key, known).or_else(measure).or_else(|| did_you_mean(key, known))
}
