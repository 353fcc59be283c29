//! What a study file can have wrong, told with the place, the reason and the remedy.

use std::fmt;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use miette::{Diagnostic, LabeledSpan, NamedSource};

/// Where a mistake lies.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// In the study file.
    File {
        /// Bytes of the text, from zero, end excluded.
        span: Range<usize>,
        /// Line, from one.
        line: usize,
        /// Column in characters, from one.
        column: usize,
    },
    /// In an override of the command line, as given, without `--set`.
    Override(String),
    /// In the study as a whole: something is missing that has no place yet.
    Study,
}

/// One mistake of a study file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StudyMistake {
    /// The key as a dotted path with list positions from zero, e.g. `risk.poe[1]`; empty for a mistake of TOML syntax.
    pub key: String,
    /// Where it lies.
    pub place: Place,
    /// What is wrong, with the value and its unit.
    pub message: String,
    /// What to do about it.
    pub help: Option<String>,
}

impl fmt::Display for StudyMistake {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Place::Override(text) = &self.place {
            write!(formatter, "--set {text}: ")?;
        }
        if !self.key.is_empty() {
            write!(formatter, "{}: ", self.key)?;
        }
        formatter.write_str(&self.message)
    }
}

impl std::error::Error for StudyMistake {}

impl Diagnostic for StudyMistake {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        match &self.place {
            Place::File { span, .. } => {
                let label = LabeledSpan::underline(span.clone());
                Some(Box::new(std::iter::once(label)))
            }
            Place::Override(_) | Place::Study => None,
        }
    }
}

/// What the system says of a file, without its number.
pub(crate) fn in_words(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotADirectory => "a part of the path is a file, not a folder".to_owned(),
        _ => error.to_string().split(" (os error").next().unwrap_or_default().to_owned(),
    }
}

/// Why a study file cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Unreadable {
    /// The system does not give it.
    #[error("{}", in_words(.0))]
    System(#[from] std::io::Error),
    /// There is none.
    #[error("there is no such file: {advice}")]
    Missing {
        /// The file that was probably meant, or how to give one.
        advice: String,
    },
    /// It is a file of another kind.
    #[error("it is {found}, not {wanted}: {advice}")]
    Other {
        /// What it is.
        found: &'static str,
        /// What was to be read.
        wanted: &'static str,
        /// What takes such a file.
        advice: String,
    },
    /// It is text of two bytes a letter.
    #[error("it is UTF-16 text, which PowerShell and Notepad call Unicode: save it as UTF-8")]
    Utf16,
    /// There is no current directory that a relative path could start from.
    #[error("no current directory: {}", in_words(.0))]
    NoCurrentDirectory(std::io::Error),
    /// It is a folder.
    #[error("it is a folder: give a file, e.g. {}", example.display())]
    Folder {
        /// A file of the kind that is wanted: the one in the folder, if it has one.
        example: std::path::PathBuf,
    },
    /// It is a pipe or the like.
    #[error("it is not a file: give the name of a TOML file")]
    NotAFile,
    /// It is larger than what people write.
    #[error("it has more than {most_bytes} bytes; is it a study file?")]
    TooLarge {
        /// The largest size \[bytes\].
        most_bytes: u64,
    },
    /// It is not UTF-8 text.
    #[error("line {line} is not UTF-8 text; save it as UTF-8")]
    NotUtf8 {
        /// The first such line, from one.
        line: usize,
    },
}

/// Why a study cannot be run.
///
/// It is a [`miette::Diagnostic`]: every mistake is shown with its line and a caret below it.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[non_exhaustive]
pub enum StudyError {
    /// The file cannot be read.
    #[error("cannot read {file}: {reason}")]
    Unreadable {
        /// The file as given.
        file: String,
        /// The reason.
        reason: Unreadable,
    },
    /// The file is read, and holds mistakes.
    #[error("{file}: {}", count(mistakes.len(), *left_out))]
    Mistakes {
        /// The file as given.
        file: String,
        /// Its text; not within the error itself, which would be large.
        #[source_code]
        text: Arc<NamedSource<String>>,
        /// The mistakes: those in the file by position, then those of overrides, then the rest.
        #[related]
        mistakes: Vec<StudyMistake>,
        /// How many more there are that are not listed.
        left_out: usize,
    },
}

/// More mistakes than this are counted, not listed.
pub(crate) const MOST_LISTED: usize = 100;

fn count(listed: usize, left_out: usize) -> String {
    match (listed, left_out) {
        (1, 0) => "1 mistake".to_owned(),
        (listed, 0) => format!("{listed} mistakes"),
        (listed, left_out) => {
            format!("{} mistakes, the first {listed} are listed", listed + left_out)
        }
    }
}

impl StudyError {
    /// The file `file` cannot be read.
    pub(crate) fn unreadable(file: &Path, reason: Unreadable) -> Self {
        Self::Unreadable { file: file.display().to_string(), reason }
    }

    /// The `mistakes`, in order, of the study file named `file` with the contents `text`; so many more are `left_out`.
    pub(crate) fn from_mistakes(file: &Path, text: String, mistakes: Vec<StudyMistake>, left_out: usize) -> Self {
        let file = file.display().to_string();
        Self::Mistakes { text: Arc::new(NamedSource::new(&file, text)), file, mistakes, left_out }
    }

    /// The mistakes found; none where the file could not be read.
    pub fn mistakes(&self) -> &[StudyMistake] {
        match self {
            Self::Mistakes { mistakes, .. } => mistakes,
            Self::Unreadable { .. } => &[],
        }
    }
}
