//! Adding to a result file: it is written again and replaced at once.

use std::path::{Path, PathBuf};
use std::time::Duration;

use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::lock::ResultLock;
use uplift_labelled::{LabelledError, LabelledReader, LabelledWriter};

use super::ResultFile;
use crate::error::ResultError;

/// A result that is being added to: nobody else writes to it meanwhile, from before its numbers are read until what is
/// made of them is in the file.
#[derive(Debug)]
pub struct LockedResult {
    path: PathBuf,
    /// Of the file as it was when this began.
    identity: String,
    _lock: ResultLock,
}

impl LockedResult {
    /// Takes the lock of the result at `path`, and opens it; another that adds to it is waited for.
    ///
    /// # Errors
    /// A file that is missing, damaged or no result; one that another run is writing for longer than a minute; a folder
    /// that cannot be written.
    pub fn open(path: &Path, events: &dyn Events) -> Result<(Self, ResultFile), ResultError> {
        ResultFile::open(path)?;
        if let Some(holder) = ResultLock::holder(path) {
            events.remark("waits", &format!("{} is being written by another run ({holder})", path.display()));
        }
        let lock = ResultLock::wait(path, LONGEST_WAIT)?;
        drop(LabelledWriter::create(path)?);
        let file = ResultFile::open(path)?;
        Ok((Self { path: path.to_owned(), identity: file.identity().to_owned(), _lock: lock }, file))
    }

    /// Writes the file, which this opened, anew: without the groups and axes `replaced`, and with what `add`
    /// writes.
    ///
    /// # Errors
    /// Whatever keeps the file from being read or written; it is then as it was. A file that is not as it was written,
    /// or no longer the one that this opened.
    pub fn write(
        &self,
        replaced: &[impl AsRef<str>],
        add: impl FnOnce(&mut LabelledWriter) -> Result<(), LabelledError>,
    ) -> Result<(), ResultError> {
        let path = &self.path;
        let reader = LabelledReader::open(path)?;
        // a program that knows nothing of the lock may have been there
        if reader.identity() != self.identity {
            return Err(JobError::input(format!(
                "{}: another process has overwritten it meanwhile: run the command again",
                path.display()
            ))
            .into());
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
