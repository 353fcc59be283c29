//! Output files of `CS_Selection`: what to do with them, a header, and a row a record, between tabs.
//!
//! The record sequence numbers of a selection of two components are rows of the tool's database, whichever that is, so
//! records go by the names of their files.
//!
//! # Source
//! The `CS_Selection` repository, `write_output.m`.

use super::{SelectedComponent, SelectedName, SelectedRecord, SelectedSet, SelectionTool, factor, wrong};
use crate::error::MotionError;

pub(super) fn is_header(line: &str) -> bool {
    line.split('\t').next().is_some_and(|first| first.trim() == "Record Number")
}

/// The selection in `text`, whose line with this index is its header.
pub(super) fn parse(text: &str, name: &str, header: usize) -> Result<SelectedSet, MotionError> {
    let columns: Vec<&str> = text.lines().nth(header).unwrap_or_default().split('\t').map(str::trim).collect();
    let place = |wanted: &str| columns.iter().position(|column| *column == wanted);
    let lacks = |column: &str| wrong(name, Some(header + 1), format!("the header has no {column}"));
    let of_factor = place("Scale Factor").or_else(|| place("Scale Factor (H)")).ok_or_else(|| lacks("Scale Factor"))?;
    let (files, component) = match (place("File Name"), place("File Name Dir. 1"), place("File Name Dir. 2")) {
        (Some(file), ..) => (vec![file], SelectedComponent::OfFile),
        (None, Some(first), Some(second)) => (vec![first, second], SelectedComponent::Pair),
        _ => return Err(lacks("File Name, or File Name Dir. 1 and Dir. 2")),
    };
    let mut records = Vec::new();
    for (index, line) in text.lines().enumerate().skip(header + 1).filter(|(_, line)| !line.trim().is_empty()) {
        let position = index + 1;
        let cells: Vec<&str> = line.split('\t').map(str::trim).collect();
        if cells.len() != columns.len() {
            let reason = format!("{} cells between tabs, expected {}", cells.len(), columns.len());
            return Err(wrong(name, Some(position), reason));
        }
        let files: Vec<String> = files.iter().map(|&file| cells[file].to_owned()).collect();
        if files.iter().any(String::is_empty) {
            return Err(wrong(name, Some(position), "the record has no file name"));
        }
        let factor = factor(cells[of_factor], name, position)?;
        records.push(SelectedRecord { position, name: SelectedName::Files(files), component, factor });
    }
    Ok(SelectedSet { tool: SelectionTool::CsSelection, level: None, records })
}
