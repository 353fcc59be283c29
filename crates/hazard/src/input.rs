//! Files as they lie on the disk: plain or packed with gzip.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Read};
use std::path::Path;

use flate2::bufread::MultiGzDecoder;

use crate::error::HazardError;

/// Text that can be read line by line, from wherever it comes.
pub(crate) type Input = Box<dyn BufRead + Send>;

/// The content of a file, unpacked.
///
/// # Errors
/// [`HazardError::File`] for what is missing or no file.
pub(crate) fn open(path: &Path) -> Result<Input, HazardError> {
    let fail = |reason: &str| HazardError::File { file: path.display().to_string(), reason: reason.to_owned() };
    let unreadable = |error: io::Error| fail(&unreadable_because(&error));
    if !std::fs::metadata(path).map_err(unreadable)?.is_file() {
        return Err(fail("not a file; name a file that holds hazard curves"));
    }
    unpacked(BufReader::new(File::open(path).map_err(unreadable)?)).map_err(unreadable)
}

/// Why a file cannot be read, without the number that the operating system has for it.
pub(crate) fn unreadable_because(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::NotADirectory => "a part of the path is a file, not a folder".to_owned(),
        _ => format!("cannot be read: {}", error.to_string().split(" (os error").next().unwrap_or_default()),
    }
}

/// The content of `reader`, which gzip may have packed.
pub(crate) fn unpacked(mut reader: impl BufRead + Send + 'static) -> io::Result<Input> {
    let head = peek(&mut reader, 4)?;
    if head == b"\x89HDF" {
        return Err(io::Error::other("it is an HDF5 file such as a result, not a hazard curve"));
    }
    let packed = head.starts_with(b"\x1f\x8b");
    let whole = Cursor::new(head).chain(reader);
    Ok(if packed { Box::new(BufReader::new(MultiGzDecoder::new(whole))) } else { Box::new(whole) })
}

/// The first `count` bytes, fewer where there are no more; they are gone from `reader`.
pub(crate) fn peek(reader: &mut impl BufRead, count: u64) -> io::Result<Vec<u8>> {
    let mut head = Vec::new();
    reader.take(count).read_to_end(&mut head)?;
    Ok(head)
}

/// The whole of `input` as text without byte order mark, where it has at most `limit` bytes.
///
/// # Errors
/// [`HazardError::File`] for text that is too long or not UTF-8, and for what cannot be unpacked; `advice` says what to
/// do where it is too long.
pub(crate) fn text(input: Input, name: &str, limit: u64, advice: &str) -> Result<String, HazardError> {
    let fail = |reason: String| HazardError::File { file: name.to_owned(), reason };
    let mut bytes = Vec::new();
    input.take(limit + 1).read_to_end(&mut bytes).map_err(|error| fail(unreadable_because(&error)))?;
    if bytes.len() as u64 > limit {
        return Err(fail(format!("larger than {limit} bytes: {advice}")));
    }
    if [b"\xff\xfe", b"\xfe\xff"].iter().any(|mark| bytes.starts_with(*mark)) {
        return Err(fail(format!("UTF-16 text, which Excel and Notepad call Unicode: {SAVE_AS_UTF8}")));
    }
    let mut text = String::from_utf8(bytes).map_err(|_| fail(NOT_UTF8.to_owned()))?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(text)
}

/// What to do about it.
pub(crate) const SAVE_AS_UTF8: &str = "save it as \"CSV UTF-8\"";
/// Said of text in another encoding.
pub(crate) const NOT_UTF8: &str = "not UTF-8 text; save it as \"CSV UTF-8\"";
