//! The seal of a file: checksums behind its end, by which every byte is checked before HDF5 sees it.
//!
//! HDF5 reads a file by the addresses in it and does not look behind its last one, so lines there disturb no reader.
//! There are three:
//!
//! ```text
//! uplift: checksums of the parts: {"structure":"…","arrays":{"/urs/u_m":{"sha256":"…","extents":[[4096,262144]]}}}
//! uplift: SHA-256 of the 00000000000000000123 bytes before this line: …
//! uplift: SHA-256 of everything before this line: …
//! ```
//!
//! The first names the bytes of every array that lies in chunks; all other bytes are the structure: groups, attributes,
//! small arrays, texts. Opening a file reads the structure, and an array is checked when it is asked for: of a file of
//! gigabytes no more is read than is needed. The last line covers all of it; a file of an earlier version has this
//! line alone, and is read whole.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use uplift_atomic_file::is_still_at;

use crate::checksum::hexadecimal;

const INDEX: &[u8] = b"\nuplift: checksums of the parts: ";
const BEFORE_LENGTH: &[u8] = b"\nuplift: SHA-256 of the ";
const LENGTH_DIGITS: usize = 20;
const BEHIND_LENGTH: &[u8] = b" bytes before this line: ";
const BEFORE: &[u8] = b"\nuplift: SHA-256 of everything before this line: ";
const DIGITS: usize = 64;
const INDEX_LINE: usize = BEFORE_LENGTH.len() + LENGTH_DIGITS + BEHIND_LENGTH.len() + DIGITS;
const LAST_LINE: usize = BEFORE.len() + DIGITS + 1;
/// An index that claims more lies: this one would be of terabytes.
const LONGEST_INDEX: usize = 1 << 28;
/// Bytes that are read at a time.
const BUFFER: usize = 1 << 18;

/// What the lines behind the end of a file say of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seal {
    /// Every byte is as it was written.
    Whole,
    /// Some byte is not.
    Broken,
    /// There are no such lines: another program wrote the file, or its end is missing.
    Missing,
}

/// Bytes of a file that hold values of an array: from where, how many.
pub(super) type Extent = (u64, u64);

/// The checksum of a part, and where it lies.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Part {
    sha256: String,
    extents: Vec<Extent>,
}

/// The checksums of the parts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Index {
    structure: String,
    arrays: BTreeMap<String, Part>,
}

/// The lines behind the end of a file.
#[derive(Debug)]
struct Lines {
    /// Bytes of HDF5.
    content: u64,
    /// Bytes that the last line covers.
    covered: u64,
    /// What the last line says.
    whole: String,
    /// None in a file of an earlier version.
    index: Option<Index>,
    /// By what the content is known: the checksum of the index, else that of everything.
    identity: String,
}

/// A file whose structure is as it was written, and whose arrays are checked when they are asked for.
#[derive(Debug)]
pub(super) struct Sealed {
    identity: String,
    /// None where everything was checked when it was opened.
    index: Option<Index>,
    looked_at: Mutex<LookedAt>,
}

/// A file, and what of it was checked already.
#[derive(Debug)]
struct LookedAt {
    file: File,
    sound: BTreeSet<String>,
}

/// What was found of a file.
#[derive(Debug)]
pub(super) enum Opened {
    Sealed(Sealed),
    Broken,
    Missing,
}

impl Sealed {
    /// Looks at the seal of `file`, and at all bytes but those of the arrays in chunks.
    pub(super) fn open(mut file: File) -> io::Result<Opened> {
        let Some(lines) = Lines::read(&mut file)? else { return Ok(Opened::Missing) };
        let sound = match &lines.index {
            Some(index) => index.structure_is_sound(&mut file, lines.content)?,
            None => sha256_of_extents(&mut file, &[(0, lines.covered)])? == lines.whole,
        };
        if !sound {
            return Ok(Opened::Broken);
        }
        Ok(Opened::Sealed(Self {
            identity: lines.identity,
            index: lines.index,
            looked_at: Mutex::new(LookedAt { file, sound: BTreeSet::new() }),
        }))
    }

    /// Whether the file that was looked at is the one under its name.
    pub(super) fn is_still_at(&self, path: &Path) -> bool {
        is_still_at(&self.looked_at().file, path)
    }

    /// By what the content of the file is known: two files with the same are equal.
    pub(super) fn identity(&self) -> &str {
        &self.identity
    }

    /// Whether the bytes of the array at `path` are as they were written. What is in `chunks` must have a checksum of
    /// its own; what is not belongs to the structure.
    pub(super) fn is_sound(&self, path: &str, chunks: bool) -> io::Result<bool> {
        let Some(index) = &self.index else { return Ok(true) };
        let Some(part) = index.arrays.get(path) else { return Ok(!chunks) };
        let mut looked_at = self.looked_at();
        if !looked_at.sound.contains(path) {
            if sha256_of_extents(&mut looked_at.file, &part.extents)? != part.sha256 {
                return Ok(false);
            }
            looked_at.sound.insert(path.to_owned());
        }
        Ok(true)
    }

    fn looked_at(&self) -> MutexGuard<'_, LookedAt> {
        self.looked_at.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Looks at every byte of `file`: the seal, and which parts are not as they were written, as far as the file tells.
pub(super) fn examine(file: &mut File) -> io::Result<(Seal, Vec<String>)> {
    let Some(lines) = Lines::read(file)? else { return Ok((Seal::Missing, Vec::new())) };
    if sha256_of_extents(file, &[(0, lines.covered)])? == lines.whole {
        return Ok((Seal::Whole, Vec::new()));
    }
    let mut damaged = Vec::new();
    if let Some(index) = &lines.index {
        for (path, part) in &index.arrays {
            if sha256_of_extents(file, &part.extents)? != part.sha256 {
                damaged.push(format!("{path}: the values have changed"));
            }
        }
        if !index.structure_is_sound(file, lines.content)? {
            damaged.push("groups, attributes or small arrays have changed".to_owned());
        }
    }
    Ok((Seal::Broken, damaged))
}

/// Puts the seal behind the end of a file whose `arrays` in chunks lie where their extents say.
pub(super) fn seal(file: &mut File, arrays: BTreeMap<String, Vec<Extent>>) -> io::Result<()> {
    let content = file.seek(SeekFrom::End(0))?;
    let mut parts = BTreeMap::new();
    for (path, extents) in arrays {
        let extents = joined(extents);
        parts.insert(path, Part { sha256: sha256_of_extents(file, &extents)?, extents });
    }
    let mut index = Index { structure: String::new(), arrays: parts };
    let structure =
        index.structure(content).ok_or_else(|| io::Error::other("two arrays lie in the same bytes of the file"))?;
    index.structure = sha256_of_extents(file, &structure)?;

    let text = [INDEX, serde_json::to_string(&index)?.as_bytes()].concat();
    let length = format!("{:0LENGTH_DIGITS$}", text.len());
    let digest = hexadecimal(&Sha256::digest(&text));
    let line = [BEFORE_LENGTH, length.as_bytes(), BEHIND_LENGTH, digest.as_bytes()];
    file.seek(SeekFrom::Start(content))?;
    file.write_all(&text)?;
    file.write_all(&line.concat())?;
    let covered = file.stream_position()?;
    let whole = sha256_of_extents(file, &[(0, covered)])?;
    file.seek(SeekFrom::Start(covered))?;
    file.write_all(&[BEFORE, whole.as_bytes(), b"\n"].concat())
}

impl Lines {
    /// Reads them; none where they are not there, or not as this program writes them.
    fn read(file: &mut File) -> io::Result<Option<Self>> {
        let length = file.metadata()?.len();
        let Some(covered) = length.checked_sub(LAST_LINE as u64) else { return Ok(None) };
        let last = bytes_at(file, covered, LAST_LINE)?;
        let Some(whole) = last.strip_prefix(BEFORE).and_then(|rest| rest.strip_suffix(b"\n")) else { return Ok(None) };
        let whole = String::from_utf8_lossy(whole).into_owned();
        let plain = Self { content: covered, covered, identity: whole.clone(), whole, index: None };
        let Some(behind_index) = covered.checked_sub(INDEX_LINE as u64) else { return Ok(Some(plain)) };
        let line = bytes_at(file, behind_index, INDEX_LINE)?;
        let Some((length, digest)) = length_and_digest(&line) else { return Ok(Some(plain)) };
        // a damaged length or index is found by the last line, as that of a file without one
        let Some(content) = behind_index.checked_sub(length) else { return Ok(Some(plain)) };
        let length = usize::try_from(length).unwrap_or(usize::MAX);
        if length > LONGEST_INDEX {
            return Ok(Some(plain));
        }
        let text = bytes_at(file, content, length)?;
        let index = text.strip_prefix(INDEX).and_then(|json| serde_json::from_slice(json).ok());
        if index.is_none() || hexadecimal(&Sha256::digest(&text)) != digest {
            return Ok(Some(plain));
        }
        Ok(Some(Self { content, index, identity: digest, ..plain }))
    }
}

fn length_and_digest(line: &[u8]) -> Option<(u64, String)> {
    let (length, rest) = line.strip_prefix(BEFORE_LENGTH)?.split_at_checked(LENGTH_DIGITS)?;
    let digest = String::from_utf8(rest.strip_prefix(BEHIND_LENGTH)?.to_vec()).ok()?;
    Some((std::str::from_utf8(length).ok()?.parse().ok()?, digest))
}

impl Index {
    /// The bytes of `content` that are of no array; none where arrays overlap or lie outside.
    fn structure(&self, content: u64) -> Option<Vec<Extent>> {
        let mut taken: Vec<Extent> = self.arrays.values().flat_map(|part| part.extents.iter().copied()).collect();
        taken.sort_unstable();
        taken.push((content, 0));
        let (mut free, mut end) = (Vec::new(), 0);
        for (start, length) in taken {
            let between = start.checked_sub(end)?;
            free.push((end, between));
            end = start.checked_add(length)?;
        }
        (end == content).then_some(free)
    }

    fn structure_is_sound(&self, file: &mut File, content: u64) -> io::Result<bool> {
        let Some(structure) = self.structure(content) else { return Ok(false) };
        Ok(sha256_of_extents(file, &structure)? == self.structure)
    }
}

/// Extents in the order of the file, neighbours joined.
fn joined(mut extents: Vec<Extent>) -> Vec<Extent> {
    extents.sort_unstable();
    let mut joined: Vec<Extent> = Vec::new();
    for (start, length) in extents {
        match joined.last_mut() {
            Some(last) if last.0 + last.1 == start => last.1 += length,
            _ => joined.push((start, length)),
        }
    }
    joined
}

fn bytes_at(file: &mut File, start: u64, length: usize) -> io::Result<Vec<u8>> {
    file.seek(SeekFrom::Start(start))?;
    let mut bytes = vec![0; length];
    file.read_exact(&mut bytes)?;
    Ok(bytes)
}

/// SHA-256 of the bytes in `extents`, one after the other, as hexadecimal digits. What is beyond the end of the file
/// does not enter.
fn sha256_of_extents(file: &mut File, extents: &[Extent]) -> io::Result<String> {
    let mut hash = Sha256::new();
    let mut buffer = vec![0; BUFFER];
    for &(start, length) in extents {
        file.seek(SeekFrom::Start(start))?;
        let mut reader = Read::by_ref(file).take(length);
        loop {
            match reader.read(&mut buffer)? {
                0 => break,
                read => hash.update(&buffer[..read]),
            }
        }
    }
    Ok(hexadecimal(&hash.finalize()))
}

#[cfg(test)]
mod tests;
