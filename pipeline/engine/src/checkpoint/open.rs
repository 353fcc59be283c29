//! A checkpoint in use: what is known from it, and what is added to it.

use std::collections::HashSet;
use std::path::Path;

use uplift_ida::{AnalysisRow, Cells, IdaError, Peaks, Plan, Shard, Watch, complete};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::lock::ResultLock;

use super::error::CheckpointError;
use super::key::{RowKey, RowKeys};
use super::row_file::{FinishedRows, RowFile, RowFileHead};
use crate::error::EngineError;

/// Finished analysis rows of a job: those known from before, and a file that takes up each further one when it is
/// finished.
#[derive(Debug)]
pub struct Checkpoint {
    /// None where a job goes on without one.
    file: Option<RowFile>,
    rows: FinishedRows,
    /// Bytes of the file that were cut off or damaged.
    damaged_bytes: u64,
    /// Held where nothing else keeps a second job off the file.
    _lock: Option<ResultLock>,
}

impl Checkpoint {
    /// No file, and nothing known: what is finished lives as long as the job.
    pub fn none() -> Self {
        Self { file: None, rows: FinishedRows::default(), damaged_bytes: 0, _lock: None }
    }

    /// The file at `path`, with the rows that it holds; see [`RowFile::open`].
    pub(crate) fn open(
        path: &Path,
        head: &RowFileHead,
        own: impl FnOnce() -> HashSet<RowKey>,
    ) -> Result<Self, EngineError> {
        let (file, found) = RowFile::open(path, head, own)?;
        Ok(Self { file: Some(file), rows: found.rows, damaged_bytes: found.damaged_bytes, _lock: None })
    }

    /// The same, with the lock that keeps a second job off its file.
    pub(crate) fn locked(self, lock: ResultLock) -> Self {
        Self { _lock: Some(lock), ..self }
    }

    /// Where it is, if there is a file.
    pub fn path(&self) -> Option<&Path> {
        self.file.as_ref().map(RowFile::path)
    }

    /// Adds rows that are known from elsewhere.
    pub fn extend(&mut self, rows: FinishedRows) {
        self.rows.extend(rows);
    }

    /// The rows known from before.
    pub fn rows(&self) -> &FinishedRows {
        &self.rows
    }

    /// Lets go of the rows known from before, once they are where they belong.
    pub fn release_rows(&mut self) {
        self.rows = FinishedRows::default();
    }

    /// Bytes of the file that were cut off or damaged.
    pub fn damaged_bytes(&self) -> u64 {
        self.damaged_bytes
    }

    /// Carries out what is missing of one shard of `plan`; every finished row goes to the file, and then to `keep`.
    ///
    /// # Errors
    /// [`IdaError::Cancelled`] where `watch` says so, and where the file takes up no more ([`stopped`](Self::stopped)).
    pub(crate) fn complete(
        &self,
        (plan, keys): (&Plan<'_>, &RowKeys),
        mut cells: Cells,
        shard: Shard,
        watch: &dyn Watch,
        keep: &(dyn Fn(&AnalysisRow<'_>) + Sync),
    ) -> Result<Cells, IdaError> {
        self.rows.fill(keys, &mut cells);
        let append = |row: &AnalysisRow<'_>| {
            if let Some(file) = &self.file {
                file.append(keys.at(row.motion, row.system), row);
            }
            keep(row);
        };
        complete(plan, cells, shard, &UntilFull { watch, file: self.file.as_ref() }, &append)
    }

    /// The peaks of a plan without a remark.
    ///
    /// # Errors
    /// Rows that are missing or of another length.
    pub fn peaks(&self, plan: &Plan<'_>, motions: &[String], watch: &dyn Watch) -> Result<Peaks, IdaError> {
        let keys = RowKeys::from_plan(plan, motions);
        let cells = self.complete((plan, &keys), Cells::unknown(plan), Shard::WHOLE, watch, &|_| {})?;
        cells.complete().ok_or(IdaError::Cancelled)
    }

    /// What a job ends with that was stopped, `done` of `total` analyses finished: by the user, or by a file that takes
    /// up no more.
    pub fn stopped(&self, done: u64, total: u64) -> EngineError {
        let Some(file) = &self.file else { return JobError::Interrupted.into() };
        match file.sync().map_or_else(Some, |()| file.full()) {
            Some(error) => error.into(),
            None => JobError::Paused { what: "analyses", done, total, path: file.path().to_owned() }.into(),
        }
    }

    /// Brings everything to the disk.
    ///
    /// # Errors
    /// What the operating system says; a row that could not be appended.
    pub fn sync(&self) -> Result<(), CheckpointError> {
        let Some(file) = &self.file else { return Ok(()) };
        file.full().map_or_else(|| file.sync(), Err)
    }

    /// Takes the file away, once its rows are in a result; one that holds rows of other settings too, which may be all
    /// that is left of an interrupted run, stays.
    pub fn remove_unless_shared(self, events: &dyn Events) {
        match &self.file {
            Some(file) if file.has_others => events.note(&format!(
                "{} stays: it holds analyses of other settings; delete it if they are of no use",
                file.path().display()
            )),
            _ => self.remove(),
        }
    }

    /// Takes the file away, once its rows are in a result or told.
    pub fn remove(self) {
        if let Some(file) = self.file {
            file.remove();
        }
    }
}

/// Stops when the user says so, and when nothing more can be appended.
struct UntilFull<'a> {
    watch: &'a dyn Watch,
    file: Option<&'a RowFile>,
}

impl Watch for UntilFull<'_> {
    fn finished(&self, analyses: u64) {
        self.watch.finished(analyses);
    }

    fn cancelled(&self) -> bool {
        self.watch.cancelled() || self.file.is_some_and(RowFile::is_full)
    }
}
