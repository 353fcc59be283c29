//! Files that are read: files indeed, and no larger than they can be.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use crate::error::{FileError, io_error};

/// Opens a file for reading; a pipe is not waited for, and a device not read for ever.
///
/// # Errors
/// [`FileError::NotAFile`] for folders, devices and pipes, [`FileError::Io`] for what cannot be opened.
pub fn open_file(path: &Path) -> Result<File, FileError> {
    require_file(path, &fs::metadata(path).map_err(io_error(path, "read the file"))?)?;
    File::open(path).map_err(io_error(path, "read the file"))
}

/// The content of a file of at most `limit_bytes`.
///
/// # Errors
/// As [`open_file`]; [`FileError::TooLarge`].
pub fn read_file(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, FileError> {
    let mut content = Vec::new();
    open_file(path)?
        .take(limit_bytes.saturating_add(1))
        .read_to_end(&mut content)
        .map_err(io_error(path, "read the file"))?;
    if content.len() as u64 > limit_bytes {
        return Err(FileError::TooLarge { path: path.to_owned(), limit_bytes });
    }
    Ok(content)
}

/// Refuses folders, devices and pipes.
///
/// # Errors
/// [`FileError::NotAFile`] for these.
pub fn require_file(path: &Path, metadata: &fs::Metadata) -> Result<(), FileError> {
    if metadata.is_file() {
        return Ok(());
    }
    let found = if metadata.is_dir() { "a folder" } else { "a device or pipe" };
    Err(FileError::NotAFile { path: path.to_owned(), found })
}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn only_files_are_read_and_no_more_than_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("text");
        fs::write(&path, "1234").unwrap();
        assert_eq!(read_file(&path, 4).unwrap(), b"1234");
        assert!(matches!(read_file(&path, 3), Err(FileError::TooLarge { limit_bytes: 3, .. })));
        assert!(matches!(read_file(folder.path(), 9), Err(FileError::NotAFile { found: "a folder", .. })));
        assert!(matches!(read_file(Path::new("/dev/zero"), 9), Err(FileError::NotAFile { .. })));
        assert!(matches!(read_file(&folder.path().join("none"), 9), Err(FileError::Io { .. })));
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        assert!(matches!(read_file(&pipe, 9), Err(FileError::NotAFile { found: "a device or pipe", .. })));
    }
}
