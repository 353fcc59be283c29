//! The forms of values: how each is declared, read, documented and described by a JSON Schema.

use serde_json::{Map, Value, json};
use uplift_plausible::short_number;

use super::{Form, Key, Readable};
use crate::grid::{self, Grid, GridRule};
use crate::reading::{Field, LARGEST_INTEGER, Rule};

/// A number.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Number {
    unit: &'static str,
    rule: Rule,
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
pub(crate) struct List<F>(pub(super) F);

/// What the section reads by itself, with its JSON Schema.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Special(fn() -> Value);

/// A number \[`unit`\] that satisfies `rule`.
pub(crate) const fn number(name: &'static str, unit: &'static str, rule: Rule) -> Key<Number> {
    Key::new(name, Number { unit, rule })
}

/// A number \[`unit`\] that is read whatever it is, and judged with others by the `rule` of its name; it may be left
/// out.
pub(crate) const fn judged(name: &'static str, unit: &'static str, rule: fn(&str) -> Rule) -> Key<Number> {
    number(name, unit, Rule::Judged(name, rule)).without_default("")
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
pub(super) fn inline(value: &Value) -> String {
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
