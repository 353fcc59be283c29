//! Free space where files are written.

use std::path::Path;

use super::Limit;

/// What there is of disk at a place.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Disk {
    /// Space that is free for this user.
    pub free: Option<Limit>,
    /// Largest file that this process may write.
    pub largest_file: Option<Limit>,
}

/// The disk where `file` is, or will be; its folder need not be there yet.
#[cfg(unix)]
pub fn disk(file: &Path) -> Disk {
    let absolute = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    let free = absolute.ancestors().skip(1).find_map(|folder| {
        let system = rustix::fs::statvfs(folder).ok()?;
        // a system that tells nothing tells zero blocks in all
        (system.f_blocks > 0).then(|| {
            let bytes = system.f_bavail.saturating_mul(system.f_frsize);
            Limit::new(bytes, format!("free at {}", folder.display()))
        })
    });
    let largest = super::process_limits::limit(Path::new("/"), "Max file size");
    let largest_file = largest.map(|bytes| Limit::new(bytes, "the largest file of this process: ulimit -f"));
    Disk { free, largest_file }
}

/// The disk where `file` is, or will be: unknown on this system.
#[cfg(not(unix))]
pub fn disk(_file: &Path) -> Disk {
    Disk::default()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_place_that_is_not_there_yet_has_the_space_of_the_folder_above() {
        let here = disk(&std::env::temp_dir().join("r.h5")).free.map(|limit| limit.of);
        let below = disk(&std::env::temp_dir().join("not there/nor there/r.h5")).free.map(|limit| limit.of);
        assert!(here.is_some());
        assert_eq!(here, below);
    }
}
