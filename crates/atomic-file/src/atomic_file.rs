//! A file that is written under another name, and renamed when it is complete.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::error::{FileError, io_error};

/// A hidden, empty file in the folder of the target; it takes the target's place by [`AtomicFile::replace`] and
/// vanishes when dropped before.
#[derive(Debug)]
pub struct AtomicFile {
    target: PathBuf,
    partial: PathBuf,
}

impl AtomicFile {
    /// Makes `.<name>.partial-<process>-<count>` beside `path`, and the folders above it.
    ///
    /// # Errors
    /// [`FileError::NotAFile`] where `path` is a folder or a device, [`FileError::Io`] where the folder cannot be made
    /// or written to.
    pub fn reserve(path: &Path) -> Result<Self, FileError> {
        let target = final_place(path)?;
        let Some(name) = target.file_name() else {
            return Err(FileError::NotAFile { path: path.to_owned(), found: "a folder" });
        };
        let folder = folder_of(&target);
        fs::create_dir_all(folder).map_err(io_error(folder, "create the folder"))?;
        let partial = folder.join(hidden_name(name));
        OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(&partial)
            .map_err(io_error(folder, "create a file in the folder"))?;
        Ok(Self { target, partial })
    }

    /// The place of the result.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// The file to write to.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// Puts the written file in the target's place, durably: the content reaches the disk before the name does.
    ///
    /// # Errors
    /// [`FileError::Io`] where the disk is full or fails; an older file is then untouched.
    pub fn replace(self) -> Result<(), FileError> {
        File::options()
            .read(true)
            .write(true)
            .open(&self.partial)
            .and_then(|file| file.sync_all())
            .map_err(io_error(&self.target, "bring the file to the disk"))?;
        fs::rename(&self.partial, &self.target).map_err(io_error(&self.target, "put the finished file in place"))?;
        sync_folder(folder_of(&self.target)).map_err(io_error(&self.target, "bring the folder to the disk"))
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        // After `replace` there is nothing left under this name, and nobody to tell of a failure.
        let _ = fs::remove_file(&self.partial);
    }
}

/// Writes `content` to `path` at once: under another name, brought to the disk, and put in place.
///
/// # Errors
/// [`FileError::Io`] where the disk is full or fails; an older file is then untouched.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), FileError> {
    let file = AtomicFile::reserve(path)?;
    fs::write(file.partial(), content).map_err(io_error(path, "write the file"))?;
    file.replace()
}

/// Takes away what earlier writers of the result at `path` and of the tables beside it left behind when they were
/// killed. Nobody else may be writing them meanwhile.
pub fn remove_leftovers(path: &Path) {
    let Ok(target) = final_place(path) else { return };
    let Some(stem) = target.file_stem().and_then(|stem| stem.to_str()) else { return };
    let beginning = format!(".{stem}.");
    for entry in fs::read_dir(folder_of(&target)).into_iter().flatten().flatten() {
        let leftover = |name: &str| name.starts_with(&beginning) && name.contains(".partial-");
        if entry.file_name().to_str().is_some_and(leftover) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Follows a symbolic link, so that the result replaces the file and not the link.
///
/// # Errors
/// [`FileError::NotAFile`] where `path` is a folder or a device, [`FileError::Io`] where it cannot be looked at.
pub fn final_place(path: &Path) -> Result<PathBuf, FileError> {
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(path.to_owned()),
        Err(error) => return Err(io_error(path, "write the file")(error)),
    };
    require_file(path, &metadata)?;
    fs::canonicalize(path).map_err(io_error(path, "find the file"))
}

/// Refuses folders, devices and pipes.
///
/// # Errors
/// [`FileError::NotAFile`] for these.
pub fn require_file(path: &Path, metadata: &fs::Metadata) -> Result<(), FileError> {
    if metadata.is_file() {
        return Ok(());
    }
    let found = if metadata.is_dir() { "a folder" } else { "a special file" };
    Err(FileError::NotAFile { path: path.to_owned(), found })
}

fn folder_of(target: &Path) -> &Path {
    match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn hidden_name(name: &std::ffi::OsStr) -> OsString {
    // The count keeps two writers of one process apart.
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let mut hidden = OsString::from(".");
    hidden.push(name);
    hidden.push(format!(".partial-{}-{}", process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
    hidden
}

#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        // Some file systems have no such call for folders; the file itself is safe.
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        result => result,
    }
}

#[cfg(not(unix))]
fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn files_in(folder: &Path) -> Vec<String> {
        let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
        let mut names: Vec<String> = fs::read_dir(folder).unwrap().map(name).collect();
        names.sort();
        names
    }

    #[test]
    fn whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/result.h5");
        write_whole(&path, b"first").unwrap();
        let file = AtomicFile::reserve(&path).unwrap();
        fs::write(file.partial(), "half").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"first");
        drop(file);
        write_whole(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(files_in(&folder.path().join("new")), ["result.h5"]);
    }

    #[test]
    fn leftovers_of_the_killed_go_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.h5");
        for name in [".result.h5.partial-1-0", ".result.urs.csv.partial-1-1", ".other.h5.partial-1-2", "result.h5"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        remove_leftovers(&path);
        assert_eq!(files_in(folder.path()), [".other.h5.partial-1-2", "result.h5"]);
    }

    #[test]
    fn folders_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(write_whole(folder.path(), b""), Err(FileError::NotAFile { found: "a folder", .. })));
        let below_a_file = folder.path().join("file/result.h5");
        fs::write(folder.path().join("file"), "").unwrap();
        assert!(matches!(write_whole(&below_a_file, b""), Err(FileError::Io { .. })));
    }
}
