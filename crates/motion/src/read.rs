//! Readers of record files: what is given from outside, and which reader it goes to.

pub(crate) mod at2;
pub(crate) mod columns;
mod cosmos;
mod csmip;
mod date;
mod esm;
mod fortran;
mod head;
mod knet;
mod number;
mod volume;

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

use uplift_plausible::{PEAK_ACCELERATION, TIME_STEP};

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::recording::{RecordFile, RecordFormat, Recording};
use crate::unit::{AccelerationUnit, STANDARD_GRAVITY_M_S2};

/// Largest file that is read, unpacked \[bytes\]: a few million points, far above any accelerogram.
const LARGEST_FILE_BYTES: u64 = 64 * 1024 * 1024;

/// Beginning of a file by which its layout is recognised \[bytes\].
const HEAD_BYTES: usize = 16 * 1024;

/// What the caller knows about a file; what the file itself says takes precedence over step and unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadOptions {
    /// Layout of the file; none to recognise it by the content.
    pub format: Option<RecordFormat>,
    /// Which component of a file with several, counted from one.
    pub channel: Option<usize>,
    /// Time step \[s\] of a file of one column.
    pub dt_s: Option<f64>,
    /// Unit of accelerations whose unit the file does not say.
    pub unit: Option<AccelerationUnit>,
    /// Acceleration of gravity \[m/s²\] by which values in g are converted.
    pub gravity_m_s2: f64,
}

/// Everything as the file says, and standard gravity.
impl Default for ReadOptions {
    fn default() -> Self {
        Self { format: None, channel: None, dt_s: None, unit: None, gravity_m_s2: STANDARD_GRAVITY_M_S2 }
    }
}

impl ReadOptions {
    /// The unit that is `stated`, else the caller's; `name` is the file.
    fn unit_or(&self, stated: Option<AccelerationUnit>, name: &str) -> Result<AccelerationUnit, MotionError> {
        stated.or(self.unit).ok_or_else(|| MotionError::MissingUnit { name: name.to_owned() })
    }

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
            .and_then(plausible)
            .map_err(|reason| MotionError::InFile { name: name.to_owned(), reason: Box::new(reason) })
    }
}

/// The record, if its time step and its largest acceleration are those of a record.
fn plausible(record: Accelerogram) -> Result<Accelerogram, MotionError> {
    TIME_STEP.check("time step", record.dt_s())?;
    PEAK_ACCELERATION.check("the largest acceleration", record.pga_m_s2())?;
    Ok(record)
}

/// Reads every acceleration component of the record file at `path`; see [`read_record`].
///
/// # Errors
///
/// [`MotionError::Unreadable`] where the file cannot be read, [`MotionError::TooLarge`] above
/// 64 MiB, and those of [`read_record`].
pub fn read_record_file(path: &Path, options: &ReadOptions) -> Result<RecordFile, MotionError> {
    let bytes = record_bytes(path)?;
    read_record(&bytes, &path.display().to_string(), options)
}

/// Reads every acceleration component of a record file from `bytes`, unpacked first where they are
/// gzip; `name` stands in messages. [`ReadOptions::channel`] makes no difference here.
///
/// The layout is that of [`ReadOptions::format`], or else recognised by the content: each has its own
/// words in the head. What has none of them is read as columns.
///
/// # Errors
///
/// [`MotionError::OtherKind`], [`MotionError::Compressed`], [`MotionError::TooLarge`], and those of the
/// reader: a head that lacks something or cannot be read, an invalid number, fewer values than the head says.
pub fn read_record(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<RecordFile, MotionError> {
    let bytes = unpacked(bytes, name)?;
    if options.format.is_none()
        && let Some(found) = other_kind(&bytes, name)
    {
        return Err(MotionError::OtherKind { name: name.to_owned(), found });
    }
    let format = options.format.unwrap_or_else(|| detect(&bytes, name));
    let one = |recording: Recording| vec![recording];
    let recordings = match format {
        RecordFormat::At2 => at2::read(&bytes, name, options).map(one),
        RecordFormat::Esm => esm::read(&bytes, name, options).map(one),
        RecordFormat::Knet => knet::read(&bytes, name, options).map(one),
        RecordFormat::Cosmos => cosmos::read(&bytes, name, options),
        RecordFormat::Csmip => csmip::read(&bytes, name, options),
        RecordFormat::Columns => columns::read(&bytes, name, options).map(one),
    }?;
    Ok(RecordFile { format, recordings })
}

/// Reads one component from the record file at `path`; see [`read_auto`].
///
/// # Errors
///
/// Those of [`read_record_file`] and [`read_auto`].
pub fn read_path(path: &Path, options: &ReadOptions) -> Result<Accelerogram, MotionError> {
    let bytes = record_bytes(path)?;
    read_auto(&bytes, &path.display().to_string(), options)
}

/// Reads one component from the bytes of a record file: the one of [`ReadOptions::channel`], or the
/// only one.
///
/// # Errors
///
/// [`MotionError::Channel`] where there are several and none is chosen, or the chosen one is not
/// there; else those of [`read_record`].
pub fn read_auto(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Accelerogram, MotionError> {
    read_record(bytes, name, options)?.component(name, options.channel).map(|recording| recording.accelerogram)
}

/// The layout that the head of a file shows.
fn detect(bytes: &[u8], name: &str) -> RecordFormat {
    let head = decode(&bytes[..bytes.len().min(HEAD_BYTES)]);
    let named_at2 = Path::new(name.trim_end_matches(".gz")).extension().is_some_and(|e| e.eq_ignore_ascii_case("at2"));
    if esm::looks_like(&head) {
        RecordFormat::Esm
    } else if knet::looks_like(&head) {
        RecordFormat::Knet
    } else if cosmos::looks_like(&head) {
        RecordFormat::Cosmos
    } else if csmip::looks_like(&head) {
        RecordFormat::Csmip
    } else if named_at2 || at2::looks_like(&head) {
        RecordFormat::At2
    } else {
        RecordFormat::Columns
    }
}

/// The kind of a file that is no record; none where it may be one.
fn other_kind(bytes: &[u8], name: &str) -> Option<&'static str> {
    let is_header = |line: &&[u8]| !line.starts_with(b"#") && !line.trim_ascii().is_empty();
    let header = bytes.split(|&byte| byte == b'\n').find(is_header).unwrap_or_default();
    if bytes.starts_with(b"\x89HDF\r\n\x1a\n") {
        Some("an HDF5 file such as a result (`uplift status` shows what it holds)")
    } else if decode(header).split([',', ';', '\t']).any(|column| column.trim().trim_matches('"') == "record_id") {
        Some("a manifest (`uplift records list` shows its records)")
    } else if Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
        Some("a TOML file such as a study or structure")
    } else {
        None
    }
}

/// The bytes themselves, or what they hold packed with gzip.
fn unpacked<'a>(bytes: &'a [u8], name: &str) -> Result<Cow<'a, [u8]>, MotionError> {
    if bytes.starts_with(b"PK\x03\x04") {
        return Err(MotionError::Archive { name: name.to_owned() });
    }
    if !bytes.starts_with(b"\x1f\x8b") {
        return Ok(Cow::Borrowed(bytes));
    }
    let mut content = Vec::new();
    flate2::read::MultiGzDecoder::new(bytes)
        .take(LARGEST_FILE_BYTES + 1)
        .read_to_end(&mut content)
        .map_err(|reason| MotionError::Compressed { name: name.to_owned(), reason })?;
    if content.len() as u64 > LARGEST_FILE_BYTES {
        return Err(MotionError::TooLarge { name: name.to_owned(), limit_bytes: LARGEST_FILE_BYTES });
    }
    Ok(Cow::Owned(content))
}

/// The bytes of a record file as they are, for [`read_record`] and for its checksum.
///
/// # Errors
///
/// [`MotionError::Unreadable`], and [`MotionError::TooLarge`] above 64 MiB.
pub fn record_bytes(path: &Path) -> Result<Vec<u8>, MotionError> {
    bytes_of(path, LARGEST_FILE_BYTES)
}

/// The bytes of a file of at most `limit_bytes`.
pub(crate) fn bytes_of(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, MotionError> {
    let unreadable = |reason| MotionError::Unreadable { path: path.to_owned(), reason };
    // a pipe would be waited for, and a device read for ever
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(unreadable(io::Error::other("it is a folder, a device or a pipe, not a file")));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(limit_bytes + 1).read_to_end(&mut bytes)).map_err(unreadable)?;
    if bytes.len() as u64 > limit_bytes {
        return Err(MotionError::TooLarge { name: path.display().to_string(), limit_bytes });
    }
    Ok(bytes)
}

/// Text of a file: UTF-8 with or without byte order mark, else Latin-1, in which every byte is a
/// character. An end-of-file mark of DOS is dropped.
pub(crate) fn decode(bytes: &[u8]) -> Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let bytes = bytes.strip_suffix(b"\x1a").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect()),
    }
}

/// `text` trimmed, and shortened where it is too long for a message.
pub(crate) fn excerpt(text: &str) -> String {
    const LONGEST: usize = 60;
    let text = text.trim();
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
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
