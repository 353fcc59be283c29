//! What can go wrong with a file of labelled arrays.

use std::path::PathBuf;

use uplift_atomic_file::FileError;

/// Why a file of labelled arrays could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum LabelledError {
    /// The operating system refused, or the path leads to a folder or a device.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file is something else.
    #[error("{}: is not an HDF5 file ({bytes} bytes): give a result file written by this program", path.display())]
    NotHdf5 {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
    },
    /// The end of the file is missing.
    #[error("{}: the HDF5 file is cut short ({bytes} bytes are there): copy it again or repeat the \
             run", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// The size that is left.
        bytes: u64,
    },
    /// The file does not end with its checksum.
    #[error("{}: the checksum at its end is missing: another program has changed it, or it is cut short. Use another \
             copy or repeat the run", path.display())]
    Unsealed {
        /// The file.
        path: PathBuf,
    },
    /// The file is not as it was written.
    #[error("{}: {}has changed since it was written: use another copy or repeat the run", path.display(),
            object.as_ref().map(|object| format!("{object} ")).unwrap_or_default())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The array; none where it is the structure of the file.
        object: Option<String>,
    },
    /// Another file took its place while it was opened.
    #[error("{}: was replaced while it was opened: try again", path.display())]
    Replaced {
        /// The file.
        path: PathBuf,
    },
    /// Another program has the file open for writing.
    #[error("{}: another program has the file open for writing: close it there first", path.display())]
    Locked {
        /// The file.
        path: PathBuf,
    },
    /// The HDF5 library failed, most often because the disk is full or the file is damaged.
    #[error("{}: cannot {action} {object}: {reason}", path.display())]
    Hdf5 {
        /// The file.
        path: PathBuf,
        /// What was tried, e.g. "write".
        action: &'static str,
        /// Path inside the file.
        object: String,
        /// The library's reason, or the operating system's where the library quotes it.
        reason: String,
    },
    /// The file has no such object or attribute.
    #[error("{}: has no {object}", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// Path inside the file, with its attribute where one was asked for.
        object: String,
    },
    /// The object is of another kind, type or shape than asked for.
    #[error("{}: {object} is {found}, but {wanted} is needed", path.display())]
    WrongType {
        /// The file.
        path: PathBuf,
        /// Path inside the file.
        object: String,
        /// What the file holds.
        found: String,
        /// What was asked for.
        wanted: &'static str,
    },
    /// The caller contradicts itself: a bug of the program, not of its user.
    #[error("{}: cannot write {object}: {reason}; this is a bug in the program", path.display())]
    Misuse {
        /// The file.
        path: PathBuf,
        /// Path inside the file.
        object: String,
        /// The contradiction.
        reason: String,
    },
}

/// The reason inside an error of the HDF5 library: the operating system's words where the library quotes them
/// ("No space left on device"), else the library's own.
pub(super) fn reason(error: &hdf5::Error) -> String {
    error
        .stack()
        .and_then(|stack| {
            stack.iter().find_map(|frame| {
                let (_, quoted) = frame.desc().split_once("error message = '")?;
                Some(quoted.split_once('\'')?.0.to_owned())
            })
        })
        .unwrap_or_else(|| error.to_string())
}
