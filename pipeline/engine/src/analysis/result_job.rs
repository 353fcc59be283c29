//! Work that is asked of a finished result: its checkpoint lies beside that result, and so do its shards.

use std::path::{Path, PathBuf};

use uplift_atomic_file::final_place;
use uplift_ida::Shard;
use uplift_job::events::Events;
use uplift_job::lock::ResultLock;

use super::{Analysed, ShardReport, Work, join, run_shard, shard_ending};
use crate::checkpoint::{Checkpoint, FinishedRows};
use crate::error::EngineError;

/// The names of the files have the title of the work: command and structure.
impl Work<'_> {
    /// Carries out all that is asked of `result`, but for the rows in `shards`: the result of each plan, and the
    /// checkpoint, to be [removed](Checkpoint::remove) when the answer is given.
    ///
    /// # Errors
    /// Shards that are missing, there twice, unfinished or of other work; as [`Work::carry_out`].
    pub fn asked_of(
        self,
        result: &Path,
        shards: &[PathBuf],
        events: &dyn Events,
    ) -> Result<(Vec<Analysed>, Checkpoint), EngineError> {
        self.needs().with_rows_of(shards).require(result, events)?;
        let known = if shards.is_empty() { FinishedRows::default() } else { join(shards, &self)? };
        let mut checkpoint = self.checkpoint_beside(result, events);
        checkpoint.extend(known);
        checkpoint.path().into_iter().for_each(|path| events.resumes_from(path));
        let results = self.results(&checkpoint, events)?;
        checkpoint.release_rows();
        Ok((results, checkpoint))
    }

    /// The checkpoint beside `result`. Where no file can be written there, or another job has it, this one goes on
    /// without, and says so.
    fn checkpoint_beside(&self, result: &Path, events: &dyn Events) -> Checkpoint {
        let path = path_beside(result, &self.title, "part");
        let opened = ResultLock::acquire(&path)
            .map_err(EngineError::from)
            .and_then(|lock| Ok(self.open_checkpoint(&path, Shard::WHOLE)?.locked(lock)));
        opened.unwrap_or_else(|reason| {
            events.note(&format!("no checkpoint can be written ({reason}): an interrupted run starts again"));
            Checkpoint::none()
        })
    }

    /// Carries out one shard of what is asked of `result` into a file beside it.
    ///
    /// # Errors
    /// As [`Work::carry_out`]; a file that is a shard of other work, or that another job has.
    pub fn shard_beside(self, result: &Path, shard: Shard, events: &dyn Events) -> Result<ShardReport, EngineError> {
        self.needs().for_shard(shard).require(result, events)?;
        let path = path_beside(result, &self.title, &shard_ending(shard));
        run_shard(self, &path, shard, events)
    }
}

/// `europe.h5`, `design pier` and `part` make `europe.h5.design-pier.part`.
fn path_beside(result: &Path, name: &str, extension: &str) -> PathBuf {
    let result = &final_place(result).unwrap_or_else(|_| result.to_owned());
    let plain: String =
        name.chars().map(|letter| if letter.is_alphanumeric() || letter == '_' { letter } else { '-' }).collect();
    let mut file = result.file_name().unwrap_or(result.as_os_str()).to_owned();
    file.push(format!(".{plain}.{extension}"));
    result.with_file_name(file)
}
