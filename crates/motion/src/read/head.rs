//! The text of a record file, and the errors that name its lines.

use super::excerpt;
use super::number::{numbers_of_line, parse_number, why_no_number};
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

    /// Accelerations of a component follow, once.
    ///
    /// # Errors
    /// [`MotionError::HeaderLacks`] where the component `has_acceleration` already: whose these are is not known.
    pub(super) fn begin_acceleration(&self, has_acceleration: &mut bool) -> Result<(), MotionError> {
        if std::mem::replace(has_acceleration, true) {
            return Err(self.lacks("text above the accelerations of a further component"));
        }
        Ok(())
    }

    /// `key` cannot be read in `text` on `line` (counted from one); `expected` is an example.
    pub(super) fn unreadable(&self, line: usize, key: &'static str, text: &str, expected: &'static str) -> MotionError {
        MotionError::HeaderValue { name: self.name.to_owned(), line, key, text: excerpt(text), expected }
    }

    /// The unit that `text` on `line` (counted from one) names is not known.
    pub(super) fn unknown_unit(&self, line: usize, text: &str) -> MotionError {
        MotionError::HeaderUnit { name: self.name.to_owned(), line, text: excerpt(text) }
    }

    /// `token` on `line` (counted from one) is no number, for this reason.
    pub(super) fn no_number(&self, line: usize, token: &str, reason: &'static str) -> MotionError {
        MotionError::Number { name: self.name.to_owned(), line, token: excerpt(token), reason }
    }

    /// Appends the numbers of `text` on `line` (counted from one).
    pub(super) fn numbers(&self, line: usize, text: &str, values: &mut Vec<f64>) -> Result<(), MotionError> {
        numbers_of_line(text, values).map_err(|token| self.no_number(line, token, why_no_number(token)))
    }

    /// The numbers of `text` below the `head` lines, of which there must be as many as `declared`.
    pub(super) fn all_numbers(&self, text: &str, head: usize, declared: u64) -> Result<Vec<f64>, MotionError> {
        // Grows with what the file holds, never with what its head declares.
        let mut values = Vec::new();
        let mut lines = text.lines().enumerate().skip(head);
        while let Some((index, line)) = lines.next() {
            self.numbers(index + 1, line, &mut values).map_err(|error| match error {
                // the beginning of a number, and nothing below it
                MotionError::Number { name, line, token, .. }
                    if (values.len() as u64) < declared
                        && parse_number(&format!("{token}0")).is_some()
                        && lines.all(|(_, line)| line.trim().is_empty()) =>
                {
                    MotionError::CutNumber { name, line, token, found: values.len(), declared }
                }
                error => error,
            })?;
        }
        self.check_count(declared, values.len())?;
        Ok(values)
    }

    /// Refuses a number of values that is not the `declared` one.
    pub(super) fn check_count(&self, declared: u64, found: usize) -> Result<(), MotionError> {
        if found as u64 == declared {
            return Ok(());
        }
        Err(MotionError::PointCount { name: self.name.to_owned(), declared, found })
    }
}
