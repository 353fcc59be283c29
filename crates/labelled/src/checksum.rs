//! Checksums: of every array in its attributes, and of the whole file behind its end.
//!
//! HDF5 reads a file by the addresses in it and does not look behind its last one, so a line there disturbs no reader,
//! and covers every byte before it.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use hdf5::types::VarLenUnicode;
use sha2::{Digest, Sha256};

/// Attribute of an array that holds its checksum.
pub(super) const CHECKSUM: &str = "sha256";

/// The line behind the end of a file, without the digits.
const BEFORE: &[u8] = b"\nuplift: SHA-256 of everything before this line: ";
const DIGITS: usize = 64;
const FOOTER: usize = BEFORE.len() + DIGITS + 1;

/// A value whose bytes enter a checksum.
pub(super) trait Hashed: Sized {
    fn enter(&self, hash: &mut Sha256);
}

macro_rules! hashed {
    ($($number:ty),+) => {
        $(impl Hashed for $number {
            fn enter(&self, hash: &mut Sha256) {
                hash.update(self.to_le_bytes());
            }
        })+
    };
}
hashed!(f64, f32, u32, u8, i64, u64);

impl Hashed for VarLenUnicode {
    fn enter(&self, hash: &mut Sha256) {
        self.as_str().to_owned().enter(hash);
    }
}

impl Hashed for String {
    fn enter(&self, hash: &mut Sha256) {
        hash.update(self.as_bytes());
        // no text holds it: the ends of texts count
        hash.update([0]);
    }
}

/// SHA-256 of values as little-endian bytes, of texts each with a null behind it, as hexadecimal digits.
pub(super) fn of_values<T: Hashed>(values: &[T]) -> String {
    let mut hash = Sha256::new();
    for value in values {
        value.enter(&mut hash);
    }
    hexadecimal(&hash.finalize())
}

/// Bytes as hexadecimal digits, two a byte, in lower case.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |text, byte| text + &format!("{byte:02x}"))
}

/// Takes the next `length` bytes, or all, into a checksum.
fn absorb(file: &File, length: u64, hash: &mut Sha256) -> io::Result<()> {
    let mut reader = file.take(length);
    let mut buffer = vec![0; 1 << 18];
    loop {
        match reader.read(&mut buffer)? {
            0 => return Ok(()),
            read => hash.update(&buffer[..read]),
        }
    }
}

/// Puts the checksum of the file behind its end.
pub(super) fn seal(file: &mut File) -> io::Result<()> {
    file.seek(SeekFrom::Start(0))?;
    let mut hash = Sha256::new();
    absorb(&*file, u64::MAX, &mut hash)?;
    file.seek(SeekFrom::End(0))?;
    file.write_all(&[BEFORE, hexadecimal(&hash.finalize()).as_bytes(), b"\n"].concat())
}

/// What the line behind the end of a file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Seal {
    /// Every byte is as it was written; the checksum.
    Whole(String),
    /// Some byte is not.
    Broken,
    /// There is no such line: another program wrote the file, or its end is missing.
    Missing,
}

/// Looks at the checksum behind the end of the file at `path`.
///
/// # Errors
/// A file that cannot be read.
pub fn seal_of(path: &Path) -> io::Result<Seal> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    let Some(content) = length.checked_sub(FOOTER as u64) else { return Ok(Seal::Missing) };
    let mut footer = vec![0; FOOTER];
    file.seek(SeekFrom::Start(content))?;
    file.read_exact(&mut footer)?;
    let Some(stored) = footer.strip_prefix(BEFORE).and_then(|rest| rest.strip_suffix(b"\n")) else {
        return Ok(Seal::Missing);
    };
    file.seek(SeekFrom::Start(0))?;
    let mut hash = Sha256::new();
    absorb(&file, content, &mut hash)?;
    let found = hexadecimal(&hash.finalize());
    Ok(if found.as_bytes() == stored { Seal::Whole(found) } else { Seal::Broken })
}
