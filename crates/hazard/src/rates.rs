//! What a table holds, rates or probabilities, into the annual rates of a curve: the rules that all readers share.

use crate::declaration::SecondColumn;
use crate::error::{HazardError, Place};
use crate::probability::rate_from_probability;

/// One level and what was written for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row {
    /// What the reader finds the row by: its line, or its index.
    pub(crate) at: usize,
    /// Level, in the unit of the table.
    pub(crate) im: f64,
    /// Rate [1/yr] or probability; after [`annual_rates`] a rate.
    pub(crate) value: f64,
}

/// Rows that hold rates, and what was left out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AnnualRates {
    pub(crate) rows: Vec<Row>,
    pub(crate) dropped_zeros: usize,
    pub(crate) dropped_certain: usize,
}

/// Turns every value into an annual rate.
///
/// Two kinds of rows carry no information and are dropped and counted: zeros at the end, where an engine has run out of
/// digits or of events, and probabilities of 1 at the beginning (the rate is only known to be large).
///
/// - `years`: period of the probabilities.
/// - `name`: the file, for messages.
/// - `place`: where a row stands, from [`Row::at`].
///
/// # Errors
/// A zero before the end, a probability that no rate belongs to or without its period, fewer than two rows left.
pub(crate) fn annual_rates(
    mut rows: Vec<Row>,
    content: SecondColumn,
    years: Option<f64>,
    name: &str,
    place: impl Fn(usize) -> Place,
) -> Result<AnnualRates, HazardError> {
    if content == SecondColumn::ReturnPeriod {
        if let Some(row) = rows.iter().find(|row| row.value <= 0.0) {
            let reason = format!("the return period is {}: write years above zero", row.value);
            return Err(HazardError::Row { place: place(row.at), reason });
        }
        for row in &mut rows {
            row.value = 1.0 / row.value;
        }
    }
    let before = rows.len();
    while rows.pop_if(|row| row.value == 0.0).is_some() {}
    let dropped_zeros = before - rows.len();
    if let Some(pair) = rows.windows(2).find(|pair| pair[0].value == 0.0) {
        let (place, later_place, later) = (place(pair[0].at), place(pair[1].at), pair[1].value);
        return Err(HazardError::ZeroInside { place, later_place, later });
    }

    let mut dropped_certain = 0;
    if content == SecondColumn::Probability {
        dropped_certain = rows.iter().take_while(|row| row.value == 1.0).count();
        rows.drain(..dropped_certain);
        for row in &mut rows {
            row.value = rate_of_row(row, years, || place(row.at))?;
        }
    }
    if rows.len() < 2 {
        return Err(HazardError::TooFewPoints { name: name.to_owned(), found: rows.len() });
    }
    Ok(AnnualRates { rows, dropped_zeros, dropped_certain })
}

fn rate_of_row(row: &Row, years: Option<f64>, place: impl Fn() -> Place) -> Result<f64, HazardError> {
    let years = years.ok_or_else(|| HazardError::YearsMissing { place: place() })?;
    if row.value > 0.0 && row.value < 1.0 {
        return rate_from_probability(row.value, years);
    }
    let hint = if row.value == 1.0 {
        "probabilities of 1 are dropped at the beginning only: correct or remove this row"
    } else if row.value > 1.0 {
        "divide by 100 if these are per cent, or name the column maf if they are annual rates"
    } else {
        "correct or remove this row"
    };
    Err(HazardError::Probability { place: place(), value: row.value, hint })
}
