//! The mistakes found so far, and their places.

use std::cell::RefCell;
use std::ops::Range;
use std::path::Path;

use super::Origin;
use crate::error::{MOST_LISTED, Place, StudyError, StudyMistake};

/// A mistake before its place is known as line and column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Finding {
    pub(crate) key: String,
    pub(crate) origin: Origin,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
}

/// The mistakes found so far; sections and fields share it while they are read.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    found: RefCell<Vec<Finding>>,
    /// Every key that was asked for, so that a test can compare them with the documentation.
    #[cfg(test)]
    pub(crate) asked: RefCell<std::collections::BTreeSet<String>>,
}

impl Findings {
    pub(crate) fn add(&self, finding: Finding) {
        self.found.borrow_mut().push(finding);
    }

    pub(crate) fn into_vec(self) -> Vec<Finding> {
        self.found.into_inner()
    }
}

/// The `findings` in order, with their places in `text` and among the `overrides`.
pub(crate) fn refused(file: &Path, text: String, mut findings: Vec<Finding>, overrides: &[String]) -> StudyError {
    findings.sort_by_key(|finding| finding.origin.place_in_list());
    let left_out = findings.len().saturating_sub(MOST_LISTED);
    let listed = findings.into_iter().take(MOST_LISTED).map(|finding| StudyMistake {
        key: finding.key,
        place: match finding.origin {
            Origin::File(span) => place(&text, span),
            Origin::Override(index) => overrides.get(index).map_or(Place::Study, |text| Place::Override(text.clone())),
            Origin::Study => Place::Study,
        },
        message: finding.message,
        help: finding.help,
    });
    let listed = listed.collect();
    StudyError::from_mistakes(file, text, listed, left_out)
}

/// The bytes `span` of `text` with their line and column.
pub(super) fn place(text: &str, span: Range<usize>) -> Place {
    let before = text.get(..span.start).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    Place::File { line: 1 + before.matches('\n').count(), column: 1 + before[line_start..].chars().count(), span }
}
