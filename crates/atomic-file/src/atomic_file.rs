//! A file that is written under another name, and renamed when it is complete.

use std::fs::{self, File, Permissions};
use std::io;
use std::path::{Path, PathBuf};

use crate::error::{FileError, io_error};
use crate::partial::take_partial;
use crate::read::require_file;

/// A hidden, empty file in the folder of the target; it takes the target's place by [`AtomicFile::replace`] and
/// vanishes when dropped before.
///
/// It is locked as long as its writer lives. What a killed writer left is known by that, and makes room for the next
/// writer of the same target.
#[derive(Debug)]
pub struct AtomicFile {
    target: PathBuf,
    partial: PathBuf,
    /// Whether it has taken the target's place: its name is then free for the next writer.
    replaced: bool,
    /// Of the file that is replaced.
    permissions: Option<Permissions>,
    /// Holds the lock; whoever writes opens the file once more.
    lock: File,
}

impl AtomicFile {
    /// Makes `.<name>.partial-<machine>-<count>` beside `path`, and the folders above it, and takes away what killed
    /// writers of `path` left on this machine.
    ///
    /// # Errors
    /// [`FileError::NotAFile`] where `path` is a folder or a device, [`FileError::Io`] where the folder cannot be made
    /// or written to.
    pub fn reserve(path: &Path) -> Result<Self, FileError> {
        let target = final_place(path)?;
        if target.file_name().is_none() {
            return Err(FileError::NotAFile { path: path.to_owned(), found: "a folder" });
        }
        let folder = folder_of(&target);
        fs::create_dir_all(folder).map_err(io_error(folder, "create the folder"))?;
        let (partial, lock) = take_partial(&target).map_err(|error| {
            // the folder is there, so that no missing one is meant: /proc says so
            let is_missing = error.kind() == io::ErrorKind::NotFound && folder.is_dir();
            let error = if is_missing { io::Error::other("it takes no files") } else { error };
            io_error(folder, "create a file in the folder")(error)
        })?;
        let mut file = Self { replaced: false, permissions: None, target, partial, lock };
        file.permissions = fs::metadata(&file.target).ok().map(|metadata| metadata.permissions());
        if let Some(permissions) = &file.permissions {
            // nobody else may read what the replaced file hides, not even while it is written
            set_permissions(&file.partial, &writable(permissions))?;
        }
        Ok(file)
    }

    /// The place of the result.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// The file to write to.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// Lets go of the lock, for a writer that locks the hidden file itself.
    pub fn hand_over_lock(&self) {
        let _ = self.lock.unlock();
    }

    /// Puts the written file in the target's place, durably: the content reaches the disk before the name does. Who may
    /// read and write an older file may do so with the new one.
    ///
    /// # Errors
    /// [`FileError::Io`] where the disk is full or fails; an older file is then untouched.
    pub fn replace(mut self) -> Result<(), FileError> {
        File::options()
            .read(true)
            .write(true)
            .open(&self.partial)
            .and_then(|file| file.sync_all())
            .map_err(io_error(&self.target, "write the file to disk"))?;
        if let Some(permissions) = &self.permissions {
            set_permissions(&self.partial, permissions)?;
        }
        fs::rename(&self.partial, &self.target).map_err(io_error(&self.target, "put the finished file in place"))?;
        self.replaced = true;
        let _ = self.lock.unlock();
        sync_folder(folder_of(&self.target)).map_err(io_error(&self.target, "write the folder to disk"))
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if !self.replaced {
            // nobody is left to tell of a failure
            let _ = fs::remove_file(&self.partial);
        }
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

/// Follows a symbolic link, so that the result replaces the file and not the link; the file need not be there yet.
///
/// # Errors
/// [`FileError::NotAFile`] where `path` is a folder or a device, [`FileError::Io`] where it cannot be looked at.
pub fn final_place(path: &Path) -> Result<PathBuf, FileError> {
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return where_link_leads(path),
        Err(error) => return Err(io_error(path, "write the file")(error)),
    };
    require_file(path, &metadata)?;
    fs::canonicalize(path).map_err(io_error(path, "find the file"))
}

/// The place that links lead to, where no file is; their folder must be there, since it may be on a disk that is not.
fn where_link_leads(path: &Path) -> Result<PathBuf, FileError> {
    let mut place = path.to_owned();
    // a ring of links is another error than a missing file
    while let Ok(next) = fs::read_link(&place) {
        place = folder_of(&place).join(next);
        fs::metadata(folder_of(&place)).map_err(io_error(path, "follow the symbolic link"))?;
    }
    Ok(place)
}

/// The folder that a file is in: the current one of a name alone.
pub fn folder_of(target: &Path) -> &Path {
    match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn set_permissions(path: &Path, permissions: &Permissions) -> Result<(), FileError> {
    fs::set_permissions(path, permissions.clone()).map_err(io_error(path, "keep the permissions of the file"))
}

#[cfg(unix)]
fn writable(permissions: &Permissions) -> Permissions {
    use std::os::unix::fs::PermissionsExt;
    Permissions::from_mode(permissions.mode() & 0o777 | 0o600)
}

#[cfg(not(unix))]
fn writable(permissions: &Permissions) -> Permissions {
    let mut permissions = permissions.clone();
    #[allow(clippy::permissions_set_readonly_false)] // not Unix
    permissions.set_readonly(false);
    permissions
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
pub(crate) mod tests {
    use super::*;

    pub(crate) fn files_in(folder: &Path) -> Vec<String> {
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
    fn writers_of_one_file_keep_apart() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.h5");
        let [one, other] = [0; 2].map(|_| AtomicFile::reserve(&path).unwrap());
        fs::write(one.partial(), "one").unwrap();
        fs::write(other.partial(), "other").unwrap();
        other.replace().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"other");
        one.replace().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"one");
        assert_eq!(files_in(folder.path()), ["result.h5"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_reader_is_never_kept_off() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.h5");
        let file = AtomicFile::reserve(&path).unwrap();
        // in its place, as in the moment before its writer lets go of it
        fs::rename(file.partial(), &path).unwrap();
        File::open(&path).unwrap().try_lock_shared().unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn who_may_read_a_file_stays_the_same() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("result.h5");
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
        for kept in [0o600, 0o640, 0o444] {
            write_whole(&path, b"first").unwrap();
            fs::set_permissions(&path, Permissions::from_mode(kept)).unwrap();
            let file = AtomicFile::reserve(&path).unwrap();
            assert_eq!(mode(file.partial()) & 0o077, kept & 0o077);
            fs::write(file.partial(), "second").unwrap();
            file.replace().unwrap();
            assert_eq!((mode(&path), fs::read(&path).unwrap()), (kept, b"second".to_vec()));
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_a_file_that_is_not_there_stays_a_link() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("disk")).unwrap();
        symlink("disk/result.h5", at("link.h5")).unwrap();
        symlink(at("link.h5"), at("second.h5")).unwrap();
        write_whole(&at("second.h5"), b"first").unwrap();
        assert_eq!(fs::read(at("disk/result.h5")).unwrap(), b"first");
        write_whole(&at("link.h5"), b"second").unwrap();
        assert_eq!(fs::read(at("disk/result.h5")).unwrap(), b"second");
        assert!(["link.h5", "second.h5"].iter().all(|link| fs::symlink_metadata(at(link)).unwrap().is_symlink()));
        // to a folder that is not there, and in a ring
        symlink("absent/result.h5", at("lost.h5")).unwrap();
        symlink("ring.h5", at("ring.h5")).unwrap();
        for link in ["lost.h5", "ring.h5"] {
            assert!(matches!(write_whole(&at(link), b""), Err(FileError::Io { .. })), "{link}");
            assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink(), "{link}");
        }
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
