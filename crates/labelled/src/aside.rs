//! Writing aside: a result appears under its name complete, or not at all.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

use super::LabelledError;

/// A hidden, empty file in the folder of the target; it takes the target's place by [`Aside::replace`] and vanishes
/// when dropped before.
pub(super) struct Aside {
    target: PathBuf,
    partial: PathBuf,
}

impl Aside {
    /// Makes `.<name>.partial-<process>-<count>` beside `path`, and the folders above it.
    pub(super) fn reserve(path: &Path) -> Result<Self, LabelledError> {
        let target = final_place(path)?;
        let Some(name) = target.file_name() else {
            return Err(LabelledError::NotAFile { path: path.to_owned(), found: "a folder" });
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
    pub(super) fn target(&self) -> &Path {
        &self.target
    }

    /// The file to write to.
    pub(super) fn partial(&self) -> &Path {
        &self.partial
    }

    /// Puts the written file in the target's place, durably: the content reaches the disk before the name does.
    pub(super) fn replace(self) -> Result<(), LabelledError> {
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

impl Drop for Aside {
    fn drop(&mut self) {
        // After `replace` there is nothing left under this name, and nobody to tell of a failure.
        let _ = fs::remove_file(&self.partial);
    }
}

/// Writes `content` to `path` as every file of a result is written: aside, brought to the disk, and put in place at once.
///
/// # Errors
/// [`LabelledError::Io`] where the disk is full or fails; an older file is then untouched.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), LabelledError> {
    let aside = Aside::reserve(path)?;
    fs::write(aside.partial(), content).map_err(io_error(path, "write the file"))?;
    aside.replace()
}

/// Takes away what earlier writers of the result at `path` and of the tables beside it left behind when they were killed. Nobody else
/// may be writing them meanwhile.
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
pub fn final_place(path: &Path) -> Result<PathBuf, LabelledError> {
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(path.to_owned()),
        Err(error) => return Err(io_error(path, "write the file")(error)),
    };
    require_file(path, &metadata)?;
    fs::canonicalize(path).map_err(io_error(path, "find the file"))
}

/// Refuses folders, devices and pipes.
pub(super) fn require_file(path: &Path, metadata: &fs::Metadata) -> Result<(), LabelledError> {
    if metadata.is_file() {
        return Ok(());
    }
    let found = if metadata.is_dir() { "a folder" } else { "a special file" };
    Err(LabelledError::NotAFile { path: path.to_owned(), found })
}

/// Attaches the path and the action to an error of the operating system.
pub(super) fn io_error(path: &Path, action: &'static str) -> impl FnOnce(io::Error) -> LabelledError {
    move |source| LabelledError::Io { path: path.to_owned(), action, source }
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
