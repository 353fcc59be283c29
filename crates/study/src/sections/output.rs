//! The section `[output]`: what is written where.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::keys::{Boolean, File, Key, SectionKeys, boolean, file};
use crate::reading::{Paths, Section};

pub(crate) const KEYS: SectionKeys = SectionKeys::new("output", &[&FILE, &CSV]);
const FILE: Key<File> = file("file")
    .without_default("`results/<name of the study file>.h5` in the current directory")
    .meaning("the result file (HDF5)")
    .note("ends in `.h5`; no folder, no input of the study");
const CSV: Key<Boolean> =
    boolean("csv").with_default(true).meaning("whether tables are written beside it, as CSV and GeoJSON");

/// What is written where.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Output {
    /// The result file, absolute; it need not exist.
    pub file: PathBuf,
    /// Whether tables are written as CSV beside it.
    pub csv: bool,
}

impl Output {
    /// The folder of the results.
    pub fn folder(&self) -> &Path {
        self.file.parent().unwrap_or(&self.file)
    }
}

/// Reads the section; the result must be none of the `inputs`.
pub(crate) fn read<'a>(
    mut section: Section<'_>,
    paths: &Paths,
    inputs: impl Iterator<Item = &'a Path>,
) -> Option<Output> {
    let csv = section.read(&CSV);
    let file = if let Some(field) = section.given(&FILE) {
        paths.output(&field, inputs)
    } else {
        let file = paths.default_output();
        if file.is_dir() || file.to_str().is_none() {
            section.mistake(
                FILE.name,
                format!("the result file cannot be {}", file.display()),
                "give it a name, e.g. file = \"/data/study.h5\"",
            );
        }
        Some(file)
    };
    section.finish();
    Some(Output { file: file?, csv: csv? })
}
