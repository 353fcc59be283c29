//! Finished analysis rows in a file, appended as they come.
//!
//! The file is a line of JSON, then one block a row, little-endian: the key (16 bytes), the number of scale factors
//! (u32), the peak displacements in m (f64 each), the impacts (u32 each), and a CRC-32 of all that. A block that
//! was damaged is passed over, and one that was cut off ends what is read; when the file is gone on with they are gone.
//! Whatever stops the program, at most the rows in work are lost.

use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use uplift_atomic_file::{FileError, final_place, open_file, write_whole};
use uplift_ida::{AnalysisRow, Cells};

use super::error::{CheckpointError, FORMAT};
use super::key::{RowKey, RowKeys};
use crate::error::EngineError;

/// The format of version 0.1: its rows had other keys and are of no use, but nothing is wrong with such a file.
const FORMAT_BEFORE: &str = "uplift pieces 1";
/// How every first line begins.
const FIRST_WORDS: &[u8] = b"{\"format\":\"uplift ";
/// Longest first line, bytes.
const LONGEST_HEAD: u64 = 1 << 16;
/// How often what was appended is brought to the disk.
const SYNC_EVERY: Duration = Duration::from_secs(5);

/// The first line of a file of finished rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowFileHead {
    format: String,
    /// Hash of all keys of the whole work, in order.
    pub work: String,
    /// Title of the study.
    pub title: String,
    /// Which shard of the work, from 1; 1 of 1 is the checkpoint of a run.
    pub shard: u64,
    /// Of how many.
    pub shards: u64,
    /// Analyses of this shard, and how many of them make a peak.
    #[serde(default)]
    pub analyses: u64,
    #[serde(default)]
    analyses_a_peak: u64,
    /// Peaks of other work, which were carried over and are not counted.
    #[serde(default)]
    peaks_of_others: u64,
}

impl RowFileHead {
    /// The head of the file of one shard of a work.
    pub fn new(work: String, title: &str, [shard, shards]: [u64; 2], [analyses, a_peak]: [u64; 2]) -> Self {
        let (format, title) = (FORMAT.to_owned(), title.to_owned());
        Self { format, work, title, shard, shards, analyses, analyses_a_peak: a_peak, peaks_of_others: 0 }
    }

    /// Whether both describe the same shard of the same work; rows carried over do not count.
    fn is_of(&self, other: &Self) -> bool {
        Self { peaks_of_others: other.peaks_of_others, ..self.clone() } == *other
    }
}

/// Finished rows by their keys.
#[derive(Debug, Clone, Default)]
pub struct FinishedRows {
    rows: HashMap<RowKey, Row>,
}

impl FinishedRows {
    /// Puts into `cells` what is there of the rows with `keys`.
    pub fn fill(&self, keys: &RowKeys, cells: &mut Cells) {
        if self.rows.is_empty() {
            return;
        }
        for (row, key) in keys.as_slice().iter().enumerate() {
            if let Some((displacement_m, impacts)) = self.rows.get(key) {
                let (motion, system) = keys.axes().motion_and_system(row);
                // a row of another length is none of these, whatever its key says
                let _ = cells.set_row(&AnalysisRow { motion, system, displacement_m, impacts });
            }
        }
    }

    /// Whether the row is there.
    pub fn contains(&self, key: RowKey) -> bool {
        self.rows.contains_key(&key)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Number of peaks in the rows whose keys count.
    fn peaks(&self, is_counted: impl Fn(&RowKey) -> bool) -> u64 {
        let of_row = |(displacement_m, _): &Row| displacement_m.iter().filter(|peak_m| !peak_m.is_nan()).count() as u64;
        self.rows.iter().filter(|(key, _)| is_counted(key)).map(|(_, row)| of_row(row)).sum()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Adds the rows of `other`.
    pub fn extend(&mut self, other: Self) {
        self.rows.extend(other.rows);
    }
}

/// What a file of finished rows holds.
#[derive(Debug)]
pub struct Finding {
    /// Its first line.
    pub head: RowFileHead,
    /// The rows in it.
    pub rows: FinishedRows,
    /// Bytes of blocks that were cut off or damaged.
    pub damaged_bytes: u64,
}

impl Finding {
    /// Number of analyses that are finished. Rows of design examples may be among those found, which nobody counts
    /// before they are found.
    pub fn analyses(&self) -> u64 {
        let peaks = self.rows.peaks(|_| true).saturating_sub(self.head.peaks_of_others);
        (peaks * self.head.analyses_a_peak).min(self.head.analyses)
    }

    /// Whether it is of the work of `head`, and holds nothing else.
    pub(crate) fn is_all_of(&self, head: &RowFileHead) -> bool {
        self.head.peaks_of_others == 0 && self.head.is_of(head)
    }

    /// Whether all analyses are finished, and there are rows of other work too.
    pub fn is_finished_with_others(&self) -> bool {
        self.head.peaks_of_others > 0 && self.analyses() == self.head.analyses
    }
}

/// A file to which finished rows are appended.
#[derive(Debug)]
pub struct RowFile {
    path: PathBuf,
    file: Mutex<(File, Instant)>,
    /// Why nothing can be appended any more.
    failure: OnceLock<std::io::Error>,
    /// Whether it holds peaks of other work too.
    pub(super) has_others: bool,
}

/// The checkpoint of the result at `result`.
pub fn checkpoint_path(result: &Path) -> PathBuf {
    let result = &final_place(result).unwrap_or_else(|_| result.to_owned());
    let mut name = result.file_name().unwrap_or(result.as_os_str()).to_owned();
    name.push(".part");
    result.with_file_name(name)
}

impl RowFile {
    /// Reads the file at `path`; none if there is no such file.
    ///
    /// # Errors
    /// A file that cannot be read, or holds something else.
    pub fn read(path: &Path) -> Result<Option<Finding>, CheckpointError> {
        let fail = |source| CheckpointError::Read { path: path.to_owned(), source };
        let file = match open_file(path) {
            Ok(file) => file,
            Err(FileError::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(FileError::Io { source, .. }) => return Err(fail(source)),
            Err(_) => return Err(CheckpointError::NotRows { path: path.to_owned() }),
        };
        let length = file.metadata().map_err(fail)?.len();
        let mut reader = BufReader::with_capacity(1 << 20, file);
        let mut line = Vec::new();
        (&mut reader).take(LONGEST_HEAD).read_until(b'\n', &mut line).map_err(fail)?;
        let head: RowFileHead = serde_json::from_slice(&line)
            .ok()
            .filter(|head: &RowFileHead| [FORMAT, FORMAT_BEFORE].contains(&head.format.as_str()))
            .filter(|_| line.ends_with(b"\n"))
            .ok_or_else(|| CheckpointError::NotRows { path: path.to_owned() })?;
        let mut sound = line.len() as u64;
        let mut rows = FinishedRows::default();
        while let Some((block, size)) = read_block(&mut reader) {
            if let Some((key, row)) = block {
                rows.rows.insert(key, row);
                sound += size;
            }
        }
        Ok(Some(Finding { head, rows, damaged_bytes: length.saturating_sub(sound) }))
    }

    /// Opens the file at `path` to append to it, a new one with `head` unless a sound one of the same work is there;
    /// with what it holds. If it held other work, only rows with the `own` keys count as finished.
    ///
    /// # Errors
    /// A file that cannot be written, that holds something else, or that is a shard of other work: nothing else is
    /// overwritten.
    pub fn open(
        path: &Path,
        head: &RowFileHead,
        own: impl FnOnce() -> HashSet<RowKey>,
    ) -> Result<(Self, Finding), EngineError> {
        let fail = |source| CheckpointError::Write { path: path.to_owned(), source };
        // what cannot be read to its first line was cut off in it
        let found = match Self::read(path) {
            Err(_) if was_cut_off(path) => None,
            found => found?,
        };
        let found = match found {
            Some(found) if !found.head.is_of(head) && (found.head.shards > 1 || head.shards > 1) => {
                let RowFileHead { title, shard, shards, .. } = found.head;
                return Err(CheckpointError::OtherWork { path: path.to_owned(), shard, shards, title }.into());
            }
            // rows of the version before are none of any work
            Some(found) if found.head.format == FORMAT_BEFORE => None,
            found => found,
        };
        let same = found.as_ref().is_some_and(|found| found.damaged_bytes == 0 && found.head.is_of(head));
        let (rows, damaged_bytes, mut peaks_of_others) =
            found.map_or_else(Default::default, |found| (found.rows, found.damaged_bytes, found.head.peaks_of_others));
        if !same {
            // written again without what is damaged; rows of other work may be of use, and are carried over
            let own = if rows.is_empty() { HashSet::new() } else { own() };
            peaks_of_others = rows.peaks(|key| !own.contains(key));
            let head = RowFileHead { peaks_of_others, ..head.clone() };
            let mut content = serde_json::to_vec(&head).map_err(|error| fail(error.into()))?;
            content.push(b'\n');
            for (key, (displacement_m, impacts)) in &rows.rows {
                content.extend(write_block(*key, displacement_m, impacts));
            }
            write_whole(path, &content)?;
        }
        let file = File::options().append(true).open(path).map_err(fail)?;
        let file = Mutex::new((file, Instant::now()));
        let found = Finding { head: head.clone(), rows, damaged_bytes };
        let (path, failure, has_others) = (path.to_owned(), OnceLock::new(), peaks_of_others > 0);
        Ok((Self { path, file, failure, has_others }, found))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Appends a finished row. What goes wrong is told by [`RowFile::full`].
    pub fn append(&self, key: RowKey, row: &AnalysisRow<'_>) {
        if self.is_full() {
            return;
        }
        let block = write_block(key, row.displacement_m, row.impacts);
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let mut written = file.0.write_all(&block);
        if written.is_ok() && file.1.elapsed() >= SYNC_EVERY {
            file.1 = Instant::now();
            // the others go on while the disk works
            let copy = file.0.try_clone();
            drop(file);
            written = copy.and_then(|file| file.sync_data());
        }
        if let Err(error) = written {
            // of several threads the first says why
            let _ = self.failure.set(error);
        }
    }

    /// Whether nothing can be appended any more.
    pub(crate) fn is_full(&self) -> bool {
        self.failure.get().is_some()
    }

    /// Why nothing can be appended any more, if so.
    pub fn full(&self) -> Option<CheckpointError> {
        let failure = self.failure.get()?;
        let source = failure.raw_os_error().map_or_else(
            || std::io::Error::new(failure.kind(), failure.to_string()),
            std::io::Error::from_raw_os_error,
        );
        Some(CheckpointError::Full { path: self.path.clone(), source })
    }

    /// Brings everything to the disk.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn sync(&self) -> Result<(), CheckpointError> {
        let file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.0.sync_all().map_err(|source| CheckpointError::Write { path: self.path.clone(), source })
    }

    /// Takes the file away, once its rows are in a result.
    pub fn remove(self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Whether the file at `path` ends within its first line, as one that was being begun.
fn was_cut_off(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = open_file(path).is_ok_and(|file| file.take(LONGEST_HEAD).read_to_end(&mut head).is_ok());
    let begun = &head[..head.len().min(FIRST_WORDS.len())];
    read && head.len() as u64 != LONGEST_HEAD && !head.contains(&b'\n') && FIRST_WORDS.starts_with(begun)
}

#[cfg(test)]
mod tests;

/// Most scale factors of a row; more is not a row.
const MOST_SCALES: u32 = 100_000;

/// A finished row: displacements (m) and impacts over the scale factors.
pub(super) type Row = (Vec<f64>, Vec<u32>);

pub(super) fn write_block(key: RowKey, displacement_m: &[f64], impacts: &[u32]) -> Vec<u8> {
    let mut block = Vec::with_capacity(24 + 12 * displacement_m.len());
    block.extend(key.0);
    block.extend(u32::try_from(displacement_m.len()).unwrap_or(u32::MAX).to_le_bytes());
    block.extend(displacement_m.iter().flat_map(|value| value.to_le_bytes()));
    block.extend(impacts.iter().flat_map(|value| value.to_le_bytes()));
    block.extend(crc32fast::hash(&block).to_le_bytes());
    block
}

/// A block with its size in bytes, without a row if it is damaged; none at the end, and where a block was cut off.
pub(super) fn read_block(reader: &mut impl Read) -> Option<(Option<(RowKey, Row)>, u64)> {
    let mut head = [0; 20];
    reader.read_exact(&mut head).ok()?;
    let (key, count) = head.split_at(16);
    let count = u32::from_le_bytes(count.try_into().ok()?);
    if count > MOST_SCALES {
        return None;
    }
    let count = count as usize;
    let mut rest = vec![0; 12 * count + 4];
    reader.read_exact(&mut rest).ok()?;
    let size = (24 + 12 * count) as u64;
    let (content, sum) = rest.split_at(12 * count);
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&head);
    hasher.update(content);
    if hasher.finalize().to_le_bytes() != *sum {
        return Some((None, size));
    }
    let (displacement_m, impacts) = content.split_at(8 * count);
    let displacement_m =
        displacement_m.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap_or_default())).collect();
    let impacts =
        impacts.chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap_or_default())).collect();
    Some((Some((RowKey(key.try_into().ok()?), (displacement_m, impacts))), size))
}
