//! Summaries of haselREC: lines with a level and means, a header, and a row of words a record.
//!
//! # Source
//! The haselREC repository, `create_output_files`, in its versions of 2019 to 2021.

use super::{SelectedComponent, SelectedName, SelectedRecord, SelectedSet, SelectionTool, factor, wrong};
use crate::error::MotionError;
use crate::pair::Horizontal;
use crate::read::excerpt;

const FACTOR: &str = "scale_factor";
/// Words that the first versions have in their rows, before the factor, and not in their header.
const UNNAMED: usize = 2;

pub(super) fn is_header(line: &str) -> bool {
    let mut words = line.split_whitespace();
    words.next() == Some("num") && words.next() == Some("source") && words.any(|word| word == FACTOR)
}

/// The selection in `text`, whose line with this index is its header.
pub(super) fn parse(text: &str, name: &str, header: usize) -> Result<SelectedSet, MotionError> {
    let columns: Vec<&str> = text.lines().nth(header).unwrap_or_default().split_whitespace().collect();
    let place = |wanted: &[&str]| columns.iter().position(|column| wanted.contains(column));
    let (event, station) = (place(&["event_id", "event_id_ESM"]), place(&["station_code", "station_code_ESM"]));
    let (number, component) = (place(&["recID", "recID_NGA"]), place(&["component"]));
    let factor_from_end = columns.iter().rev().position(|column| *column == FACTOR).unwrap_or_default();
    let mut records = Vec::new();
    for (index, line) in text.lines().enumerate().skip(header + 1) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let position = index + 1;
        if words.is_empty() {
            continue;
        }
        let first_version = factor_from_end == 0 && words.len() == columns.len() + UNNAMED;
        if words.len() != columns.len() && !first_version {
            let reason = format!("{} words under a header of {}: a row is one record", words.len(), columns.len());
            return Err(wrong(name, Some(position), reason));
        }
        let word = |column: Option<usize>| {
            column.and_then(|column| words.get(column)).copied().filter(|word| !["-", "nan", "None"].contains(word))
        };
        let lacks = |what: &str| wrong(name, Some(position), format!("the record has no {what}"));
        let source = words.get(1).copied().unwrap_or_default();
        let record = match source {
            "ESM" => SelectedName::EventStation {
                event: word(event).ok_or_else(|| lacks("event_id"))?.to_owned(),
                station: word(station).ok_or_else(|| lacks("station_code"))?.to_owned(),
            },
            "NGA-West2" => {
                let text = word(number).ok_or_else(|| lacks("recID"))?;
                let rsn = text.strip_suffix(".0").unwrap_or(text).parse().map_err(|_| {
                    let text = excerpt(text);
                    wrong(name, Some(position), format!("recID is {text:?}: the RSN of the record is needed"))
                })?;
                SelectedName::SequenceNumber(rsn)
            }
            _ => SelectedName::Name(word(number).ok_or_else(|| lacks("recID"))?.to_owned()),
        };
        let component = match word(component) {
            None => SelectedComponent::Pair,
            Some("1") => SelectedComponent::Numbered(Horizontal::H1),
            Some("2") => SelectedComponent::Numbered(Horizontal::H2),
            Some(other) => {
                let reason = format!("component is {:?}: 1, 2 or - is needed", excerpt(other));
                return Err(wrong(name, Some(position), reason));
            }
        };
        let factor = factor(words[words.len() - 1 - factor_from_end], name, position)?;
        records.push(SelectedRecord { position, name: record, component, factor });
    }
    Ok(SelectedSet { tool: SelectionTool::HaselRec, level: level(text, name, header)?, records })
}

/// The level above the header; none where the set was selected for the spectrum of a code.
fn level(text: &str, name: &str, header: usize) -> Result<Option<f64>, MotionError> {
    let mut lines = text.lines().take(header).enumerate();
    let Some((index, (_, value))) = lines.find_map(|(index, line)| {
        let parts = line.split_once('=').filter(|(key, _)| key.trim() == "reference hazard value")?;
        Some((index, parts))
    }) else {
        return Ok(None);
    };
    match value.trim().parse::<f64>() {
        Ok(level) if level.is_finite() && level > 0.0 => Ok(Some(level)),
        _ => {
            let reason = format!("the reference hazard value is {:?}: a number above 0 is needed", excerpt(value));
            Err(wrong(name, Some(index + 1), reason))
        }
    }
}
