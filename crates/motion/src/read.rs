//! Readers of record files: what is given from outside, and which reader it goes to.

pub(crate) mod at2;
pub(crate) mod columns;
mod number;

use std::borrow::Cow;
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::unit::{AccelerationUnit, STANDARD_GRAVITY_M_S2};

/// Largest file that is read \[bytes\]: a few million points, far above any accelerogram.
const LARGEST_FILE_BYTES: u64 = 64 * 1024 * 1024;

/// What the caller knows about a file; what the file itself says takes precedence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadOptions {
    /// Time step \[s\] of a file of one column.
    pub dt_s: Option<f64>,
    /// Unit of accelerations whose unit the file does not say.
    pub unit: Option<AccelerationUnit>,
    /// Acceleration of gravity \[m/s²\] by which values in g are converted.
    pub gravity_m_s2: f64,
}

/// Neither time step nor unit, and standard gravity.
impl Default for ReadOptions {
    fn default() -> Self {
        Self { dt_s: None, unit: None, gravity_m_s2: STANDARD_GRAVITY_M_S2 }
    }
}

impl ReadOptions {
    /// The accelerogram of `values` in `unit`; `name` is the file.
    fn accelerogram(
        &self,
        name: &str,
        dt_s: f64,
        unit: AccelerationUnit,
        values: Vec<f64>,
    ) -> Result<Accelerogram, MotionError> {
        let gravity_m_s2 = self.gravity_m_s2;
        if !(gravity_m_s2.is_finite() && gravity_m_s2 > 0.0) {
            return Err(MotionError::Gravity { gravity_m_s2 });
        }
        let mut acceleration_m_s2 = values;
        for value in &mut acceleration_m_s2 {
            *value = unit.to_m_s2(*value, gravity_m_s2);
        }
        Accelerogram::new(dt_s, acceleration_m_s2)
            .map_err(|reason| MotionError::InFile { name: name.to_owned(), reason: Box::new(reason) })
    }
}

/// Reads a record of any known layout from the file at `path`; see [`read_auto`].
///
/// # Errors
///
/// [`MotionError::Unreadable`] where the file cannot be read, [`MotionError::TooLarge`] above
/// 64 MiB, and those of [`read_auto`].
pub fn read_path(path: &Path, options: &ReadOptions) -> Result<Accelerogram, MotionError> {
    let bytes = read_bytes(path)?;
    read_auto(&bytes, &path.display().to_string(), options)
}

/// Reads a record of any known layout from `bytes`: as AT2 where a line of the head gives NPTS
/// and DT (or where `name` ends in `.at2`), else as columns. `name` stands in messages.
///
/// # Errors
///
/// Those of [`read_at2`](crate::read_at2) or of [`read_columns`](crate::read_columns).
pub fn read_auto(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Accelerogram, MotionError> {
    let extension = Path::new(name).extension();
    if at2::looks_like_at2(bytes) || extension.is_some_and(|e| e.eq_ignore_ascii_case("at2")) {
        at2::read_at2(bytes, name, options).map(|record| record.accelerogram)
    } else {
        columns::read_columns(bytes, name, options)
    }
}

fn read_bytes(path: &Path) -> Result<Vec<u8>, MotionError> {
    let unreadable = |reason| MotionError::Unreadable { path: path.to_owned(), reason };
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(LARGEST_FILE_BYTES + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE_BYTES {
        return Err(MotionError::TooLarge { name: path.display().to_string(), limit_bytes: LARGEST_FILE_BYTES });
    }
    Ok(bytes)
}

/// Text of a file: UTF-8 with or without byte order mark, else Latin-1, in which every byte is a
/// character. An end-of-file mark of DOS is dropped.
fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let bytes = bytes.strip_suffix(b"\x1a").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect()),
    }
}

/// `text` trimmed, and shortened where it is too long for a message.
fn excerpt(text: &str) -> String {
    const LONGEST: usize = 60;
    let text = text.trim();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn excerpts_are_short() {
        assert_eq!(excerpt("  short \r"), "short");
        assert_eq!(excerpt(&"ä".repeat(1000)).chars().count(), 61);
    }

    #[test]
    fn encodings() {
        assert_eq!(decode(b"\xef\xbb\xbfabc\x1a"), "abc");
        assert_eq!(decode("Düzce".as_bytes()), "Düzce");
        assert_eq!(decode(b"D\xfczce"), "Düzce");
    }
}
