//! The section `[output]`: what is written where.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::keys::{Key, SectionKeys};
use crate::reading::{Paths, Section};

pub(crate) const KEYS: SectionKeys = SectionKeys {
    section: "output",
    keys: &[
        Key {
            names: &["file"],
            meaning: "the result file (HDF5)",
            default: "`results/<name of the study file>.h5` in the current directory",
            range: "ends in `.h5`; no folder, no input of the study",
        },
        Key {
            names: &["csv"],
            meaning: "whether tables are written as CSV beside it; those of `[site_table]` always are",
            default: "`true`",
            range: "",
        },
    ],
};

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
    let csv = section.boolean_or("csv", true);
    let file = if let Some(field) = section.field("file") {
        paths.output(&field, inputs)
    } else {
        let file = paths.default_output();
        if file.is_dir() || file.to_str().is_none() {
            section.mistake(
                "file",
                format!("the result file cannot be {}", file.display()),
                "give it a name, e.g. file = \"/data/study.h5\"",
            );
        }
        Some(file)
    };
    section.finish();
    Some(Output { file: file?, csv: csv? })
}
