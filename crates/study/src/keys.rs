//! Keys of files, each declared once: name, what a value may be, default and meaning.
//!
//! From the declaration follow the reading ([`Section::read`](crate::reading::Section::read)), the tables of `docs` and
//! the JSON Schemas (`schema.rs`). A rule that takes several keys, such as a capacity above the uplift displacement,
//! stands where the section is read, and in words in the key's note.

use serde_json::{Map, Value, json};
use uplift_plausible::short_number;

use crate::grid::{self, Grid, GridRule};
use crate::reading::{Field, LARGEST_INTEGER, Rule};

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

/// A number.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Number {
    unit: &'static str,
    rule: Rule,
}

/// A number that is read whatever it is, and judged with others by what it describes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Judged {
    name: &'static str,
    unit: &'static str,
    rule: fn(&str) -> Rule,
}

/// A number that is judged elsewhere.
pub(crate) const ANY: Rule = Rule::Finite("finite");

/// A whole number.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Integer {
    least: u64,
    most: u64,
}

/// `true` or `false`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Boolean;

/// One of several words.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Choice<T: 'static> {
    all: &'static [T],
    word: fn(T) -> &'static str,
}

/// Text.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Text;

/// The path of a file, which [`Paths`](crate::reading::Paths) reads.
#[derive(Debug, Clone, Copy)]
pub(crate) struct File;

/// One value or a list of several, which the section reads by itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct List<F>(F);

/// What the section reads by itself, with its JSON Schema.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Special(fn() -> Value);

/// A number \[`unit`\] that satisfies `rule`.
pub(crate) const fn number(name: &'static str, unit: &'static str, rule: Rule) -> Key<Number> {
    Key::new(name, Number { unit, rule })
}

/// A number \[`unit`\] that is judged by the `rule` of its name once it is read; it may be left out.
pub(crate) const fn judged(name: &'static str, unit: &'static str, rule: fn(&str) -> Rule) -> Key<Judged> {
    Key::new(name, Judged { name, unit, rule }).without_default("")
}

/// A whole number from `least` to `most`.
pub(crate) const fn integer(name: &'static str, least: u64, most: u64) -> Key<Integer> {
    Key::new(name, Integer { least, most })
}

/// `true` or `false`.
pub(crate) const fn boolean(name: &'static str) -> Key<Boolean> {
    Key::new(name, Boolean)
}

/// The `word` of one of `all`.
pub(crate) const fn choice<T: Copy + Sync>(
    name: &'static str,
    all: &'static [T],
    word: fn(T) -> &'static str,
) -> Key<Choice<T>> {
    Key::new(name, Choice { all, word })
}

/// A grid of numbers that satisfies `rule`.
pub(crate) const fn grid(name: &'static str, rule: GridRule) -> Key<GridRule> {
    Key::new(name, rule)
}

/// Text.
pub(crate) const fn text(name: &'static str) -> Key<Text> {
    Key::new(name, Text)
}

/// The path of a file.
pub(crate) const fn file(name: &'static str) -> Key<File> {
    Key::new(name, File)
}

/// What the section reads by itself, with its JSON Schema.
pub(crate) const fn special(name: &'static str, schema: fn() -> Value) -> Key<Special> {
    Key::new(name, Special(schema))
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

impl Form for Number {
    type Given = f64;

    fn json(&self, given: f64) -> Value {
        plain(given)
    }

    fn shown(&self, given: f64) -> String {
        if given >= 1e-4 { given.to_string() } else { short_number(given) }
    }

    fn range(&self) -> String {
        self.rule.range()
    }

    fn schema(&self) -> Map<String, Value> {
        with_unit(self.rule.schema(), self.unit)
    }
}

impl Readable for Number {
    type Value = f64;

    fn read(&self, field: &Field<'_>) -> Option<f64> {
        field.number(self.unit, self.rule)
    }

    fn value(&self, given: f64) -> Option<f64> {
        Some(given)
    }
}

impl Form for Judged {
    type Given = f64;

    fn json(&self, given: f64) -> Value {
        plain(given)
    }

    fn range(&self) -> String {
        (self.rule)(self.name).range()
    }

    fn schema(&self) -> Map<String, Value> {
        with_unit((self.rule)(self.name).schema(), self.unit)
    }
}

impl Readable for Judged {
    type Value = f64;

    fn read(&self, field: &Field<'_>) -> Option<f64> {
        field.number(self.unit, ANY)
    }

    fn value(&self, given: f64) -> Option<f64> {
        Some(given)
    }
}

impl Form for Integer {
    type Given = u64;

    fn json(&self, given: u64) -> Value {
        given.into()
    }

    fn shown(&self, given: u64) -> String {
        grouped(given)
    }

    fn range(&self) -> String {
        format!("{} to {}", self.least, grouped(self.most))
    }

    fn schema(&self) -> Map<String, Value> {
        object(json!({ "type": "integer", "minimum": self.least, "maximum": self.most }))
    }
}

impl Readable for Integer {
    type Value = u64;

    fn read(&self, field: &Field<'_>) -> Option<u64> {
        field.integer(self.least, self.most)
    }

    fn value(&self, given: u64) -> Option<u64> {
        Some(given)
    }
}

impl Form for Boolean {
    type Given = bool;

    fn json(&self, given: bool) -> Value {
        given.into()
    }

    fn schema(&self) -> Map<String, Value> {
        object(json!({ "type": "boolean" }))
    }
}

impl Readable for Boolean {
    type Value = bool;

    fn read(&self, field: &Field<'_>) -> Option<bool> {
        field.boolean()
    }

    fn value(&self, given: bool) -> Option<bool> {
        Some(given)
    }
}

impl<T: Copy> Choice<T> {
    /// The words, each with what it stands for.
    fn choices(&self) -> Vec<(&'static str, T)> {
        self.all.iter().map(|&one| ((self.word)(one), one)).collect()
    }
}

impl<T: Copy + Sync + 'static> Form for Choice<T> {
    type Given = T;

    fn json(&self, given: T) -> Value {
        (self.word)(given).into()
    }

    fn range(&self) -> String {
        self.choices().iter().map(|(word, _)| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", ")
    }

    fn schema(&self) -> Map<String, Value> {
        let words: Vec<&str> = self.choices().iter().map(|(word, _)| *word).collect();
        object(json!({ "type": "string", "enum": words }))
    }
}

impl<T: Copy + Sync + 'static> Readable for Choice<T> {
    type Value = T;

    fn read(&self, field: &Field<'_>) -> Option<T> {
        field.choice(&self.choices())
    }

    fn value(&self, given: T) -> Option<T> {
        Some(given)
    }
}

impl Form for Text {
    type Given = &'static str;

    fn json(&self, given: &'static str) -> Value {
        given.into()
    }

    fn shown(&self, given: &'static str) -> String {
        if given.is_empty() { "empty".to_owned() } else { format!("`\"{given}\"`") }
    }

    fn schema(&self) -> Map<String, Value> {
        object(json!({ "type": "string" }))
    }
}

impl Readable for Text {
    type Value = String;

    fn read(&self, field: &Field<'_>) -> Option<String> {
        field.text().map(str::to_owned)
    }

    fn value(&self, given: &'static str) -> Option<String> {
        Some(given.to_owned())
    }
}

impl Form for File {
    type Given = &'static str;

    fn json(&self, given: &'static str) -> Value {
        given.into()
    }

    fn schema(&self) -> Map<String, Value> {
        object(json!({ "type": "string", "minLength": 1 }))
    }
}

impl Form for GridRule {
    /// The notations that make it.
    type Given = &'static [&'static str];

    fn json(&self, given: Self::Given) -> Value {
        let piece = |text: &&str| text.parse().map_or_else(|_| Value::from(*text), plain);
        match given {
            [one] => piece(one),
            several => several.iter().map(piece).collect(),
        }
    }

    fn shown(&self, given: Self::Given) -> String {
        let values = given.iter().filter_map(|text| grid::notation::values(text).ok());
        let count: usize = values.map(|values| values.len()).sum();
        let values = if count > given.len() { format!(", {count} values") } else { String::new() };
        match self.json(given) {
            Value::Number(number) => number.to_string(),
            notation => format!("`{}`{values}", inline(&notation)),
        }
    }

    fn range(&self) -> String {
        let range = self.each.range();
        if self.least_count > 1 { format!("{range}; at least {}", self.least_count) } else { range }
    }

    fn schema(&self) -> Map<String, Value> {
        let [notation, steps] =
            ["notation", "equal_steps"].map(|name| json!({ "$ref": format!("#/definitions/{name}") }));
        let mut any = vec![self.each.schema().into(), notation, steps];
        any.push(json!({ "type": "array", "minItems": 1, "items": { "anyOf": any } }));
        with_unit(object(json!({ "anyOf": any })), self.unit)
    }
}

impl Readable for GridRule {
    type Value = Grid;

    fn read(&self, field: &Field<'_>) -> Option<Grid> {
        Grid::read(field, *self)
    }

    fn value(&self, given: Self::Given) -> Option<Grid> {
        Grid::from_default(given, *self)
    }
}

impl<F: Form> Form for List<F> {
    type Given = &'static [F::Given];

    fn json(&self, given: Self::Given) -> Value {
        given.iter().map(|&one| self.0.json(one)).collect()
    }

    fn range(&self) -> String {
        self.0.range()
    }

    fn schema(&self) -> Map<String, Value> {
        object(one_or_several(&self.0.schema().into()))
    }
}

impl Form for Special {
    type Given = ();

    fn json(&self, (): ()) -> Value {
        Value::Null
    }

    fn schema(&self) -> Map<String, Value> {
        object((self.0)())
    }
}

/// What `each` describes, or a list of that, as a JSON Schema.
pub(crate) fn one_or_several(each: &Value) -> Value {
    let list = json!({ "type": "array", "minItems": 1, "items": each });
    json!({ "anyOf": [each, list] })
}

/// The members of a JSON object.
pub(crate) fn object(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(members) => members,
        _ => Map::new(),
    }
}

fn with_unit(mut schema: Map<String, Value>, unit: &str) -> Map<String, Value> {
    if !unit.is_empty() {
        schema.insert("x-unit".to_owned(), unit.into());
    }
    schema
}

/// A number, without decimals where it has none.
fn plain(value: f64) -> Value {
    #[expect(clippy::cast_possible_truncation, reason = "a whole number that a double holds exactly")]
    if value.fract() == 0.0 && value.abs() < 1e15 { (value as i64).into() } else { value.into() }
}

/// JSON on one line, with blanks between the items of a list.
fn inline(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", ")),
        other => other.to_string(),
    }
}

/// A whole number for people: `65 535`, `2⁶³ − 1`.
fn grouped(number: u64) -> String {
    if number == LARGEST_INTEGER {
        return "2⁶³ − 1".to_owned();
    }
    let digits = number.to_string();
    let is_long = digits.len() > 4;
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if is_long && index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}
