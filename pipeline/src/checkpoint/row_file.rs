//! Finished pieces in a file, appended as they come.
//!
//! The file is a line of JSON, then one block a piece, little-endian: the key (16 bytes), the number of levels (u32), the peak displacements
//! in m (f64 each), the impacts (u32 each), and a CRC-32 of all that. A block that was damaged is passed over, and one that was cut off ends
//! what is read; when the file is gone on with they are gone. Whatever stops the program, at most the pieces in work are lost.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use uplift_ida::{Cells, Piece};

use super::key::{PieceKey, StripeKeys};
use crate::error::UpliftError;
use uplift_atomic_file::{final_place, write_whole};

/// What the first line says it is.
const FORMAT: &str = "uplift pieces 1";
/// Longest first line, bytes.
const LONGEST_HEAD: u64 = 1 << 16;
/// Most levels of a block; more is no block.
const MOST_LEVELS: u32 = 100_000;
/// How often what was appended is brought to the disk.
const SYNC_EVERY: Duration = Duration::from_secs(5);

/// The first line of a file of pieces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PieceFileHead {
    /// Format with its version.
    format: String,
    /// Hash of all keys of the whole work, in order.
    pub work: String,
    /// Title of the study.
    pub title: String,
    /// Which part of the work, from 1; 1 of 1 is the journal of a run.
    pub shard: u64,
    /// Of how many.
    pub shards: u64,
    /// Pieces of this part.
    pub pieces: u64,
}

impl PieceFileHead {
    /// The head of the file of one part of a work.
    pub fn new(work: String, title: &str, [shard, shards]: [u64; 2], pieces: u64) -> Self {
        Self { format: FORMAT.to_owned(), work, title: title.to_owned(), shard, shards, pieces }
    }
}

/// A finished piece: displacements (m) and impacts over the levels.
type Row = (Vec<f64>, Vec<u32>);

/// Pieces read from a file.
#[derive(Debug, Clone, Default)]
pub struct KeptPieces {
    rows: HashMap<PieceKey, Row>,
}

impl KeptPieces {
    /// Puts into `cells` what is there of the pieces with `keys`.
    pub fn fill(&self, keys: &StripeKeys, cells: &mut Cells) {
        for (record, strength, key) in keys.iter() {
            // a row of another length is none of these, whatever its key says
            let row = self.rows.get(&key).filter(|(edp_m, _)| edp_m.len() == cells.levels());
            if let Some((edp_m, impacts)) = row {
                for (level, (&edp_m, &impacts)) in edp_m.iter().zip(impacts).enumerate() {
                    cells.set([record, strength, level], edp_m, impacts);
                }
            }
        }
    }

    /// Whether the piece is there.
    pub fn contains(&self, key: PieceKey) -> bool {
        self.rows.contains_key(&key)
    }

    /// Number of pieces.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Adds the pieces of `other`.
    pub fn extend(&mut self, other: Self) {
        self.rows.extend(other.rows);
    }
}

/// What a file of pieces holds.
#[derive(Debug)]
pub struct Finding {
    /// Its first line.
    pub head: PieceFileHead,
    /// The pieces in it.
    pub kept: KeptPieces,
    /// Bytes of blocks that were cut off or damaged.
    pub damaged_bytes: u64,
}

/// A file to which pieces are appended.
#[derive(Debug)]
pub struct PieceFile {
    path: PathBuf,
    file: Mutex<(File, Instant)>,
    /// Why nothing can be appended any more.
    failure: Mutex<Option<String>>,
    failed: AtomicBool,
}

/// The journal of the result at `result`.
pub fn journal_path(result: &Path) -> PathBuf {
    let result = &final_place(result).unwrap_or_else(|_| result.to_owned());
    let mut name = result.file_name().unwrap_or(result.as_os_str()).to_owned();
    name.push(".part");
    result.with_file_name(name)
}

impl PieceFile {
    /// Reads the file at `path`; none if there is no such file.
    ///
    /// # Errors
    /// A file that cannot be read, or is none of pieces.
    pub fn read(path: &Path) -> Result<Option<Finding>, UpliftError> {
        let fail = |reason: String| UpliftError::input(format!("{}: {reason}", path.display()));
        let file = match File::open(path) {
            Ok(file) => file,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(fail(error.to_string())),
        };
        let length = file.metadata().map_err(|error| fail(error.to_string()))?.len();
        let mut reader = BufReader::with_capacity(1 << 20, file);
        let mut line = Vec::new();
        (&mut reader).take(LONGEST_HEAD).read_until(b'\n', &mut line).map_err(|error| fail(error.to_string()))?;
        let head: PieceFileHead = serde_json::from_slice(&line)
            .ok()
            .filter(|head: &PieceFileHead| head.format == FORMAT && line.ends_with(b"\n"))
            .ok_or_else(|| fail(format!("is no file of finished pieces of this version ({FORMAT})")))?;
        let mut sound = line.len() as u64;
        let mut kept = KeptPieces::default();
        while let Some((block, size)) = read_block(&mut reader) {
            if let Some((key, row)) = block {
                kept.rows.insert(key, row);
                sound += size;
            }
        }
        Ok(Some(Finding { head, kept, damaged_bytes: length.saturating_sub(sound) }))
    }

    /// Opens the file at `path` to append to it, a new one with `head` unless a sound one of the same part is there; with what it holds.
    ///
    /// # Errors
    /// A file that cannot be written, that is none of pieces, or that is a shard of other work: nothing else is overwritten.
    pub fn open(path: &Path, head: &PieceFileHead) -> Result<(Self, Finding), UpliftError> {
        let fail = |error: std::io::Error| UpliftError::input(format!("{} cannot be written: {error}", path.display()));
        // what cannot be read to its first line was cut off in it
        let found = match Self::read(path) {
            Err(_) if std::fs::metadata(path).is_ok_and(|file| file.len() < LONGEST_HEAD && !has_line(path)) => None,
            found => found?,
        };
        let found = match found {
            Some(found) if found.head != *head && (found.head.shards > 1 || head.shards > 1) => {
                return Err(UpliftError::input(format!(
                    "{}: is there already, as shard {} of {} of other work ({:?}): remove it, or give another name (-o)",
                    path.display(),
                    found.head.shard,
                    found.head.shards,
                    found.head.title
                )));
            }
            found => found,
        };
        let (kept, damaged_bytes, same) = found.map_or((KeptPieces::default(), 0, false), |found| {
            (found.kept, found.damaged_bytes, found.damaged_bytes == 0 && found.head == *head)
        });
        if !same {
            // written anew without what is damaged; pieces of other work may be of use, and are carried over
            let mut content = serde_json::to_vec(head).map_err(|error| fail(error.into()))?;
            content.push(b'\n');
            for (key, (edp_m, impacts)) in &kept.rows {
                content.extend(block(*key, edp_m, impacts));
            }
            write_whole(path, &content)?;
        }
        let file = File::options().append(true).open(path).map_err(fail)?;
        let found = Finding { head: head.clone(), kept, damaged_bytes };
        let file = Mutex::new((file, Instant::now()));
        Ok((Self { path: path.to_owned(), file, failure: Mutex::new(None), failed: AtomicBool::new(false) }, found))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Appends a finished piece. What goes wrong is told by [`PieceFile::failure`].
    pub fn append(&self, key: PieceKey, piece: &Piece<'_>) {
        if self.failed.load(Ordering::Relaxed) {
            return;
        }
        let block = block(key, piece.edp_m, piece.impacts);
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
            *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error.to_string());
            self.failed.store(true, Ordering::Relaxed);
        }
    }

    /// Why nothing can be appended any more, if so.
    pub fn failure(&self) -> Option<String> {
        if !self.failed.load(Ordering::Relaxed) {
            return None;
        }
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Brings everything to the disk.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn sync(&self) -> Result<(), UpliftError> {
        let file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.0.sync_all().map_err(|error| UpliftError::input(format!("{}: {error}", self.path.display())))
    }

    /// Takes the file away, once its pieces are in a result.
    pub fn remove(self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

fn has_line(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LONGEST_HEAD).read_to_end(&mut head));
    read.is_err() || head.contains(&b'\n')
}

fn block(key: PieceKey, edp_m: &[f64], impacts: &[u32]) -> Vec<u8> {
    let mut block = Vec::with_capacity(24 + 12 * edp_m.len());
    block.extend(key.0);
    block.extend(u32::try_from(edp_m.len()).unwrap_or(u32::MAX).to_le_bytes());
    block.extend(edp_m.iter().flat_map(|value| value.to_le_bytes()));
    block.extend(impacts.iter().flat_map(|value| value.to_le_bytes()));
    block.extend(crc32fast::hash(&block).to_le_bytes());
    block
}

/// A block with its size in bytes, no piece for one that is damaged; none at the end, and where a block was cut off.
fn read_block(reader: &mut impl Read) -> Option<(Option<(PieceKey, Row)>, u64)> {
    let mut head = [0; 20];
    reader.read_exact(&mut head).ok()?;
    let (key, count) = head.split_at(16);
    let count = u32::from_le_bytes(count.try_into().ok()?);
    if count > MOST_LEVELS {
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
    let (edp_m, impacts) = content.split_at(8 * count);
    let edp_m = edp_m.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap_or_default())).collect();
    let impacts =
        impacts.chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap_or_default())).collect();
    Some((Some((PieceKey(key.try_into().ok()?), (edp_m, impacts))), size))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn head() -> PieceFileHead {
        PieceFileHead::new("work".into(), "a title", [1, 1], 3)
    }

    fn with_three(path: &Path) -> Vec<u8> {
        let (file, kept) = PieceFile::open(path, &head()).unwrap();
        assert!(kept.kept.is_empty());
        for key in 0..3_u8 {
            let edp_m = [f64::from(key), f64::INFINITY];
            file.append(PieceKey([key; 16]), &Piece { record: 0, strength: 0, edp_m: &edp_m, impacts: &[7, 8] });
        }
        assert_eq!(file.failure(), None);
        std::fs::read(path).unwrap()
    }

    // Cut anywhere, the file is gone on with from the last whole piece.
    #[test]
    fn cut_at_every_byte() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.part");
        let whole = with_three(&path);
        let block = 24 + 24;
        let first = whole.len() - 3 * block;
        for length in 0..=whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap();
            let (file, kept) = PieceFile::open(&path, &head()).unwrap();
            let sound = length.saturating_sub(first) / block;
            assert_eq!(kept.kept.len(), sound, "{length}");
            let piece = Piece { record: 0, strength: 0, edp_m: &[9.0, 9.5], impacts: &[1, 2] };
            file.append(PieceKey([9; 16]), &piece);
            drop(file);
            let found = PieceFile::read(&path).unwrap().unwrap();
            assert_eq!((found.kept.len(), found.damaged_bytes), (sound + 1, 0), "{length}");
            assert_eq!(found.kept.rows[&PieceKey([9; 16])], (vec![9.0, 9.5], vec![1, 2]));
        }
    }

    // A flipped byte costs one piece, or those behind it where it is the length that is wrong; and what is gone on with is sound.
    #[test]
    fn a_flipped_byte_costs_its_piece() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.part");
        let whole = with_three(&path);
        let first = whole.len() - 3 * 48;
        for index in first..whole.len() {
            let mut damaged = whole.clone();
            damaged[index] ^= 0x10;
            std::fs::write(&path, &damaged).unwrap();
            let found = PieceFile::read(&path).unwrap().unwrap();
            let in_the_length = (16..20).contains(&((index - first) % 48));
            assert!(found.kept.len() == 2 || (in_the_length && found.kept.len() < 3), "{index}: {}", found.kept.len());
            assert!(found.damaged_bytes > 0);
            for (key, row) in &found.kept.rows {
                assert_eq!(*row, (vec![f64::from(key.0[0]), f64::INFINITY], vec![7, 8]), "{index}");
            }
            let (_, opened) = PieceFile::open(&path, &head()).unwrap();
            assert_eq!(opened.kept.len(), found.kept.len());
            let again = PieceFile::read(&path).unwrap().unwrap();
            assert_eq!((again.kept.len(), again.damaged_bytes), (found.kept.len(), 0));
        }
    }

    #[test]
    fn nothing_else_is_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.part");
        std::fs::write(&path, "my notes\nof the day\n").unwrap();
        assert!(PieceFile::open(&path, &head()).is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "my notes\nof the day\n");
        assert!(PieceFile::read(&folder.path().join("absent")).unwrap().is_none());
    }

    #[test]
    fn pieces_of_other_work_are_carried_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.part");
        with_three(&path);
        let other = PieceFileHead { work: "other".into(), ..head() };
        let (file, kept) = PieceFile::open(&path, &other).unwrap();
        assert_eq!(kept.kept.len(), 3);
        drop(file);
        let found = PieceFile::read(&path).unwrap().unwrap();
        assert_eq!((found.head, found.kept.len()), (other, 3));
        // but no shard is taken for one of other work
        let shard = PieceFileHead::new("third".into(), "", [1, 2], 3);
        assert!(PieceFile::open(&path, &shard).unwrap_err().to_string().contains("other work"));
    }
}
