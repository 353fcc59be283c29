//! The hidden file that a writer has to itself, and what killed writers left.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use crate::atomic_file::final_place;
use crate::identity::is_still_at;

/// Makes a hidden file for `target`, empty and locked, and removes others that killed writers of `target` left on this
/// machine.
///
/// The names are counted for each target and machine, so that the names of other targets never come up. The lock tells
/// whether a writer lives, on this machine; whether locks reach the other machines of a cluster depends on how its file
/// system is mounted, so what was left there stays.
pub(crate) fn take_partial(target: &Path) -> io::Result<(PathBuf, File)> {
    let mut taken = None;
    for count in 0_u32.. {
        let path = partial_path(target, count);
        match (clear(&path), &taken) {
            (Place::Taken, _) | (Place::Cleared, Some(_)) => {}
            (Place::Free, Some(_)) => break,
            (Place::Free | Place::Cleared, None) => {
                match File::options().read(true).write(true).create_new(true).open(&path) {
                    Ok(file) if hold(&file, &path) => taken = Some((path, file)),
                    Ok(_) => {}
                    Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                    Err(error) => return Err(error),
                }
            }
        }
    }
    taken.ok_or_else(|| io::Error::other("other writers have every name of a hidden file"))
}

/// Removes what killed writers of `path` left on this machine, where nobody is to write it again.
pub fn clear_leftovers(path: &Path) {
    let Ok(target) = final_place(path) else { return };
    let mut is_free = false;
    for count in 0_u32.. {
        let was_free = std::mem::replace(&mut is_free, matches!(clear(&partial_path(&target, count)), Place::Free));
        // whoever had the second name may have been killed after the first was free again
        if was_free && is_free {
            return;
        }
    }
}

fn partial_path(target: &Path, count: u32) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(format!(".partial-{:08x}-{count}", machine()));
    target.with_file_name(name)
}

/// This machine among those that share a folder; 0 where it has no name to tell.
fn machine() -> u32 {
    fs::read("/proc/sys/kernel/hostname").map_or(0, |name| crc32fast::hash(&name))
}

/// What there is under a hidden name.
enum Place {
    Free,
    /// The file of a dead writer, which is no longer there.
    Cleared,
    /// The file of a writer that lives, or cannot be proved dead.
    Taken,
}

/// Removes the file at `path` if its writer is dead.
fn clear(path: &Path) -> Place {
    if fs::symlink_metadata(path).is_err_and(|error| error.kind() == io::ErrorKind::NotFound) {
        return Place::Free;
    }
    let Ok(file) = File::options().read(true).write(true).open(path) else { return Place::Taken };
    // removed while it is locked, so that it is the file that was looked at
    if is_abandoned(&file) && is_still_at(&file, path) && fs::remove_file(path).is_ok() {
        Place::Cleared
    } else {
        Place::Taken
    }
}

/// Locks a `file` that was just made at `path`; false where another has taken it for a leftover meanwhile.
fn hold(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    // shared, so that it does not keep readers off the file in the moment after it took its place
    if let Err(fs::TryLockError::WouldBlock) = file.try_lock_shared() {
        return false;
    }
    // on a file system without locks nothing is ever taken for a leftover
    is_still_at(file, path)
}

/// Whether nobody holds `file`, which is then locked to all others. Where locks keep even their owner from opening the
/// file once more, as not on Unix, nobody locks and nothing is proved.
fn is_abandoned(file: &File) -> bool {
    cfg!(unix) && file.try_lock().is_ok()
}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::atomic_file::tests::files_in;
    use crate::{AtomicFile, write_whole};

    fn name(path: &Path) -> String {
        path.file_name().unwrap().to_str().unwrap().to_owned()
    }

    #[test]
    fn leftovers_of_killed_writers_of_the_very_file_go() {
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        let site = place("site.h5");
        // as killed writers leave them: without a lock
        for count in 0..3 {
            fs::write(partial_path(&site, count), "left").unwrap();
        }
        let others = [
            partial_path(&place("site.v2.h5"), 0),
            partial_path(&place("site.urs.csv"), 0),
            partial_path(&place("site.h5.part"), 0),
            place(".site.h5.partial-0000beef-0"),
            place(".site.h5.partial-12-0-0"),
        ];
        for path in &others {
            fs::write(path, "another's").unwrap();
        }
        write_whole(&site, b"whole").unwrap();
        let mut expected: Vec<String> = others.iter().map(|path| name(path)).chain(["site.h5".into()]).collect();
        expected.sort();
        assert_eq!(files_in(folder.path()), expected);
    }

    #[test]
    fn leftovers_go_without_another_writer() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("site.h5");
        write_whole(&path, b"whole").unwrap();
        let living = AtomicFile::reserve(&path).unwrap();
        for count in [1, 3] {
            fs::write(partial_path(&path, count), "left").unwrap();
        }
        clear_leftovers(&path);
        assert_eq!(files_in(folder.path()), [name(living.partial()), "site.h5".into()]);
    }

    #[test]
    fn what_a_living_writer_has_is_left_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("site.h5");
        let living = AtomicFile::reserve(&path).unwrap();
        fs::write(living.partial(), "half").unwrap();
        fs::write(partial_path(&path, 1), "left").unwrap();
        for _ in 0..3 {
            write_whole(&path, b"of another").unwrap();
        }
        assert_eq!(files_in(folder.path()), [name(living.partial()), "site.h5".into()]);
        living.replace().unwrap();
        assert_eq!((files_in(folder.path()), fs::read(&path).unwrap()), (vec!["site.h5".into()], b"half".to_vec()));
    }

    #[test]
    fn many_writers_at_once_lose_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("site.h5");
        std::thread::scope(|scope| {
            for writer in 0..8_u8 {
                let path = &path;
                scope.spawn(move || {
                    for round in 0..50 {
                        write_whole(path, &[writer; 100]).unwrap_or_else(|error| panic!("{writer}, {round}: {error}"));
                    }
                });
            }
        });
        let content = fs::read(&path).unwrap();
        assert!(content.len() == 100 && content.iter().all(|byte| *byte == content[0]));
        assert_eq!(files_in(folder.path()), ["site.h5"]);
    }
}
