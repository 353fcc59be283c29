//! Keys of files, each declared once: name, what a value may be, default and meaning.
//!
//! From the declaration follow the reading ([`Section::read`](crate::reading::Section::read)), the tables of `docs` and
//! the JSON Schemas (`schema.rs`). A rule that takes several keys, such as a capacity above the uplift displacement,
//! stands where the section is read, and in words in the key's note.

mod form;

use serde_json::{Map, Value};

use crate::reading::Field;

use form::inline;
pub(crate) use form::{
    ANY, Boolean, Choice, File, Integer, List, Number, Special, Text, boolean, choice, file, grid, integer, judged,
    number, object, one_or_several, special, text,
};

/// A key of a section.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Key<F: Form> {
    pub(crate) name: &'static str,
    also: &'static [&'static str],
    form: F,
    default: Default<F::Given>,
    meaning: &'static str,
    note: &'static str,
}

/// What holds where a key is not given.
#[derive(Debug, Clone, Copy)]
enum Default<G> {
    /// This value.
    Value(G),
    /// What the text says.
    Text(&'static str),
    /// Nothing: the key is needed.
    Needed,
}

/// What the value of a key may be.
pub(crate) trait Form: Copy + Sync + 'static {
    /// How a default is declared.
    type Given: Copy + Sync + 'static;

    /// A default as JSON.
    fn json(&self, given: Self::Given) -> Value;

    /// A default as the documentation shows it.
    fn shown(&self, given: Self::Given) -> String {
        format!("`{}`", inline(&self.json(given)))
    }

    /// What a value may be, for the documentation; empty where there is nothing to say.
    fn range(&self) -> String {
        String::new()
    }

    /// What a value may be, as a JSON Schema.
    fn schema(&self) -> Map<String, Value>;
}

/// A form that a value can be read by alone.
pub(crate) trait Readable: Form {
    /// What is read.
    type Value;

    /// Reads the value of a key that is given.
    fn read(&self, field: &Field<'_>) -> Option<Self::Value>;

    /// The value of a default.
    fn value(&self, given: Self::Given) -> Option<Self::Value>;
}

impl<F: Form> Key<F> {
    const fn new(name: &'static str, form: F) -> Self {
        Self { name, also: &[], form, default: Default::Needed, meaning: "", note: "" }
    }

    /// With this value where it is not given.
    pub(crate) const fn with_default(self, default: F::Given) -> Self {
        Self { default: Default::Value(default), ..self }
    }

    /// With what `text` says where it is not given; empty where there is nothing to say.
    pub(crate) const fn without_default(self, text: &'static str) -> Self {
        Self { default: Default::Text(text), ..self }
    }

    /// Which must be given.
    pub(crate) const fn needed(self) -> Self {
        Self { default: Default::Needed, ..self }
    }

    /// With what it means, and its unit.
    pub(crate) const fn meaning(self, meaning: &'static str) -> Self {
        Self { meaning, ..self }
    }

    /// With what else holds of its value.
    pub(crate) const fn note(self, note: &'static str) -> Self {
        Self { note, ..self }
    }

    /// With other keys that mean the same; `sa_1s` stands for every measure that is not named beside it.
    pub(crate) const fn also(self, also: &'static [&'static str]) -> Self {
        Self { also, ..self }
    }

    /// One such value, or a list of several; without a default.
    pub(crate) const fn list(self) -> Key<List<F>> {
        Key {
            name: self.name,
            also: self.also,
            form: List(self.form),
            default: Default::Needed,
            meaning: self.meaning,
            note: self.note,
        }
    }

    /// What holds where it is not given, if that is a value.
    pub(crate) const fn default(&self) -> Option<F::Given> {
        match self.default {
            Default::Value(given) => Some(given),
            _ => None,
        }
    }
}

impl<F: Readable> Key<F> {
    /// Reads a value of it.
    pub(crate) fn read(&self, field: &Field<'_>) -> Option<F::Value> {
        self.form.read(field)
    }

    /// The value where it is not given; none of a key without.
    pub(crate) fn default_value(&self) -> Option<F::Value> {
        self.default().and_then(|given| self.form.value(given))
    }
}

/// A key of any form, for the documentation and the schema.
pub(crate) trait Declared: Sync {
    /// Its name, and those of others that mean the same.
    fn names(&self) -> Vec<&'static str>;
    /// What it means.
    fn meaning(&self) -> &'static str;
    /// What holds where it is not given, in Markdown.
    fn default(&self) -> String;
    /// What a value may be, in Markdown.
    fn range(&self) -> String;
    /// Whether it must be given.
    fn is_needed(&self) -> bool;
    /// What a value may be, and a default that is a value, as a JSON Schema.
    fn schema(&self) -> Map<String, Value>;
}

impl<F: Form> Declared for Key<F> {
    fn names(&self) -> Vec<&'static str> {
        [&[self.name], self.also].concat()
    }

    fn meaning(&self) -> &'static str {
        self.meaning
    }

    fn default(&self) -> String {
        match self.default {
            Default::Value(given) => self.form.shown(given),
            Default::Text(text) => text.to_owned(),
            Default::Needed => "needed".to_owned(),
        }
    }

    fn range(&self) -> String {
        let range = self.form.range();
        if range.is_empty() || self.note.is_empty() { range + self.note } else { format!("{range}; {}", self.note) }
    }

    fn is_needed(&self) -> bool {
        matches!(self.default, Default::Needed)
    }

    fn schema(&self) -> Map<String, Value> {
        let mut schema = self.form.schema();
        if let Some(default) = self.default() {
            schema.insert("default".to_owned(), self.form.json(default));
        }
        schema
    }
}

/// The keys of one section.
#[derive(Clone, Copy)]
pub(crate) struct SectionKeys {
    /// The section as a dotted path, `records.select`; empty at the top of the file.
    pub(crate) section: &'static str,
    /// How it is written.
    pub(crate) shape: Shape,
    /// Its keys, in the order of the documentation.
    pub(crate) keys: &'static [&'static dyn Declared],
}

/// How a section is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// One table.
    Table,
    /// A list of tables.
    List,
    /// A table, or a list of tables.
    TableOrList,
    /// A path, or a table.
    FileOrTable,
}

impl SectionKeys {
    /// The section that is one table.
    pub(crate) const fn new(section: &'static str, keys: &'static [&'static dyn Declared]) -> Self {
        Self { section, shape: Shape::Table, keys }
    }

    /// Written in this way.
    pub(crate) const fn shape(self, shape: Shape) -> Self {
        Self { shape, ..self }
    }
}
