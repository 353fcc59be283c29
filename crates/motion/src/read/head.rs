//! The text of a record file, and the errors that name its lines.

use super::excerpt;
use super::number::{numbers_of_line, why_no_number};
use crate::error::MotionError;
use crate::recording::RecordFormat;

/// A record file while it is read.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// The file, for messages.
    pub(super) name: &'a str,
    /// The format it is read as.
    pub(super) format: RecordFormat,
}

impl Source<'_> {
    /// The head has no `key`.
    pub(super) fn lacks(&self, key: &'static str) -> MotionError {
        MotionError::HeaderLacks { name: self.name.to_owned(), format: self.format, key }
    }

    /// `key` cannot be read in `text` on `line` (counted from one); `expected` is an example.
    pub(super) fn unreadable(&self, line: usize, key: &'static str, text: &str, expected: &'static str) -> MotionError {
        MotionError::HeaderValue { name: self.name.to_owned(), line, key, text: excerpt(text), expected }
    }

    /// Appends the numbers of `text` on `line` (counted from one).
    pub(super) fn numbers(&self, line: usize, text: &str, values: &mut Vec<f64>) -> Result<(), MotionError> {
        numbers_of_line(text, values).map_err(|token| MotionError::Number {
            name: self.name.to_owned(),
            line,
            token: excerpt(token),
            reason: why_no_number(token),
        })
    }

    /// Refuses a number of values that is not the `declared` one.
    pub(super) fn check_count(&self, declared: u64, found: usize) -> Result<(), MotionError> {
        if found as u64 == declared {
            return Ok(());
        }
        Err(MotionError::PointCount { name: self.name.to_owned(), declared, found })
    }
}
