//! Adding to a result file: it is written anew and replaced at once.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use super::{ResultFile, StoredStripes};
use crate::error::UpliftError;
use crate::events::Events;
use crate::lock::ResultLock;
use uplift_labelled::{LabelledError, LabelledReader, LabelledWriter};

/// A result that is being added to: nobody else writes to it meanwhile, from before its numbers are read until what is
/// made of them is in the file.
#[derive(Debug)]
pub(crate) struct Addition {
    path: PathBuf,
    /// Of the file as it was when this began.
    identity: String,
    _lock: ResultLock,
}

impl Addition {
    /// Takes the lock of the result at `path`, and opens it; another that adds to it is waited for.
    ///
    /// # Errors
    /// A file that is missing, damaged or no result; one that another run is writing for longer than a minute; a folder
    /// that cannot be written.
    pub(crate) fn begin(path: &Path, events: &dyn Events) -> Result<(Self, ResultFile), UpliftError> {
        ResultFile::open(path)?;
        if let Some(holder) = ResultLock::holder(path) {
            events.remark("waits", &format!("{} is being written by another run ({holder})", path.display()));
        }
        let lock = ResultLock::wait(path, LONGEST_WAIT)?;
        drop(LabelledWriter::create(path)?);
        let file = ResultFile::open(path)?;
        Ok((Self { path: path.to_owned(), identity: file.identity().to_owned(), _lock: lock }, file))
    }

    /// Writes the file, which this began with, anew: without the groups and axes `replaced`, and with what `add`
    /// writes.
    ///
    /// # Errors
    /// Whatever keeps the file from being read or written; it is then as it was. A file that is not as it was written,
    /// or no longer the one that this began with.
    pub(crate) fn write(
        &self,
        replaced: &[impl AsRef<str>],
        add: impl FnOnce(&mut LabelledWriter) -> Result<(), LabelledError>,
    ) -> Result<(), UpliftError> {
        let path = &self.path;
        let reader = LabelledReader::open(path)?;
        // a program that knows nothing of the lock may have been there
        if reader.identity() != self.identity {
            return Err(UpliftError::input(format!(
                "{}: was written anew meanwhile, so these numbers are not of it any more: run the command again",
                path.display()
            )));
        }
        let mut writer = LabelledWriter::create(path)?;
        let replaced: Vec<&str> = replaced.iter().map(AsRef::as_ref).collect();
        writer.carry_over(&reader, &replaced)?;
        drop(reader);
        add(&mut writer)?;
        writer.finish()?;
        Ok(())
    }
}

/// How long another that adds to the same result is waited for.
const LONGEST_WAIT: Duration = Duration::from_secs(60);

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
        "uplift {} ({}), {}; {what}; result {}; study digest {}; records: {}",
        crate::VERSION,
        crate::COMMIT,
        now(),
        stored.path.file_name().unwrap_or_default().to_string_lossy(),
        stored.study_digest,
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
