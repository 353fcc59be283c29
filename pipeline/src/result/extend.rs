//! Adding to a result file: it is written anew and replaced at once.

use std::path::Path;
use std::time::{Duration, SystemTime};

use super::StoredStripes;
use crate::error::UpliftError;
use crate::lock::ResultLock;
use uplift_labelled::{LabelledError, LabelledReader, LabelledWriter, Seal, seal_of};

/// Write the file of `stored` anew without the groups and axes `replaced`, and with what `add` writes.
///
/// # Errors
/// Whatever keeps the file from being read or written; it is then as it was. A file that is not as it was written, or
/// no longer the one that `stored` was read from.
pub(crate) fn extend_result(
    stored: &StoredStripes,
    replaced: &[impl AsRef<str>],
    add: impl FnOnce(&mut LabelledWriter) -> Result<(), LabelledError>,
) -> Result<(), UpliftError> {
    let path: &Path = &stored.path;
    // what another adds between our reading and our writing would be lost
    let _lock = ResultLock::wait(path, LONGEST_WAIT)?;
    if Some(whole_seal(path)?) != stored.seal {
        return Err(UpliftError::input(format!(
            "{}: was written anew meanwhile, so these numbers are not of it any more: run the command again",
            path.display()
        )));
    }
    let reader = LabelledReader::open(path)?;
    let mut writer = LabelledWriter::create(path)?;
    let replaced: Vec<&str> = replaced.iter().map(AsRef::as_ref).collect();
    writer.carry_over(&reader, &replaced)?;
    drop(reader);
    add(&mut writer)?;
    writer.finish()?;
    Ok(())
}

/// How long another that adds to the same result is waited for.
const LONGEST_WAIT: Duration = Duration::from_secs(60);

/// The checksum of the result at `path`, every byte of which is as it was written.
///
/// # Errors
/// A file that is damaged or was changed by another program.
pub(crate) fn whole_seal(path: &Path) -> Result<String, UpliftError> {
    let fail = |reason: String| UpliftError::input(format!("{}: {reason}", path.display()));
    match seal_of(path).map_err(|error| fail(error.to_string()))? {
        Seal::Whole(seal) => Ok(seal),
        Seal::Broken | Seal::Missing => {
            Err(fail("is not as it was written (`uplift verify` says where): run the study again".to_owned()))
        }
    }
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
    timestamp(SystemTime::now())
}

/// A time as text; a clock that is set before 1970 or after 9999 stands at the end that is nearer.
fn timestamp(time: SystemTime) -> String {
    let last = SystemTime::UNIX_EPOCH + Duration::from_secs(LAST_SECOND);
    humantime::format_rfc3339_seconds(time.clamp(SystemTime::UNIX_EPOCH, last)).to_string()
}

/// Of the year 9999.
const LAST_SECOND: u64 = 253_402_300_799;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_clock_stops_a_job() {
        let after = |seconds| SystemTime::UNIX_EPOCH + Duration::from_secs(seconds);
        assert_eq!(timestamp(after(1_767_225_600)), "2026-01-01T00:00:00Z");
        assert_eq!(timestamp(SystemTime::UNIX_EPOCH - Duration::from_secs(86_400)), "1970-01-01T00:00:00Z");
        assert_eq!(timestamp(after(LAST_SECOND)), "9999-12-31T23:59:59Z");
        assert_eq!(timestamp(after(LAST_SECOND + 1)), "9999-12-31T23:59:59Z");
    }
}
