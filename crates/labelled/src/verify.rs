//! Whether a file is what was written.

use std::path::Path;
use std::sync::mpsc;
use std::time::Duration;
use std::{fs, thread};

use uplift_atomic_file::{io_error, require_file};

use super::AXES;
use super::checksum::{CHECKSUM, sha256};
use super::copy::Kind;
use super::error::LabelledError;
use super::reader::{LabelledReader, unsealed};
use super::seal::{Seal, examine};

/// What was found of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Verdict {
    /// The checksum of all bytes.
    pub seal: Seal,
    /// Arrays and axes that are as they were written.
    pub sound: usize,
    /// Those that are not, each with the reason.
    pub damaged: Vec<String>,
    /// Those without a checksum.
    pub unknown: Vec<String>,
}

impl Verdict {
    /// Whether nothing is damaged.
    pub fn is_sound(&self) -> bool {
        self.damaged.is_empty() && self.seal == Seal::Whole
    }
}

/// Looks at every byte of the file at `path`, and, where these are as they were written, at every array in it.
///
/// Of a file that is damaged HDF5 sees nothing: it may never return from one.
///
/// # Errors
/// A file that cannot be opened, is no HDF5 file or is cut short.
pub fn verify(path: &Path) -> Result<Verdict, LabelledError> {
    let verdict = verify_bytes(path)?;
    if verdict.seal != Seal::Whole {
        return Ok(verdict);
    }
    let length = fs::metadata(path).map_err(io_error(path, "open the file"))?.len();
    read_within(path, verdict, LONGEST + length / BYTES_PER_SECOND)
}

/// As [`verify`], without a look into the arrays of a file whose bytes are as they were written.
///
/// # Errors
/// As [`verify`].
pub fn verify_bytes(path: &Path) -> Result<Verdict, LabelledError> {
    let metadata = fs::metadata(path).map_err(io_error(path, "open the file"))?;
    require_file(path, &metadata)?;
    let mut file = fs::File::open(path).map_err(io_error(path, "open the file"))?;
    let (seal, damaged) = examine(&mut file).map_err(io_error(path, "read the file"))?;
    match (seal, unsealed(path)) {
        (Seal::Whole | Seal::Broken, _) | (_, LabelledError::Unsealed { .. }) => {
            Ok(Verdict { seal, sound: 0, damaged, unknown: Vec::new() })
        }
        (Seal::Missing, other) => Err(other),
    }
}

/// Reads every array, and gives up after `seconds`: a file may bear a seal and yet be one that HDF5 cannot read.
fn read_within(path: &Path, verdict: Verdict, seconds: u64) -> Result<Verdict, LabelledError> {
    let (done, awaited) = mpsc::channel();
    let (path, mut found) = (path.to_owned(), verdict.clone());
    thread::spawn(move || {
        let read = LabelledReader::open(&path).map(|reader| {
            reader.verify_group("", &mut found);
            found
        });
        let _ = done.send(read);
    });
    awaited.recv_timeout(Duration::from_secs(seconds)).unwrap_or_else(|_| {
        Ok(Verdict { damaged: vec![format!("HDF5 has not read its arrays within {seconds} s")], ..verdict })
    })
}

/// Seconds that HDF5 may take with any file, and bytes for each that it may take besides.
const LONGEST: u64 = 60;
const BYTES_PER_SECOND: u64 = 4_000_000;

impl LabelledReader {
    /// Whether the array at `path` is as it was written; none where it has no checksum.
    ///
    /// # Errors
    /// An array that cannot be read.
    pub fn is_sound(&self, path: &str) -> Result<Option<bool>, LabelledError> {
        let Ok(stored) = self.attribute::<String>(path, CHECKSUM) else { return Ok(None) };
        Ok(Some(self.checksum(path)? == stored))
    }

    /// Refuses an array that is not as it was written; one without a checksum passes.
    ///
    /// # Errors
    /// [`LabelledError::Hdf5`] where the values are others.
    pub fn require_sound(&self, path: &str) -> Result<(), LabelledError> {
        if self.is_sound(path)? == Some(false) {
            return self.check(Err("the values have changed".into()), path);
        }
        Ok(())
    }

    /// Checksum of the values that an array has.
    pub(super) fn checksum(&self, path: &str) -> Result<String, LabelledError> {
        let dataset = self.dataset(path)?;
        Ok(match self.kind(path)? {
            Kind::Text => sha256(&self.texts(&dataset, path)?),
            Kind::F64 => sha256::<f64>(&self.values(&dataset, path)?),
            Kind::F32 => sha256::<f32>(&self.values(&dataset, path)?),
            Kind::U32 => sha256::<u32>(&self.values(&dataset, path)?),
            Kind::U8 => sha256::<u8>(&self.values(&dataset, path)?),
            Kind::I64 => sha256::<i64>(&self.values(&dataset, path)?),
            Kind::U64 => sha256::<u64>(&self.values(&dataset, path)?),
        })
    }

    fn verify_group(&self, group: &str, verdict: &mut Verdict) {
        let name = if group.is_empty() { "/" } else { group };
        let children = match self.children(name) {
            Ok(children) => children,
            Err(error) => {
                verdict.damaged.push(format!("{name}: {error}"));
                return;
            }
        };
        let mut all = children;
        if group.is_empty() && !all.iter().any(|child| format!("/{child}") == AXES) {
            all.extend(AXES.strip_prefix('/').map(str::to_owned));
        }
        for child in all {
            let path = format!("{group}/{child}");
            if self.is_group(&path) {
                self.verify_group(&path, verdict);
                continue;
            }
            match self.is_sound(&path) {
                Ok(Some(true)) => verdict.sound += 1,
                Ok(Some(false)) => verdict.damaged.push(format!("{path}: the values have changed")),
                Ok(None) => verdict.unknown.push(path),
                Err(error) => verdict.damaged.push(format!("{path}: {error}")),
            }
        }
    }
}
