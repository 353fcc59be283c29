//! One run at a time for one result.

use std::fs::{File, TryLockError};
use std::io::{ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use uplift_atomic_file::{final_place, folder_of, io_error, is_still_at};

use crate::error::JobError;
use crate::outputs::provide_folder;

/// Held as long as something is being written to a result. The operating system lets go of it when the program ends,
/// however it ends.
#[derive(Debug)]
pub struct ResultLock {
    path: PathBuf,
    file: File,
}

impl ResultLock {
    /// Takes the lock of the result at `result`, a hidden file beside it; its folder is made.
    ///
    /// # Errors
    /// Where another run has it, and where the folder cannot be written.
    pub fn acquire(result: &Path) -> Result<Self, JobError> {
        let path = lock_path(result);
        let folder = folder_of(&path);
        provide_folder(folder)?;
        let fail = |error: std::io::Error| match error.kind() {
            ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem if result.is_file() => {
                JobError::input(format!(
                    "{}: cannot add the answer to the result, since its folder is read-only: copy the result to a \
                     folder that you can write to",
                    result.display()
                ))
            }
            _ => io_error(folder, "create a file in the folder")(error).into(),
        };
        let mut tries = 0;
        loop {
            let mut file =
                File::options().read(true).write(true).create(true).truncate(false).open(&path).map_err(fail)?;
            match file.try_lock() {
                Ok(()) => {}
                // somebody may only be looking whether it is held
                Err(TryLockError::WouldBlock) if tries < TRIES => {
                    tries += 1;
                    std::thread::sleep(PAUSE);
                    continue;
                }
                Err(TryLockError::WouldBlock) => {
                    let mut holder = String::new();
                    let _ = file.take(200).read_to_string(&mut holder);
                    return Err(JobError::input(format!(
                        "{} is being written by another run ({}): wait for it, or give another name with -o",
                        result.display(),
                        holder.trim()
                    )));
                }
                // some file systems have no locks: better to run without than not at all
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
                Err(TryLockError::Error(error)) => return Err(fail(error)),
            }
            // whoever had it before may have taken the file away between our opening and our locking
            if !is_still_at(&file, &path) {
                continue;
            }
            let _ = file.set_len(0).and_then(|()| file.rewind());
            let _ = write!(file, "process {}", std::process::id());
            return Ok(Self { path, file });
        }
    }

    /// Whether somebody holds the lock of the result at `result`, and who.
    pub fn holder(result: &Path) -> Option<String> {
        let mut file = File::open(lock_path(result)).ok()?;
        match file.try_lock_shared() {
            Err(TryLockError::WouldBlock) => {
                let mut holder = String::new();
                let _ = file.read_to_string(&mut holder);
                Some(holder.trim().to_owned())
            }
            _ => None,
        }
    }

    /// Removes the lock file that a run left at `result` when it was killed.
    pub fn clear(result: &Path) {
        if lock_path(result).exists() {
            // where another run holds it, it stays
            drop(Self::acquire(result));
        }
    }

    /// As [`ResultLock::acquire`], but waits for another that has it, `longest` at most.
    ///
    /// # Errors
    /// As [`ResultLock::acquire`].
    pub fn wait(result: &Path, longest: Duration) -> Result<Self, JobError> {
        let start = Instant::now();
        loop {
            match Self::acquire(result) {
                Err(_) if start.elapsed() < longest && Self::holder(result).is_some() => std::thread::sleep(PAUSE),
                other => return other,
            }
        }
    }
}

/// How often, and after which pause, a lock that is held is tried again before it is believed.
const TRIES: u32 = 5;
const PAUSE: Duration = Duration::from_millis(30);

/// Beside the file itself, where `result` is a link to it.
fn lock_path(result: &Path) -> PathBuf {
    let result = final_place(result).unwrap_or_else(|_| result.to_owned());
    let name = result.file_name().unwrap_or(result.as_os_str()).to_string_lossy();
    result.with_file_name(format!(".{name}.lock"))
}

impl Drop for ResultLock {
    fn drop(&mut self) {
        // while the lock is held: nobody can take it between the two
        let _ = std::fs::remove_file(&self.path);
        let _ = self.file.unlock();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let result = folder.path().join("a.h5");
        assert_eq!(ResultLock::holder(&result), None);
        let held = ResultLock::acquire(&result).unwrap();
        let refused = ResultLock::acquire(&result).unwrap_err();
        assert!(refused.to_string().contains("another run (process"), "{refused}");
        assert!(ResultLock::holder(&result).unwrap().contains(&std::process::id().to_string()));
        ResultLock::acquire(&folder.path().join("b.h5")).unwrap();
        drop(held);
        assert_eq!(ResultLock::holder(&result), None);
        drop(ResultLock::acquire(&result).unwrap());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn what_a_killed_run_left_is_removed_and_what_is_held_stays() {
        let folder = tempfile::tempdir().unwrap();
        let result = folder.path().join("a.h5");
        std::fs::write(lock_path(&result), "process 1").unwrap();
        ResultLock::clear(&result);
        assert!(!lock_path(&result).exists());
        let _held = ResultLock::acquire(&result).unwrap();
        ResultLock::clear(&result);
        assert!(lock_path(&result).exists());
    }
}
