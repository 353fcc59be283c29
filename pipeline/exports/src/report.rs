//! What an export wrote.

use std::path::PathBuf;

use serde::Serialize;

/// What was exported.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ExportReport {
    /// The files, in the order of the formats; last the table of answers about structures, where CSV was asked for.
    pub files: Vec<PathBuf>,
    /// What the demands refer to, and what a format of fragilities leaves out.
    pub notes: Vec<String>,
}
