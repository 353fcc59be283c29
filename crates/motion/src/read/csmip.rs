//! TODO

use super::ReadOptions;
use crate::error::MotionError;
use crate::recording::Recording;

/// Whether the beginning of a file is that of this format.
pub(super) fn looks_like(_head: &str) -> bool {
    false
}

/// Reads a file.
pub(super) fn read(_bytes: &[u8], name: &str, _options: &ReadOptions) -> Result<Vec<Recording>, MotionError> {
    Err(MotionError::MissingTimeStep { name: name.to_owned() })
}
