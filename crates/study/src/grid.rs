//! Grids: increasing numbers with the notation that gives them.

pub(crate) mod notation;

use std::fmt;
use std::ops::Deref;
use std::str::FromStr;

use serde::Serialize;

use crate::reading::{Field, Findings, Node, Origin, Rule, Value, quantity};
pub use notation::MOST_GRID_VALUES;

/// What is wrong with the notation of a grid, and what to do.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{message}: {help}")]
pub struct GridError {
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
}

/// A strictly increasing list of finite numbers, not empty, with the notation in which it was given.
///
/// It reads as a slice of its values and is written as its notation.
#[derive(Clone, PartialEq)]
pub struct Grid {
    pieces: Vec<Piece>,
    values: Vec<f64>,
}

/// A part of a grid's notation.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
enum Piece {
    Number(f64),
    Range(String),
}

impl fmt::Debug for Grid {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.values.len();
        write!(formatter, "Grid({:?}, {count} values)", self.pieces)
    }
}

impl Deref for Grid {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values
    }
}

impl Serialize for Grid {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.pieces.serialize(serializer)
    }
}

/// What the values of a grid must be.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GridRule {
    pub(crate) unit: &'static str,
    pub(crate) each: Rule,
    pub(crate) least_count: usize,
}

impl Grid {
    /// The grid of the notations `default`.
    pub(crate) fn from_default(default: &[&str], rule: GridRule) -> Option<Self> {
        let node = |value| Node { origin: Origin::Study, value };
        let items = default.iter().map(|text| node(Value::Text((*text).to_owned())));
        let list = node(Value::List(items.collect()));
        Self::read(&Field { key: "default".to_owned(), node: &list, findings: &Findings::default() }, rule)
    }

    /// Reads and checks a grid: a number, a notation, a table of start, stop and count, or a list of these.
    pub(crate) fn read(field: &Field<'_>, rule: GridRule) -> Option<Self> {
        let too_many =
            || field.refuse(format!("the grid has more than {MOST_GRID_VALUES} values"), "take a larger step");
        if matches!(&field.node.value, Value::List(items) if items.len() > MOST_GRID_VALUES) {
            return too_many();
        }
        let mut grid = Self { pieces: Vec::new(), values: Vec::new() };
        let mut complete = true;
        for item in field.items() {
            complete &= grid.append(&item, rule).is_some();
            if grid.values.len() > MOST_GRID_VALUES {
                return too_many();
            }
        }
        if complete && grid.values.len() < rule.least_count {
            return field.refuse(
                match grid.values.len() {
                    0 => "the grid is empty".to_owned(),
                    count => format!("too few values in the grid: {count}"),
                },
                format!("give at least {}, as numbers or as \"start:step:stop\"", rule.least_count),
            );
        }
        complete.then_some(grid)
    }

    fn append(&mut self, item: &Field<'_>, rule: GridRule) -> Option<()> {
        let (piece, values) = piece(item, rule.unit)?;
        if !values.iter().all(|&value| item.check(value, rule.unit, rule.each)) {
            return None;
        }
        self.extend(piece, &values, rule.unit).map_err(|error| item.mistake(error.message, error.help)).ok()
    }

    /// Appends the values of a piece, which must go on increasing.
    fn extend(&mut self, piece: Piece, values: &[f64], unit: &str) -> Result<(), GridError> {
        for &value in values {
            if let Some(&last) = self.values.last().filter(|&&last| value <= last) {
                return Err(GridError {
                    message: format!(
                        "{} follows {}, but a grid must increase",
                        quantity(value, unit),
                        quantity(last, unit)
                    ),
                    help: "sort the values and give each once; \"start:step:stop\" includes both ends".to_owned(),
                });
            }
            self.values.push(value);
        }
        self.pieces.push(piece);
        Ok(())
    }
}

impl Grid {
    /// This grid after the values of `notations`, numbers or `start:step:stop`.
    ///
    /// # Errors
    /// A notation that is none, or values that do not increase up to those of this grid.
    pub(crate) fn preceded_by(&self, notations: &[String]) -> Result<Self, GridError> {
        let mut grid = Self { pieces: Vec::new(), values: Vec::new() };
        for notation in notations {
            let (piece, values) = expanded(notation)?;
            grid.extend(piece, &values, "")?;
        }
        // the last piece brings all values, so that they are compared once
        grid.extend(Piece::Number(self.values[0]), &self.values, "")?;
        grid.pieces.pop();
        grid.pieces.extend_from_slice(&self.pieces);
        Ok(grid)
    }
}

impl fmt::Display for Grid {
    /// As a study file has it: `[1, "2:0.5:20"]`.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let piece = |piece: &Piece| match piece {
            Piece::Number(number) => number.to_string(),
            Piece::Range(notation) => format!("\"{notation}\""),
        };
        write!(formatter, "[{}]", self.pieces.iter().map(piece).collect::<Vec<_>>().join(", "))
    }
}

impl FromStr for Grid {
    type Err = GridError;

    /// The grid of numbers, fractions and `start:step:stop`, set apart by commas, as it is typed on a command line:
    /// `0.5,1:1/4:10`.
    fn from_str(text: &str) -> Result<Self, GridError> {
        let mut grid = Self { pieces: Vec::new(), values: Vec::new() };
        for item in text.split(',') {
            let (piece, values) = expanded(item.trim())?;
            grid.extend(piece, &values, "")?;
        }
        Ok(grid)
    }
}

/// One item of a grid: its notation and its values.
fn piece(item: &Field<'_>, unit: &str) -> Option<(Piece, Vec<f64>)> {
    let expanded = |text: &str| expanded(text).map_err(|error| item.mistake(error.message, error.help)).ok();
    match &item.node.value {
        Value::Integer(integer) => Some(number(*integer as f64)),
        Value::Float(float) => Some(number(*float)),
        Value::Text(text) => expanded(text),
        Value::Table(_) => expanded(&equal_steps(item, unit)?),
        _ => item.wrong_type(
            &format!("a grid{}", bracketed(unit)),
            "write numbers, \"start:step:stop\", or a list of these",
        ),
    }
}

/// The notation `text` and its values; a number in quotes is a number, a fraction stays as it is written.
fn expanded(text: &str) -> Result<(Piece, Vec<f64>), GridError> {
    let values = notation::values(text)?;
    Ok(match values[..] {
        [value] if !text.contains(['/', ':']) => number(value),
        _ => (Piece::Range(text.to_owned()), values),
    })
}

fn number(value: f64) -> (Piece, Vec<f64>) {
    (Piece::Number(value), vec![value])
}

fn bracketed(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" [{unit}]") }
}

/// The notation of a table of start, stop and count.
fn equal_steps(item: &Field<'_>, unit: &str) -> Option<String> {
    const ANY: Rule = Rule::Finite("a finite number");
    let mut section = item.section();
    let fields = [section.field("start"), section.field("stop")];
    let count = section.field("count");
    let mut missing = Vec::new();
    for (key, field) in ["start", "stop", "count"].iter().zip([&fields[0], &fields[1], &count]) {
        if field.is_none() {
            missing.push(*key);
        }
    }
    if !missing.is_empty() {
        section.mistake(
            "",
            format!("the grid has no {}", missing.join(", ")),
            "write { start = 0, stop = 1, count = 301 }",
        );
    }
    section.finish();
    let [start, stop] = fields.map(|field| field?.number(unit, ANY));
    let count = count?.integer(2, MOST_GRID_VALUES as u64);
    let (start, stop, count) = (start?, stop?, i64::try_from(count?).ok()?);
    match notation::equal_steps(start, stop, count) {
        Ok(notation) => Some(notation),
        Err(GridError { message, help }) => item.refuse(message, help),
    }
}
