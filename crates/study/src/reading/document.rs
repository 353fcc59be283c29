//! The study file as parsed TOML in which every key and value knows where it comes from.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Where a key or value comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Origin {
    /// Bytes of the study file.
    File(Range<usize>),
    /// The override of this position on the command line.
    Override(usize),
    /// Neither: the document itself, or a default.
    Study,
}

impl Origin {
    /// Where what comes from here stands in a list of mistakes: the file from its beginning, overrides, the rest.
    pub(crate) fn place_in_list(&self) -> (u8, usize) {
        match self {
            Self::File(span) => (0, span.start),
            Self::Override(index) => (1, *index),
            Self::Study => (2, 0),
        }
    }
}

/// A value and its origin.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub(crate) origin: Origin,
    pub(crate) value: Value,
}

/// A TOML value.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    DateTime(String),
    List(Vec<Node>),
    Table(Table),
}

/// A TOML table; no key occurs twice.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    pub(crate) entries: Vec<Entry>,
}

/// A key with its value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_origin: Origin,
    pub(crate) node: Node,
}

impl Table {
    /// The entry of `key`.
    pub(crate) fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// Parses a TOML document; the errors are those of its syntax.
    pub(crate) fn parse(text: &str) -> Result<Self, Vec<toml::de::Error>> {
        let (document, errors) = DeTable::parse_recoverable(text);
        if errors.is_empty() { Ok(Self::from_toml(document.into_inner(), &Origin::File)) } else { Err(errors) }
    }

    fn from_toml(table: DeTable<'_>, origin: &dyn Fn(Range<usize>) -> Origin) -> Self {
        let entries = table
            .into_iter()
            .map(|(key, value)| Entry {
                key_origin: origin(key.span()),
                key: key.into_inner().into_owned(),
                node: Node::from_toml(value, origin),
            })
            .collect();
        Self { entries }
    }
}

impl Node {
    /// Parses one TOML value; what is none is text as it stands.
    pub(crate) fn parse_or_text(text: &str, origin: &Origin) -> Self {
        match DeValue::parse(text) {
            // The grid 10:20:30 reads as a time of day.
            Ok(value) if !value.get_ref().is_datetime() => Self::from_toml(value, &|_| origin.clone()),
            _ => Self { origin: origin.clone(), value: Value::Text(text.to_owned()) },
        }
    }

    fn from_toml(spanned: Spanned<DeValue<'_>>, origin: &dyn Fn(Range<usize>) -> Origin) -> Self {
        let place = origin(spanned.span());
        let value = match spanned.into_inner() {
            DeValue::String(text) => Value::Text(text.into_owned()),
            DeValue::Integer(digits) => integer(digits.as_str(), digits.radix()),
            DeValue::Float(digits) => Value::Float(digits.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(truth) => Value::Boolean(truth),
            DeValue::Datetime(time) => Value::DateTime(time.to_string()),
            DeValue::Array(items) => Value::List(items.into_iter().map(|item| Self::from_toml(item, origin)).collect()),
            DeValue::Table(table) => Value::Table(Table::from_toml(table, origin)),
        };
        Self { origin: place, value }
    }

    /// The value in words, for messages.
    pub(crate) fn describe(&self) -> String {
        const LONGEST: usize = 60;
        match &self.value {
            Value::Text(text) if text.chars().count() > LONGEST => {
                let beginning: String = text.chars().take(LONGEST).collect();
                format!("the text \"{beginning}…\"")
            }
            Value::Text(text) => format!("the text \"{text}\""),
            Value::Integer(number) => format!("the number {number}"),
            Value::Float(number) => format!("the number {number:?}"),
            Value::Boolean(truth) => truth.to_string(),
            Value::DateTime(time) => format!("the date {time}"),
            Value::List(items) if items.is_empty() => "an empty list".to_owned(),
            Value::List(_) if self.is_sections() => "a list of sections".to_owned(),
            Value::List(_) => "a list".to_owned(),
            Value::Table(_) => "a section".to_owned(),
        }
    }

    /// Whether this value is what headers make: a table, or a list of tables.
    pub(crate) fn is_sections(&self) -> bool {
        match &self.value {
            Value::Table(_) => true,
            Value::List(items) => !items.is_empty() && items.iter().all(|item| item.table().is_some()),
            _ => false,
        }
    }

    /// The table that this value is.
    pub(crate) fn table(&self) -> Option<&Table> {
        match &self.value {
            Value::Table(table) => Some(table),
            _ => None,
        }
    }
}

/// An integer; one too large for 64 bits is a number all the same, to be reported in messages.
fn integer(digits: &str, radix: u32) -> Value {
    i64::from_str_radix(digits, radix).map_or_else(
        |_| {
            let nearest = digits.parse().unwrap_or(f64::INFINITY);
            Value::Float(if radix == 10 { nearest } else { f64::INFINITY })
        },
        Value::Integer,
    )
}
