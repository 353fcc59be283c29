//! Reading the document key by key: each reading checks, and puts what is wrong into a ledger.

use std::cell::RefCell;

use super::document::{Node, Origin, Table, Value};
use super::suggestion::{did_you_mean, other_unit};

/// A mistake before its place is known as line and column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Finding {
    pub(super) key: String,
    pub(super) origin: Origin,
    pub(super) message: String,
    pub(super) help: Option<String>,
}

/// The findings so far.
#[derive(Debug, Default)]
pub(super) struct Ledger(RefCell<Vec<Finding>>);

impl Ledger {
    pub(super) fn add(&self, finding: Finding) {
        self.0.borrow_mut().push(finding);
    }

    pub(super) fn into_findings(self) -> Vec<Finding> {
        self.0.into_inner()
    }
}

/// The largest integer of TOML, which has signed ones of 64 bits.
pub(super) const LARGEST_INTEGER: u64 = i64::MAX as u64;

/// What a number must satisfy, as a test and in words.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rule {
    pub(super) holds: fn(f64) -> bool,
    pub(super) words: &'static str,
}

pub(super) const ABOVE_ZERO: Rule = Rule { holds: |value| value > 0.0, words: "above zero" };
pub(super) const ZERO_OR_MORE: Rule = Rule { holds: |value| value >= 0.0, words: "zero or above" };
pub(super) const ZERO_TO_ONE: Rule = Rule { holds: |value| (0.0..=1.0).contains(&value), words: "between 0 and 1" };
pub(super) const PROBABILITY: Rule =
    Rule { holds: |value| value > 0.0 && value < 1.0, words: "above 0 and below 1 (10 % is 0.1)" };

/// A number with its unit, for messages.
pub(super) fn quantity(value: f64, unit: &str) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-6..1e15).contains(&value.abs());
    let number = if plain { value.to_string() } else { format!("{value:e}") };
    format!("{number} {unit}").trim_end().to_owned()
}

/// A table being read. It learns its keys as they are asked for; [`Section::finish`] reports the
/// others.
pub(super) struct Section<'a> {
    path: String,
    origin: Origin,
    table: Option<&'a Table>,
    known: Vec<&'static str>,
    ledger: &'a Ledger,
}

impl<'a> Section<'a> {
    /// The whole document.
    pub(super) fn root(table: &'a Table, ledger: &'a Ledger) -> Self {
        Self { path: String::new(), origin: Origin::Study, table: Some(table), known: Vec::new(), ledger }
    }

    /// Whether the document has this section.
    pub(super) fn is_present(&self) -> bool {
        self.table.is_some()
    }

    /// The value of `key`, if given.
    pub(super) fn field(&mut self, key: &'static str) -> Option<Field<'a>> {
        if !self.known.contains(&key) {
            self.known.push(key);
        }
        let entry = self.table?.get(key)?;
        Some(Field { key: self.join(key), node: &entry.node, ledger: self.ledger })
    }

    /// The section of `key` within this one; absent if it is not given or no table.
    pub(super) fn section(&mut self, key: &'static str) -> Section<'a> {
        match self.field(key) {
            Some(field) => field.section(),
            None => Section {
                path: self.join(key),
                origin: self.origin.clone(),
                table: None,
                known: Vec::new(),
                ledger: self.ledger,
            },
        }
    }

    /// The number of `key` \[`unit`\], or `default` where it is not given.
    pub(super) fn number_or(&mut self, key: &'static str, unit: &str, rule: Rule, default: f64) -> Option<f64> {
        self.field(key).map_or(Some(default), |field| field.number(unit, rule))
    }

    /// The truth of `key`, or `default` where it is not given.
    pub(super) fn boolean_or(&mut self, key: &'static str, default: bool) -> Option<bool> {
        self.field(key).map_or(Some(default), |field| field.boolean())
    }

    /// The `seed` of this section, or `default` where it is not given.
    pub(super) fn seed_or(&mut self, default: u64) -> Option<u64> {
        self.field("seed").map_or(Some(default), |field| field.integer(0, LARGEST_INTEGER))
    }

    /// Records a mistake about `key`, one that this section should have or should not.
    pub(super) fn mistake(&self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.ledger.add(Finding {
            key: self.join(key),
            origin: self.origin.clone(),
            message: message.into(),
            help: Some(help.into()),
        });
    }

    /// Reports the keys that nobody asked for.
    pub(super) fn finish(self) {
        for entry in self.table.iter().flat_map(|table| &table.entries) {
            if self.known.contains(&entry.key.as_str()) {
                continue;
            }
            let what = if entry.node.is_sections() { "section" } else { "key" };
            let help = did_you_mean_key(&entry.key, &self.known).unwrap_or_else(|| {
                let place = if self.path.is_empty() { "the file".to_owned() } else { format!("`{}`", self.path) };
                format!("{place} has {}", self.known.join(", "))
            });
            self.ledger.add(Finding {
                key: self.join(&entry.key),
                origin: entry.key_origin.clone(),
                message: format!("unknown {what} `{}`", entry.key),
                help: Some(help),
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

fn did_you_mean_key(key: &str, known: &[&str]) -> Option<String> {
    other_unit(key, known).or_else(|| did_you_mean(key, known))
}

/// Reads what need not be given: outer none where it is wrong, inner none where it is not given.
#[allow(clippy::option_option)] // wrong and absent are different things, and the ledger has the rest
pub(super) fn optional<'a, T>(
    field: Option<&Field<'a>>,
    read: impl FnOnce(&Field<'a>) -> Option<T>,
) -> Option<Option<T>> {
    match field {
        Some(field) => read(field).map(Some),
        None => Some(None),
    }
}

/// A value being read.
pub(super) struct Field<'a> {
    pub(super) key: String,
    pub(super) node: &'a Node,
    pub(super) ledger: &'a Ledger,
}

impl<'a> Field<'a> {
    /// Records a mistake about this value.
    pub(super) fn mistake(&self, message: impl Into<String>, help: impl Into<String>) {
        self.ledger.add(Finding {
            key: self.key.clone(),
            origin: self.node.origin.clone(),
            message: message.into(),
            help: Some(help.into()),
        });
    }

    /// Records that this value is no `expected`.
    pub(super) fn wrong_type<T>(&self, expected: &str, example: &str) -> Option<T> {
        let found = self.node.describe();
        self.mistake(format!("expected {expected}, found {found}"), example);
        None
    }

    /// Text.
    pub(super) fn text(&self) -> Option<&'a str> {
        match &self.node.value {
            Value::Text(text) => Some(text),
            _ => self.wrong_type("text", "put text in double quotes; on the command line: --set 'key=\"text\"'"),
        }
    }

    /// Text of which something is left without blanks.
    pub(super) fn filled_text(&self) -> Option<&'a str> {
        let text = self.text()?;
        if text.trim().is_empty() {
            self.mistake("the text is empty", "fill it in, or leave the key out");
            return None;
        }
        Some(text)
    }

    /// `true` or `false`.
    pub(super) fn boolean(&self) -> Option<bool> {
        match self.node.value {
            Value::Boolean(truth) => Some(truth),
            _ => self.wrong_type("true or false", "write true or false without quotes"),
        }
    }

    /// A finite number \[`unit`\] that satisfies `rule`.
    pub(super) fn number(&self, unit: &str, rule: Rule) -> Option<f64> {
        let value = match self.node.value {
            Value::Integer(integer) => integer as f64,
            Value::Float(float) => float,
            _ => {
                let expected = if unit.is_empty() { "a number".to_owned() } else { format!("a number [{unit}]") };
                return self.wrong_type(&expected, "write a number without quotes or unit");
            }
        };
        self.check(value, unit, rule).then_some(value)
    }

    /// Whether `value` \[`unit`\] is finite and satisfies `rule`; a mistake if not.
    pub(super) fn check(&self, value: f64, unit: &str, rule: Rule) -> bool {
        if value.is_finite() && (rule.holds)(value) {
            return true;
        }
        self.mistake(format!("the value is {}", quantity(value, unit)), format!("it must be {}", rule.words));
        false
    }

    /// An integer from `least` to `most`.
    pub(super) fn integer(&self, least: u64, most: u64) -> Option<u64> {
        let Value::Integer(integer) = self.node.value else {
            return self.wrong_type("a whole number", "write a whole number without quotes");
        };
        match u64::try_from(integer) {
            Ok(value) if (least..=most).contains(&value) => Some(value),
            _ => {
                let range = if most == LARGEST_INTEGER {
                    format!("{least} or above")
                } else {
                    format!("from {least} to {most}")
                };
                self.mistake(format!("the value is {integer}"), format!("it must be a whole number, {range}"));
                None
            }
        }
    }

    /// One of the words of `choices`.
    pub(super) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Option<T> {
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let list = format!("\"{}\"", words.join("\", \""));
        let Value::Text(text) = &self.node.value else {
            return self.wrong_type(&format!("one of {list}"), "put the word in double quotes");
        };
        let chosen = choices.iter().find(|(word, _)| word == text);
        if chosen.is_none() {
            let name = self.key.rsplit('.').next().and_then(|name| name.split('[').next()).unwrap_or_default();
            let one_of = format!("it is one of {list}");
            let help = did_you_mean(text, &words).map_or(one_of.clone(), |hint| format!("{hint} {one_of}"));
            self.mistake(format!("unknown {name}: {}", self.node.describe()), help);
        }
        chosen.map(|(_, value)| *value)
    }

    /// The items of a list; a value that is none counts as a list of itself.
    pub(super) fn items(&self) -> Vec<Field<'a>> {
        match &self.node.value {
            Value::List(items) => items
                .iter()
                .enumerate()
                .map(|(position, node)| Field { key: format!("{}[{position}]", self.key), node, ledger: self.ledger })
                .collect(),
            _ => vec![Field { key: self.key.clone(), node: self.node, ledger: self.ledger }],
        }
    }

    /// The section that this value is; if it is none, a mistake and an absent section.
    pub(super) fn section(&self) -> Section<'a> {
        let table = self.node.table();
        if table.is_none() {
            let example = format!("write a section with the header [{}]", self.key);
            self.wrong_type::<()>("a section", &example);
        }
        Section {
            path: self.key.clone(),
            origin: self.node.origin.clone(),
            table,
            known: Vec::new(),
            ledger: self.ledger,
        }
    }
}
