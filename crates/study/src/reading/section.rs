//! A table while it is read: it learns its keys as they are asked for.

use uplift_motion::IntensityMeasure;

use super::suggestion::{MEASURES, did_you_mean, from_other_programs, measure_by_its_key, other_unit};
use super::{Field, Finding, Findings, Origin, Table, optional};
use crate::error::MOST_LISTED;
use crate::keys::{Form, Key, Readable};

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

    /// The value of `key` as it stands, if given.
    pub(crate) fn given<F: Form>(&mut self, key: &Key<F>) -> Option<Field<'a>> {
        self.field(key.name)
    }

    /// The value of `key` as it stands, which must be given: a mistake with this `message` and `help` where it is not.
    pub(crate) fn needed<F: Form>(
        &mut self,
        key: &Key<F>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<Field<'a>> {
        let field = self.given(key);
        if field.is_none() {
            self.mistake(key.name, message, help);
        }
        field
    }

    /// Reads `key`, which has a default.
    pub(crate) fn read<F: Readable>(&mut self, key: &Key<F>) -> Option<F::Value> {
        debug_assert!(key.default().is_some(), "`{}` has no default", key.name);
        match self.given(key) {
            Some(field) => key.read(&field),
            None => key.default_value(),
        }
    }

    /// Reads `key`, which must be given: a mistake with this `message` and `help` where it is not.
    pub(crate) fn read_needed<F: Readable>(
        &mut self,
        key: &Key<F>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Option<F::Value> {
        let field = self.needed(key, message, help)?;
        key.read(&field)
    }

    /// Reads `key`, which has no default: outer none where it is wrong, inner none where it is not given.
    #[allow(clippy::option_option)] // wrong and absent are different things, and what is wrong is among the findings
    pub(crate) fn optional<F: Readable>(&mut self, key: &Key<F>) -> Option<Option<F::Value>> {
        optional(self.given(key).as_ref(), |field| key.read(field))
    }

    /// Records a mistake about `key`, one that this section should have or should not.
    pub(crate) fn mistake(&self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        let given = self.table.and_then(|table| table.get(key)).map(|entry| &entry.node.origin);
        self.findings.add(Finding {
            key: self.join(key),
            origin: given.unwrap_or(&self.origin).clone(),
            message: message.into(),
            help: Some(help.into()),
        });
    }

    /// Records a mistake about `key`, by which nothing is read.
    pub(crate) fn refuse<T>(&self, key: &str, message: impl Into<String>, help: impl Into<String>) -> Option<T> {
        self.mistake(key, message, help);
        None
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
                let meant = || did_you_mean_key(&entry.key, &self.known, measures, self.path.is_empty());
                from_other_programs(&self.path, &entry.key, &self.known)
                    .map(str::to_owned)
                    .or_else(meant)
                    .unwrap_or_else(|| {
                        let place =
                            if self.path.is_empty() { "the file".to_owned() } else { format!("`{}`", self.path) };
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
    let in_another_case = || {
        let meant = known.iter().find(|known| known.eq_ignore_ascii_case(key))?;
        Some(format!("write `{meant}`: upper and lower case differ"))
    };
    let measure = || measures.then(|| measure_by_its_key(key, is_top)).flatten();
    in_another_case().or_else(|| other_unit(key, known)).or_else(measure).or_else(|| did_you_mean(key, known))
}
