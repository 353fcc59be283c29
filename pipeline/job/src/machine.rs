//! What a job needs of the machine, and what the machine has: what cannot fit is refused before anything is computed.
//!
//! | module | what is in it |
//! |---|---|
//! | `memory` | memory: of the machine, of control groups, of the limits of the process |
//! | `control_group` | the control groups of Linux, both versions |
//! | `process_limits` | the limits of this process, as `ulimit` sets them |
//! | `disk` | free space and the largest file that may be written |
//!
//! What a system does not tell is unknown, and nothing is refused for it.

#[cfg(target_os = "linux")]
mod control_group;
mod disk;
mod memory;
mod process_limits;

use std::path::Path;

use serde::Serialize;
use uplift_ida::Shard;

pub use disk::{Disk, disk};
pub use memory::{Memory, memory};

use crate::error::JobError;
use crate::events::Events;
use crate::text::{bytes, bytes_free};

/// The variable of the environment that says what becomes of a job that cannot fit: `refuse`, as without it, or `warn`.
pub const LIMITS_VARIABLE: &str = "UPLIFT_LIMITS";

/// An amount that there is, and of what.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Limit {
    /// The amount, bytes.
    pub bytes: u64,
    /// Of what, in words.
    pub of: String,
}

impl Limit {
    pub(crate) fn new(bytes: u64, of: impl Into<String>) -> Self {
        Self { bytes, of: of.into() }
    }

    /// The smallest of several.
    pub(crate) fn least(limits: impl IntoIterator<Item = Self>) -> Option<Self> {
        limits.into_iter().min_by_key(|limit| limit.bytes)
    }
}

/// What a job takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Memory at its height, bytes.
    pub memory_bytes: u64,
    /// Disk, bytes, at most: the result before it is compressed, with the checkpoint beside it.
    pub disk_bytes: u64,
    /// Disk, bytes, at least: the checkpoint, which is not compressed.
    pub disk_least_bytes: u64,
}

/// What a job needs beside what there is.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Room {
    /// Memory that there is at most; none where it is unknown.
    pub memory_most: Option<Limit>,
    /// Memory that is free now; none where it is unknown.
    pub memory_available: Option<Limit>,
    /// Disk that is free at the place of the files; none where it is unknown.
    pub disk_free: Option<Limit>,
    /// Why the job cannot fit; empty where it can.
    pub cannot: Vec<String>,
    /// What will be tight.
    pub tight: Vec<String>,
}

/// Memory of the program itself, its libraries and its threads, bytes.
pub const PROGRAM_BYTES: u64 = 45_000_000;

impl Needs {
    /// Those of one shard: its rows are a part, in memory it has room for all of them.
    #[must_use]
    pub fn for_shard(self, shard: Shard) -> Self {
        let rows = self.disk_least_bytes / shard.count.max(1);
        Self { disk_bytes: rows.saturating_add(1_000_000), disk_least_bytes: rows, ..self }
    }

    /// The same with the rows of the analysis in `files` read into memory, which the disk has already.
    #[must_use]
    pub fn with_rows_of(self, files: &[impl AsRef<Path>]) -> Self {
        let size = |file: &Path| std::fs::metadata(file).map_or(0, |data| data.len());
        let rows: u64 = files.iter().map(|file| size(file.as_ref())).sum();
        Self {
            memory_bytes: self.memory_bytes.saturating_add(rows),
            disk_bytes: self.disk_bytes.saturating_sub(rows),
            disk_least_bytes: self.disk_least_bytes.saturating_sub(rows),
        }
    }

    /// These beside what the machine has; files are written beside `file`.
    pub fn room(&self, file: &Path) -> Room {
        self.within(&memory(), &disk(file))
    }

    fn within(&self, memory: &Memory, disk: &Disk) -> Room {
        let mut room = Room {
            memory_most: memory.most.clone(),
            memory_available: memory.available.clone(),
            disk_free: disk.free.clone(),
            ..Room::default()
        };
        let needed = bytes(self.memory_bytes);
        match (&memory.most, &memory.available) {
            (Some(most), _) if self.memory_bytes > most.bytes => room.cannot.push(format!(
                "about {needed} of memory are needed, and there are {} ({}): reduce strengths, levels, thresholds, \
                 sites, records or replicates, leave large arrays out (`risk.maf_surface = false`), or use a larger \
                 machine",
                bytes_free(most.bytes),
                most.of
            )),
            (_, Some(available)) if self.memory_bytes > available.bytes => room.tight.push(format!(
                "about {needed} of memory are needed, and {} are free now ({}): it may become slow, or be ended by \
                 the system",
                bytes_free(available.bytes),
                available.of
            )),
            _ => {}
        }
        for limit in disk.free.iter().chain(&disk.largest_file) {
            let [least, most] = [self.disk_least_bytes, self.disk_bytes].map(bytes);
            if self.disk_least_bytes > limit.bytes {
                room.cannot.push(format!(
                    "{least} to {most} of disk are needed, and {} are free ({}): free some, write elsewhere with \
                     `-o`, or reduce the study",
                    bytes_free(limit.bytes),
                    limit.of
                ));
            } else if self.disk_bytes > limit.bytes {
                room.tight.push(format!(
                    "up to {most} of disk are needed, and there are {} ({}): it may suffice, since results are \
                     compressed",
                    bytes_free(limit.bytes),
                    limit.of
                ));
            }
        }
        room
    }

    /// Refuses a job that cannot fit, and notes what will be tight.
    ///
    /// # Errors
    /// [`JobError::Room`] where it cannot fit, unless [`LIMITS_VARIABLE`] says `warn`; another word in it.
    pub fn require(&self, file: &Path, events: &dyn Events) -> Result<(), JobError> {
        let room = self.room(file);
        room.tight.iter().for_each(|note| events.note(note));
        room.refuse(events)
    }
}

/// Refuses what the system gives no memory for: asked for it, it says so, where a job would be ended.
///
/// # Errors
/// [`JobError::Room`], unless [`LIMITS_VARIABLE`] says `warn`; another word in it.
pub fn require_memory(memory_bytes: u64, what: &str) -> Result<(), JobError> {
    let is_given = usize::try_from(memory_bytes).is_ok_and(|size| Vec::<u8>::new().try_reserve_exact(size).is_ok());
    let fits = is_given && memory().most.is_none_or(|most| memory_bytes <= most.bytes);
    if fits || only_warns()? {
        return Ok(());
    }
    let needed = bytes(memory_bytes);
    Err(JobError::Room(vec![format!(
        "{needed} of memory are needed for {what}: raise the limit (`ulimit -v`), or give less"
    )]))
}

impl Room {
    /// Refuses what cannot fit.
    ///
    /// # Errors
    /// [`JobError::Room`], unless [`LIMITS_VARIABLE`] says `warn`; another word in it.
    pub fn refuse(&self, events: &dyn Events) -> Result<(), JobError> {
        let warn = only_warns()?;
        if self.cannot.is_empty() {
            return Ok(());
        }
        if !warn {
            return Err(JobError::Room(self.cannot.clone()));
        }
        self.cannot.iter().for_each(|note| events.note(note));
        Ok(())
    }
}

/// Whether a job that cannot fit is carried out nonetheless.
fn only_warns() -> Result<bool, JobError> {
    match std::env::var_os(LIMITS_VARIABLE).as_ref().map(|word| word.to_string_lossy()).as_deref() {
        None | Some("refuse") => Ok(false),
        Some("warn") => Ok(true),
        Some(other) => Err(JobError::Usage(format!("{LIMITS_VARIABLE} is \"{other}\": it is \"refuse\" or \"warn\""))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GB: u64 = 1_000_000_000;

    fn room(memory_bytes: u64, disk_bytes: u64) -> Room {
        let memory =
            Memory { most: Some(Limit::new(8 * GB, "the machine")), available: Some(Limit::new(2 * GB, "free")) };
        let disk = Disk { free: Some(Limit::new(GB, "the disk")), largest_file: None };
        Needs { memory_bytes, disk_bytes, disk_least_bytes: disk_bytes / 4 }.within(&memory, &disk)
    }

    #[test]
    fn a_job_that_cannot_fit_differs_from_a_tight_one() {
        let fits = room(GB, GB);
        assert!(fits.cannot.is_empty() && fits.tight.is_empty(), "{fits:?}");
        let tight = room(3 * GB, 2 * GB);
        assert!(tight.cannot.is_empty() && tight.tight.len() == 2, "{tight:?}");
        assert!(tight.tight[0].contains("3.0 GB") && tight.tight[0].contains("2.0 GB"), "{tight:?}");
        let cannot = room(9 * GB, 9 * GB);
        assert!(cannot.cannot.len() == 2 && cannot.tight.is_empty(), "{cannot:?}");
        assert!(cannot.cannot[0].contains("8.0 GB (the machine)"), "{cannot:?}");
    }

    #[test]
    fn rows_that_are_there_are_needed_no_more() {
        let folder = tempfile::tempdir().unwrap();
        let rows = folder.path().join("r.h5.part");
        std::fs::write(&rows, [0; 700]).unwrap();
        let needs = Needs { memory_bytes: 0, disk_bytes: 2000, disk_least_bytes: 1000 }.with_rows_of(&[rows]);
        assert_eq!(needs, Needs { memory_bytes: 700, disk_bytes: 1300, disk_least_bytes: 300 });
    }

    #[test]
    fn what_is_unknown_refuses_nothing() {
        let needs = Needs { memory_bytes: u64::MAX, disk_bytes: u64::MAX, disk_least_bytes: u64::MAX };
        let room = needs.within(&Memory::default(), &Disk::default());
        assert!(room.cannot.is_empty() && room.tight.is_empty());
    }
}
