//! Lists of `EzGM`: names of the series that it wrote, and their factors, one a line.
//!
//! # Source
//! The `EzGM` package, `write` and `write_records` of its selections.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::{SelectedComponent, SelectedName, SelectedRecord, SelectedSet, SelectionTool, factor, wrong};
use crate::error::MotionError;

/// What the file at `path` has by its name; none where it is not one of these lists.
pub(super) fn components(path: &Path) -> Option<SelectedComponent> {
    match path.file_name()?.to_str()? {
        "GMR_H1_names.txt" => Some(SelectedComponent::Pair),
        "GMR_names.txt" => Some(SelectedComponent::OfFile),
        _ => None,
    }
}

/// The file of factors beside the list at `path`.
pub(super) fn factors_beside(path: &Path) -> Result<PathBuf, MotionError> {
    // without an ending before version 1.6.6.2
    let places = ["GMR_sf_used.txt", "GMR_sf_used"].map(|name| path.with_file_name(name));
    let found = places.into_iter().find(|place| place.is_file());
    found.ok_or_else(|| wrong(&path.display().to_string(), None, "GMR_sf_used.txt, its factors, is not beside it"))
}

pub(super) fn parse(
    [of_names, of_factors]: [Cow<'_, str>; 2],
    [name, name_of_factors]: [&str; 2],
    component: SelectedComponent,
) -> Result<SelectedSet, MotionError> {
    let [records, factors] = [&of_names, &of_factors].map(|text| text.trim_end().lines().collect::<Vec<_>>());
    if records.len() != factors.len() {
        let reason = format!("{} names, and {} factors in {name_of_factors}", records.len(), factors.len());
        return Err(wrong(name, None, reason));
    }
    let mut selected = Vec::new();
    for (index, (record, of_record)) in records.into_iter().zip(factors).enumerate() {
        let position = index + 1;
        if record.trim().is_empty() {
            return Err(wrong(name, Some(position), "the line is empty: the name of a file is needed"));
        }
        let file = SelectedName::Files(vec![record.trim().to_owned()]);
        let factor = factor(of_record, name_of_factors, position)?;
        selected.push(SelectedRecord { position, name: file, component, factor });
    }
    Ok(SelectedSet { tool: SelectionTool::EzGm, level: None, records: selected })
}
