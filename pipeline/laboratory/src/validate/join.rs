//! Two tables of peaks, row to row: by their key, or not at all.

use std::collections::BTreeMap;

use serde::Serialize;
use uplift_job::JobError;

use super::peaks::{PeakValue, Peaks, Row};
use crate::error::LaboratoryError;

/// Rows that a message names.
const TOLD: usize = 5;

/// Rows that stand in no statistic, by their key and groups, or by their number where they have no key.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Unmatched {
    /// Measured, and not computed: there is no such row, or its value is blank.
    pub measured_only: Vec<String>,
    /// Computed, and not measured: there is no such row, or its value is blank.
    pub computed_only: Vec<String>,
    /// Measured rows whose value is blank.
    pub measured_blank: Vec<String>,
    /// Computed rows whose value is blank.
    pub computed_blank: Vec<String>,
}

/// Peaks of either kind that belong to one group; in the order of their motions where they are pairs.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Peers {
    pub(super) measured: Vec<PeakValue>,
    pub(super) computed: Vec<PeakValue>,
}

/// Peaks with the cells that they are grouped by.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Joined {
    /// Pairs: groups, measured, computed.
    Pairs(Vec<(Vec<String>, PeakValue, PeakValue)>),
    /// Samples, each by itself: groups and value.
    Samples { measured: Vec<(Vec<String>, PeakValue)>, computed: Vec<(Vec<String>, PeakValue)> },
}

impl Joined {
    /// Cells of every peak, in order.
    pub(super) fn groups(&self) -> Vec<&Vec<String>> {
        match self {
            Self::Pairs(pairs) => pairs.iter().map(|(groups, ..)| groups).collect(),
            Self::Samples { measured, computed } => measured.iter().chain(computed).map(|(groups, _)| groups).collect(),
        }
    }

    /// Those whose groups are as `wanted`.
    pub(super) fn peers(&self, wanted: impl Fn(&[String]) -> bool) -> Peers {
        let chosen = |rows: &[(Vec<String>, PeakValue)]| {
            rows.iter().filter(|(groups, _)| wanted(groups)).map(|(_, value)| *value).collect()
        };
        match self {
            Self::Pairs(pairs) => {
                let (measured, computed) =
                    pairs.iter().filter(|(groups, ..)| wanted(groups)).map(|(_, m, c)| (*m, *c)).unzip();
                Peers { measured, computed }
            }
            Self::Samples { measured, computed } => Peers { measured: chosen(measured), computed: chosen(computed) },
        }
    }
}

/// Joins rows whose keys, and groups as far as both tables have them, are equal.
///
/// # Errors
/// Keys that stand twice in a table; tables of which nothing matches.
pub(super) fn by_key(measured: &Peaks, computed: &Peaks) -> Result<(Joined, Unmatched), LaboratoryError> {
    let in_both = |place: usize| [measured, computed].iter().all(|table| table.rows[0].groups[place].is_some());
    let shared: Vec<usize> = (0..measured.rows[0].groups.len()).filter(|place| in_both(*place)).collect();
    let key = |row: &Row| -> Vec<String> {
        let groups = shared.iter().filter_map(|place| row.groups[*place].clone());
        row.key.iter().cloned().chain(groups).collect()
    };
    let (of_measured, of_computed) = (keyed(measured, key)?, keyed(computed, key)?);
    let mut unmatched = Unmatched::default();
    let mut pairs = Vec::new();
    for row in &measured.rows {
        let name = key(row);
        match (row.value, of_computed.get(&name).map(|other| (*other, other.value))) {
            (None, _) => unmatched.measured_blank.push(words(&name)),
            (_, None | Some((_, None))) => unmatched.measured_only.push(words(&name)),
            (Some(m), Some((other, Some(c)))) => {
                let groups = row.groups.iter().zip(&other.groups);
                let groups = groups.map(|(one, two)| one.clone().or_else(|| two.clone()).unwrap_or_default()).collect();
                pairs.push((groups, m, c));
            }
        }
    }
    for row in &computed.rows {
        let name = key(row);
        if row.value.is_none() {
            unmatched.computed_blank.push(words(&name));
        } else if of_measured.get(&name).is_none_or(|other| other.value.is_none()) {
            unmatched.computed_only.push(words(&name));
        }
    }
    let without: Vec<String> = [measured, computed]
        .into_iter()
        .filter(|table| table.rows.iter().all(|row| row.value.is_none()))
        .map(|table| format!("{}: no row has a value in its column {}", table.name, table.column))
        .collect();
    if !without.is_empty() {
        return Err(JobError::Inputs(without).into());
    }
    if pairs.is_empty() {
        return Err(JobError::input(format!(
            "{} and {} have no row in common: the first are {:?} and {:?}",
            measured.name,
            computed.name,
            words(&key(&measured.rows[0])),
            words(&key(&computed.rows[0]))
        ))
        .into());
    }
    Ok((Joined::Pairs(pairs), unmatched))
}

/// Rows by their key.
fn keyed(table: &Peaks, key: impl Fn(&Row) -> Vec<String>) -> Result<BTreeMap<Vec<String>, &Row>, LaboratoryError> {
    let mut found: BTreeMap<Vec<String>, &Row> = BTreeMap::new();
    let mut twice = Vec::new();
    for row in &table.rows {
        let name = key(row);
        if let Some(before) = found.get(&name) {
            twice.push(format!(
                "{}: {:?} is in rows {} and {}: name the column that distinguishes them by --by or --key, or leave one",
                table.name,
                words(&name),
                before.number,
                row.number
            ));
        }
        found.entry(name).or_insert(row);
    }
    if twice.is_empty() {
        return Ok(found);
    }
    let others = twice.len().saturating_sub(TOLD);
    twice.truncate(TOLD);
    if others > 0 {
        let rows = if others == 1 { "row repeats" } else { "rows repeat" };
        twice.push(format!("{}: {others} more {rows} an identifier", table.name));
    }
    Err(JobError::Inputs(twice).into())
}

/// Tables without a common key: two samples.
///
/// # Errors
/// A table without a column that the peaks are grouped by, or without a value.
pub(super) fn as_samples(measured: &Peaks, computed: &Peaks) -> Result<(Joined, Unmatched), LaboratoryError> {
    let mut mistakes = Vec::new();
    let mut unmatched = Unmatched::default();
    let mut sample = |table: &Peaks, blank: &mut Vec<String>| {
        for name in &table.missing_groups {
            mistakes.push(format!(
                "{}: has no column {name} to group by, and no key to find it in the other table",
                table.name
            ));
        }
        let mut values = Vec::new();
        for row in &table.rows {
            match row.value {
                Some(value) => values.push((row.groups.iter().flatten().cloned().collect::<Vec<_>>(), value)),
                None => blank.push(format!("row {}", row.number)),
            }
        }
        if values.is_empty() {
            mistakes.push(format!("{}: no row has a value in its column {}", table.name, table.column));
        }
        values
    };
    let measured = sample(measured, &mut unmatched.measured_blank);
    let computed = sample(computed, &mut unmatched.computed_blank);
    if mistakes.is_empty() {
        Ok((Joined::Samples { measured, computed }, unmatched))
    } else {
        Err(JobError::Inputs(mistakes).into())
    }
}

impl Unmatched {
    /// What to say of each kind, the first few by name.
    pub(super) fn notes(&self) -> Vec<String> {
        let kinds = [
            (&self.measured_only, "measured rows have no computed one"),
            (&self.computed_only, "computed rows have no measured one"),
            (&self.measured_blank, "measured rows have no value"),
            (&self.computed_blank, "computed rows have no value"),
        ];
        let told = kinds.into_iter().filter(|(names, _)| !names.is_empty()).map(|(names, what)| {
            let first: Vec<&str> = names.iter().take(TOLD).map(String::as_str).collect();
            let more = if names.len() > TOLD { ", …" } else { "" };
            format!("{} {what}, and are left out: {}{more}", names.len(), first.join("; "))
        });
        told.collect()
    }
}

fn words(key: &[String]) -> String {
    key.join(", ")
}
