//! What is reported, for a program that started this one: a line of JSON for each event (docs/commands.md).

use std::error::Error;
use std::io::{self, Write};

use serde::Serialize;
use uplift::{JobError, UpliftError, root};
use uplift_atomic_file::FileError;
use uplift_labelled::LabelledError;
use uplift_study::{Place, StudyError, StudyMistake, Unreadable};

use super::visible::visible_json;
use crate::error::CommandError;

/// One line; `event` is its kind.
#[derive(Serialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
pub(super) enum Event<'a> {
    /// A fact on the way, its topic in a word.
    Remark { topic: &'a str, text: &'a str },
    /// What whoever uses the numbers should know.
    Note { text: &'a str },
    /// Any other line that people are reported.
    Line { text: &'a str },
    /// A phase of known length begins.
    Begin { label: &'a str, unit: &'static str, total: u64 },
    /// So much of it is done.
    Advance { done: u64, total: u64 },
    /// It is over, done or not.
    End { done: u64, total: u64 },
    /// What is finished is in this file from now on.
    Checkpoint { path: &'a str },
    /// The command ends with this error.
    Error {
        exit_code: u8,
        kind: &'static str,
        message: String,
        /// What the system says of a file: `not found`, `permission denied`, …
        #[serde(skip_serializing_if = "Option::is_none")]
        reason: Option<&'static str>,
        /// All mistakes that were found, where there can be several.
        mistakes: Vec<Mistake<'a>>,
    },
}

/// One of several mistakes.
#[derive(Serialize)]
pub(super) struct Mistake<'a> {
    #[serde(skip_serializing_if = "str::is_empty")]
    key: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    /// What was given to `--set`, where the mistake is there.
    #[serde(rename = "override", skip_serializing_if = "Option::is_none")]
    given: Option<&'a str>,
    message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<&'a str>,
}

impl Event<'_> {
    /// Writes the line to standard error, in one piece; where nobody listens any more it is lost.
    pub(super) fn tell(&self) {
        if let Ok(text) = serde_json::to_string(self) {
            let line = visible_json(&text) + "\n";
            let _ = io::stderr().lock().write_all(line.as_bytes());
        }
    }
}

impl<'a> Event<'a> {
    /// How a command ends that was stopped.
    pub(super) fn interrupted(exit_code: u8, message: String) -> Self {
        Self::Error { exit_code, kind: "interrupted", message, reason: None, mistakes: Vec::new() }
    }

    /// How a command ends that fails.
    pub(super) fn from_error(error: &'a CommandError) -> Self {
        let file = match error {
            CommandError::Uplift(error) => file_reason(error),
            _ => None,
        };
        let kind = match (error.exit_code(), file) {
            (2, _) => "usage",
            (5, _) => "interrupted",
            (_, Some(_)) => "file",
            (3, _) => "study",
            _ => "input",
        };
        let mistakes = match error {
            CommandError::Uplift(error) => mistakes(error),
            _ => Vec::new(),
        };
        Self::Error { exit_code: error.exit_code(), kind, message: error.to_string(), reason: file, mistakes }
    }
}

/// All that was found, where an error has several mistakes.
fn mistakes(error: &UpliftError) -> Vec<Mistake<'_>> {
    let of = |message: String| Mistake { key: "", line: None, column: None, given: None, message, help: None };
    if let UpliftError::Variants(mistakes) = error {
        return mistakes.iter().cloned().map(of).collect();
    }
    let root = innermost(error);
    if let Some(error) = root.downcast_ref::<StudyError>() {
        return error.mistakes().iter().map(in_study).collect();
    }
    match root.downcast_ref() {
        Some(JobError::Inputs(mistakes) | JobError::Room(mistakes)) => mistakes.iter().cloned().map(of).collect(),
        Some(JobError::Implausible(mistakes)) => mistakes.iter().map(|mistake| of(mistake.to_string())).collect(),
        _ => error.blocks().iter().map(|mistake| of(mistake.to_string())).collect(),
    }
}

fn in_study(mistake: &StudyMistake) -> Mistake<'_> {
    let (line, column, given) = match &mistake.place {
        Place::File { line, column, .. } => (Some(*line), Some(*column), None),
        Place::Override(text) => (None, None, Some(text.as_str())),
        Place::Study => (None, None, None),
    };
    let (key, message, help) = (mistake.key.as_str(), mistake.message.clone(), mistake.help.as_deref());
    Mistake { key, line, column, given, message, help }
}

/// Why the system does not give or take a file; none where it is not the system.
fn file_reason(error: &UpliftError) -> Option<&'static str> {
    let of_file = |error: &FileError| match error {
        FileError::Io { source, .. } => in_words(source),
        FileError::NotAFile { .. } => "not a file",
        FileError::TooLarge { .. } => "too large",
    };
    let root = innermost(error);
    if let Some(JobError::File(error) | JobError::Labelled(LabelledError::File(error))) = root.downcast_ref() {
        return Some(of_file(error));
    }
    match root.downcast_ref() {
        Some(StudyError::Unreadable { reason, .. }) => match reason {
            Unreadable::System(error) | Unreadable::NoCurrentDirectory(error) => Some(in_words(error)),
            Unreadable::Missing { .. } => Some("not found"),
            Unreadable::NotAFile => Some("not a file"),
            _ => None,
        },
        _ => None,
    }
}

/// What is at fault, in whichever file it is.
fn innermost(error: &UpliftError) -> &(dyn Error + 'static) {
    let mut found = error.root();
    while let Some(JobError::InFile { source, .. }) = found.downcast_ref() {
        found = root(&**source);
    }
    found
}

fn in_words(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::NotFound => "not found",
        io::ErrorKind::PermissionDenied => "permission denied",
        io::ErrorKind::IsADirectory => "not a file",
        io::ErrorKind::StorageFull => "no room",
        _ => "other",
    }
}
