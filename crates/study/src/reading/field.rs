//! A value while it is read: each reading checks, and tells what is wrong.

use std::ops::RangeInclusive;

use super::suggestion::did_you_mean;
use super::{Finding, Findings, Node, Rule, Section, Value, quantity};
use uplift_plausible::{may_be_thousands, with_point};

/// The largest integer of TOML, which has signed ones of 64 bits.
pub(crate) const LARGEST_INTEGER: u64 = i64::MAX as u64;

/// Most items of a list that is no grid.
const MOST_ITEMS: usize = 100;

/// Reads what need not be given: outer none where it is wrong, inner none where it is not given.
#[allow(clippy::option_option)] // wrong and absent are different things, and what is wrong is among the findings
pub(crate) fn optional<'a, T>(
    field: Option<&Field<'a>>,
    read: impl FnOnce(&Field<'a>) -> Option<T>,
) -> Option<Option<T>> {
    match field {
        Some(field) => read(field).map(Some),
        None => Some(None),
    }
}

/// A value being read.
pub(crate) struct Field<'a> {
    pub(crate) key: String,
    pub(crate) node: &'a Node,
    pub(crate) findings: &'a Findings,
}

impl<'a> Field<'a> {
    /// Records a mistake about this value.
    pub(crate) fn mistake(&self, message: impl Into<String>, help: impl Into<String>) {
        self.findings.add(Finding {
            key: self.key.clone(),
            origin: self.node.origin.clone(),
            message: message.into(),
            help: Some(help.into()),
        });
    }

    /// Records a mistake about this value, by which nothing is read of it.
    pub(crate) fn refuse<T>(&self, message: impl Into<String>, help: impl Into<String>) -> Option<T> {
        self.mistake(message, help);
        None
    }

    /// Records that this value is no `expected`.
    pub(crate) fn wrong_type<T>(&self, expected: &str, example: &str) -> Option<T> {
        let found = self.node.describe();
        self.refuse(format!("expected {expected}, found {found}"), example)
    }

    /// Text.
    pub(crate) fn text(&self) -> Option<&'a str> {
        match &self.node.value {
            Value::Text(text) => Some(text),
            _ => self.wrong_type("text", "put text in double quotes; on the command line: --set 'key=\"text\"'"),
        }
    }

    /// Text of which something is left without blanks.
    pub(crate) fn filled_text(&self) -> Option<&'a str> {
        let text = self.text()?;
        if text.trim().is_empty() {
            return self.refuse("the text is empty", "fill it in, or leave the key out");
        }
        Some(text)
    }

    /// `true` or `false`.
    pub(crate) fn boolean(&self) -> Option<bool> {
        match self.node.value {
            Value::Boolean(truth) => Some(truth),
            _ => self.wrong_type("true or false", "write true or false without quotes"),
        }
    }

    /// A finite number \[`unit`\] that satisfies `rule`.
    pub(crate) fn number(&self, unit: &str, rule: Rule) -> Option<f64> {
        let value = match self.node.value {
            Value::Integer(integer) => integer as f64,
            Value::Float(float) => float,
            _ => {
                let expected = if unit.is_empty() { "a number".to_owned() } else { format!("a number [{unit}]") };
                let help = match &self.node.value {
                    Value::Text(text) => {
                        (unit.is_empty().then(|| per_cent_as_fraction(text)).flatten()).or_else(|| commas(text))
                    }
                    _ => None,
                };
                let help = help.unwrap_or_else(|| "write a number without quotes or unit".to_owned());
                return self.wrong_type(&expected, &help);
            }
        };
        self.check(value, unit, rule).then_some(value)
    }

    /// Whether `value` \[`unit`\] is finite and satisfies `rule`; a mistake if not.
    pub(crate) fn check(&self, value: f64, unit: &str, rule: Rule) -> bool {
        if value.is_finite() && rule.holds(value) {
            return true;
        }
        self.mistake(format!("the value is {}", quantity(value, unit)), format!("it must be {}", rule.words()));
        false
    }

    /// An integer from `least` to `most`.
    pub(crate) fn integer(&self, least: u64, most: u64) -> Option<u64> {
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
                self.refuse(format!("the value is {integer}"), format!("it must be a whole number, {range}"))
            }
        }
    }

    /// One of the words of `choices`.
    pub(crate) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Option<T> {
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let list = format!("\"{}\"", words.join("\", \""));
        let Value::Text(text) = &self.node.value else {
            let example = words.last().copied().unwrap_or_default();
            let help = format!("put the word in double quotes: {} = \"{example}\"", self.name());
            return self.wrong_type(&format!("one of {list}"), &help);
        };
        let chosen = choices.iter().find(|(word, _)| word == text);
        if chosen.is_none() {
            let name = self.name();
            let one_of = format!("it is one of {list}");
            let help = did_you_mean(text, &words).map_or(one_of.clone(), |hint| format!("{hint} {one_of}"));
            self.mistake(format!("unknown {name}: {}", self.node.describe()), help);
        }
        chosen.map(|(_, value)| *value)
    }

    /// The last part of the key, without a position in a list.
    fn name(&self) -> &str {
        self.key.rsplit('.').next().and_then(|name| name.split('[').next()).unwrap_or_default()
    }

    /// The items of a list; a value that is none counts as a list of itself.
    pub(crate) fn items(&self) -> Vec<Field<'a>> {
        match &self.node.value {
            Value::List(items) => items
                .iter()
                .enumerate()
                .map(|(position, node)| Field {
                    key: format!("{}[{position}]", self.key),
                    node,
                    findings: self.findings,
                })
                .collect(),
            _ => vec![Field { key: self.key.clone(), node: self.node, findings: self.findings }],
        }
    }

    /// The items of a list that is no grid, at least one and not too many.
    pub(crate) fn few_items(&self) -> Option<Vec<Field<'a>>> {
        let items = self.items();
        if items.is_empty() || items.len() > MOST_ITEMS {
            return self.refuse(format!("the list has {} items", items.len()), format!("give 1 to {MOST_ITEMS}"));
        }
        Some(items)
    }

    /// What `read` makes of each section of a list, as many as `number` allows; none where it makes nothing of one of
    /// them. Messages call one of them `what`, and several by their key.
    pub(crate) fn sections<T>(
        &self,
        what: &str,
        number: RangeInclusive<usize>,
        read: impl FnMut(Field<'a>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let Value::List(_) = self.node.value else {
            let help = format!("head each {what} with [[{}]], in double brackets", self.key);
            return self.wrong_type("a list of sections", &help);
        };
        let items = self.items();
        if !number.contains(&items.len()) {
            let (least, most) = number.into_inner();
            let help = if least == 0 { format!("give at most {most}") } else { format!("give from {least} to {most}") };
            return self.refuse(format!("there are {} {}", items.len(), self.key.replace('_', " ")), help);
        }
        // every one is read, so that the mistakes of all are found
        let read: Vec<Option<T>> = items.into_iter().map(read).collect();
        read.into_iter().collect()
    }

    /// The section that this value is; if it is none, a mistake and an absent section.
    pub(crate) fn section(&self) -> Section<'a> {
        let table = self.node.table();
        if table.is_none() {
            let example = format!("write a section with the header [{}]", self.key);
            self.wrong_type::<()>("a section", &example);
        }
        Section::new(self.key.clone(), self.node.origin.clone(), table, self.findings)
    }
}

/// What to write for a number of per cent.
fn per_cent_as_fraction(text: &str) -> Option<String> {
    let number = text.trim().strip_suffix('%')?.trim().parse::<f64>().ok().filter(|number| number.is_finite())?;
    // 2.8 % is not 0.027999999999999997
    let fraction: f64 = format!("{:.12e}", number / 100.0).parse().unwrap_or(number / 100.0);
    Some(format!("write {fraction} for {number} %"))
}

/// What to write for numbers with commas between them, or within one.
pub(crate) fn commas(text: &str) -> Option<String> {
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let are_numbers = parts.iter().all(|part| part.parse::<f64>().is_ok_and(f64::is_finite));
    if parts.len() < 2 || !are_numbers {
        return None;
    }
    let mut meant = Vec::new();
    meant.extend(may_be_thousands(&parts.join(",")).then(|| parts.concat()));
    meant.extend(with_point(text).map(|point| format!("{point} with a point")));
    // 02 is part of a decimal, or of thousands
    let is_list = parts.iter().all(|part| !part.starts_with('0') || part.starts_with("0.") || *part == "0");
    meant.extend(is_list.then(|| format!("the list [{}] where several numbers may stand", parts.join(", "))));
    match &meant[..] {
        [] => None,
        [one] => Some(format!("write {one}")),
        several => Some(format!("write {}, whichever is meant", several.join(", or "))),
    }
}
