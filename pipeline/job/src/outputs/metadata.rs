//! What stands beside a table: where its numbers come from, and its columns.
//!
//! A table is nothing but column names and rows, so that everything that reads CSV opens it as it is. The rest is in
//! `NAME.csv-metadata.json`, where the W3C's standard has programs look for it.
//!
//! # Source
//! W3C, Model for Tabular Data and Metadata on the Web (2015), section 5.3; Metadata Vocabulary for Tabular Data.

use std::path::{Path, PathBuf};

use serde_json::json;

use crate::text::one_line;

/// The file beside the table at `table`.
pub fn metadata_path(table: &Path) -> PathBuf {
    let mut name = table.file_name().unwrap_or_default().to_owned();
    name.push("-metadata.json");
    table.with_file_name(name)
}

/// What that file says: `line`, where the numbers come from, and the names of the columns.
pub fn metadata_text<'a>(table: &Path, line: &str, columns: impl Iterator<Item = &'a str>) -> String {
    let metadata = json!({
        "@context": "http://www.w3.org/ns/csvw",
        "dc:provenance": one_line(line),
        "tableSchema": { "columns": columns.map(|name| json!({ "titles": name })).collect::<Vec<_>>() },
        "url": table.file_name().unwrap_or_default().to_string_lossy(),
    });
    format!("{metadata:#}\n")
}

/// How this program names itself in such a file, but for spaces.
pub(super) const MARK: &[u8] = b"\"dc:provenance\":\"uplift";
