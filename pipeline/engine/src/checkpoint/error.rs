//! Why a file of finished analysis rows cannot be used.

use std::path::PathBuf;

use thiserror::Error;
use uplift_atomic_file::reason;

/// What the first line of a file of finished rows says it is.
pub(super) const FORMAT: &str = "uplift analysis rows 2";

/// The title of a study behind its mention; nothing where it has none.
pub(crate) fn in_brackets(title: &str) -> String {
    if title.is_empty() { String::new() } else { format!(" ({title:?})") }
}

/// Why a file of finished analysis rows cannot be used.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// It cannot be read.
    #[error("{}: {}", path.display(), reason(source))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// It cannot be written.
    #[error("{} cannot be written: {}", path.display(), reason(source))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// It is something else.
    #[error("{}: is not a file of finished analysis rows of this version ({FORMAT})", path.display())]
    NotRows {
        /// The file.
        path: PathBuf,
    },
    /// It is a shard of other work, which must not be lost.
    #[error(
        "{}: already exists, as shard {shard} of {shards} of other work{}: remove it, or give another name (-o)",
        path.display(),
        in_brackets(title)
    )]
    OtherWork {
        /// The file.
        path: PathBuf,
        /// Which shard it is, from 1.
        shard: u64,
        /// Of how many.
        shards: u64,
        /// Title of its study.
        title: String,
    },
    /// Nothing more can be added to it.
    #[error(
        "{}: no more analysis rows can be written ({}); those written are kept: free some space, and run the same \
         command to resume",
        path.display(),
        reason(source)
    )]
    Full {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
}
