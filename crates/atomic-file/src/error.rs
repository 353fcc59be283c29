//! What can go wrong with a file.

use std::io;
use std::path::{Path, PathBuf};

/// Why a file could not be opened or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The operating system refused.
    #[error("{}: cannot {action}: {}", path.display(), reason(source))]
    Io {
        /// File or folder.
        path: PathBuf,
        /// What was tried, e.g. "create the folder".
        action: &'static str,
        /// The operating system's reason.
        source: io::Error,
    },
    /// The path leads to a folder, a device or a pipe.
    #[error("{}: is {found}, not a file: give the name of a file", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
        /// "a folder" or "a device or pipe".
        found: &'static str,
    },
    /// A file that is read as a whole is larger than any of its kind.
    #[error("{}: is larger than {limit_bytes} bytes: name the right file", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The most that is read, bytes.
        limit_bytes: u64,
    },
}

/// The operating system's reason in plain words, without its number.
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => return "there is no such file or folder".to_owned(),
        io::ErrorKind::NotADirectory => return "a part of the path is a file, not a folder".to_owned(),
        io::ErrorKind::AlreadyExists => return "a file of this name exists".to_owned(),
        _ => {}
    }
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_owned()
}

/// Attaches the path and the action to an error of the operating system.
pub fn io_error(path: &Path, action: &'static str) -> impl FnOnce(io::Error) -> FileError {
    move |source| FileError::Io { path: path.to_owned(), action, source }
}
