//! Whether an open file is still the one under its name.

use std::fs::{self, File};
use std::path::Path;

/// Whether `file` is the one that `path` leads to now, and not one that has been replaced or removed since.
#[cfg(unix)]
pub fn is_still_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
    match (file.metadata(), fs::metadata(path)) {
        (Ok(ours), Ok(there)) => identity(ours) == identity(there),
        _ => false,
    }
}

/// Whether `file` is the one that `path` leads to now, as far as length and time tell.
#[cfg(not(unix))]
pub fn is_still_at(file: &File, path: &Path) -> bool {
    let identity = |metadata: fs::Metadata| (metadata.len(), metadata.modified().ok());
    match (file.metadata(), fs::metadata(path)) {
        (Ok(ours), Ok(there)) => identity(ours) == identity(there),
        _ => false,
    }
}
