//! Adding to a result file: it is written anew and replaced at once.

use std::path::Path;
use std::time::SystemTime;

use super::StoredStripes;
use crate::error::UpliftError;
use crate::kept::ResultLock;
use crate::labelled::{LabelledError, LabelledReader, LabelledWriter};

/// Write the file at `path` anew without the groups and axes `replaced`, and with what `add` writes.
///
/// # Errors
/// Whatever keeps the file from being read or written; it is then as it was.
pub(crate) fn extend_result(
    path: &Path,
    replaced: &[&str],
    add: impl FnOnce(&mut LabelledWriter) -> Result<(), LabelledError>,
) -> Result<(), UpliftError> {
    // what another adds between our reading and our writing would be lost
    let _lock = ResultLock::acquire(path)?;
    let reader = LabelledReader::open(path)?;
    let mut writer = LabelledWriter::create(path)?;
    writer.carry_over(&reader, replaced)?;
    drop(reader);
    add(&mut writer)?;
    writer.finish()?;
    Ok(())
}

/// Note on the group `group` what made it, and when.
pub(crate) fn sign(writer: &mut LabelledWriter, group: &str) -> Result<(), LabelledError> {
    writer.group(group)?;
    writer.attribute(group, "created", now().as_str())?;
    writer.attribute(group, "version", crate::VERSION)?;
    writer.attribute(group, "commit", crate::COMMIT)
}

/// One line for the head of a table made from `stored`: program, time, `what` it holds, file and records.
pub(crate) fn line(stored: &StoredStripes, what: &str) -> String {
    format!(
        "uplift {} ({}), {}; {what}; result {}; records: {}",
        crate::VERSION,
        crate::COMMIT,
        now(),
        stored.path.file_name().unwrap_or_default().to_string_lossy(),
        stored.record_set
    )
    .replace(['\n', '\r'], " ")
}

/// Coordinated universal time, `2026-01-31T12:00:00Z`.
pub(crate) fn now() -> String {
    humantime::format_rfc3339_seconds(SystemTime::now()).to_string()
}
