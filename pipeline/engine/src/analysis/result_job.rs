//! Work that is asked of a finished result: its checkpoint lies beside that result, and so do its shards.

use std::path::{Path, PathBuf};

use uplift_ida::Shard;
use uplift_job::events::Events;

use super::{Analysed, ShardReport, Work, join, run_shard};
use crate::checkpoint::{Checkpoint, FinishedRows, path_beside};
use crate::error::EngineError;

/// What is asked, and of which result.
#[derive(Debug, Clone, Copy)]
pub struct ResultJob<'a> {
    /// The result file.
    pub result: &'a Path,
    /// What is asked, for the names of files: command and structure.
    pub name: &'a str,
}

impl ResultJob<'_> {
    /// Where a shard of the work goes unless it is reported where.
    pub fn shard_path(&self, Shard { index, count }: Shard) -> PathBuf {
        let width = count.to_string().len();
        path_beside(self.result, self.name, &format!("shard-{:0width$}-of-{count}", index + 1))
    }

    /// Carries out all of `work`, but for the rows in `shards`: the result of each plan, and the checkpoint, to be
    /// [removed](Checkpoint::remove) when the answer is given.
    ///
    /// # Errors
    /// Shards that are missing, there twice, unfinished or of other work; as [`Work::carry_out`].
    pub fn results(
        &self,
        work: Work<'_>,
        shards: &[PathBuf],
        events: &dyn Events,
    ) -> Result<(Vec<Analysed>, Checkpoint), EngineError> {
        work.needs().with_rows_of(shards).require(self.result, events)?;
        let known = if shards.is_empty() { FinishedRows::default() } else { join(shards, &work)? };
        let mut checkpoint = Checkpoint::beside(self.result, self.name, &work, events);
        checkpoint.extend(known);
        checkpoint.path().into_iter().for_each(|path| events.resumes_from(path));
        let results = work.results(&checkpoint, events)?;
        checkpoint.release_rows();
        Ok((results, checkpoint))
    }

    /// Carries out one shard of `work` into a file beside the result.
    ///
    /// # Errors
    /// As [`Work::carry_out`]; a file that is a shard of other work, or that another job has.
    pub fn shard(&self, work: Work<'_>, shard: Shard, events: &dyn Events) -> Result<ShardReport, EngineError> {
        work.needs().for_shard(shard).require(self.result, events)?;
        run_shard(work, &self.shard_path(shard), shard, events)
    }
}
