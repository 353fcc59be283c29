//! Files that appear under their names complete, or not at all.
//!
//! A file is written under a hidden name beside its place, brought to the disk, and renamed: whoever looks finds the
//! old one or the new one, whatever happens in between. What a killed writer leaves makes room for the next writer of
//! the same file, and for nobody else. Files are read only where they are files, so that no pipe is waited for.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("spectra.csv");
//! uplift_atomic_file::write_whole(&path, b"strength,u_m\n")?;
//! assert_eq!(std::fs::read(&path)?, b"strength,u_m\n");
//! # Ok(())
//! # }
//! ```

mod atomic_file;
mod error;
mod identity;
mod partial;
mod read;

pub use atomic_file::{AtomicFile, final_place, folder_of, write_whole};
pub use error::{FileError, io_error, reason};
pub use identity::is_still_at;
pub use partial::clear_leftovers;
pub use read::{open_file, read_file, require_file};
