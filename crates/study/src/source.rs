//! The study file as it is read, and the way from it to the resolved study.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::displacement::{self, DisplacementStudy};
use super::document::{Origin, Table};
use super::error::{MOST_LISTED, Place, StudyError, StudyMistake};
use super::overrides;
use super::paths::{Folders, tidy};
use super::reader::{Finding, Ledger, Section};
use super::resolve::{self, Kind};
use super::resolved::{Output, ResolvedStudy};

/// Largest study file \[bytes\]; one with 100 000 numbers written out has 2 MB.
const LARGEST_FILE: u64 = 4 << 20;

/// A study file that is TOML; what it says is not checked yet.
#[derive(Debug, Clone)]
pub struct Study {
    file: PathBuf,
    text: String,
    document: Table,
}

/// A resolved study of either kind.
#[derive(Debug, Clone, PartialEq)]
pub enum AnyStudy {
    /// Of uniform risk spectra.
    UniformRisk(Box<ResolvedStudy>),
    /// Of displacement spectra.
    Displacement(Box<DisplacementStudy>),
}

impl AnyStudy {
    /// What is written where.
    pub fn output(&self) -> &Output {
        match self {
            Self::UniformRisk(study) => &study.output,
            Self::Displacement(study) => &study.output,
        }
    }

    /// What is allowed but probably not meant.
    pub fn warnings(&self) -> &[String] {
        match self {
            Self::UniformRisk(study) => &study.warnings,
            Self::Displacement(study) => &study.warnings,
        }
    }

    /// The study as TOML, complete and loadable.
    ///
    /// # Errors
    /// Where TOML cannot hold a value; a study that was loaded has none such.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        match self {
            Self::UniformRisk(study) => study.to_toml(),
            Self::Displacement(study) => study.to_toml(),
        }
    }
}

impl Study {
    /// Reads the study file `file`, which must be of uniform risk spectra, applies the `overrides`, each `key=value`, and checks it
    /// all.
    ///
    /// # Errors
    ///
    /// [`StudyError`] with every mistake in the file and the overrides; those of TOML syntax come
    /// alone.
    pub fn load(file: &Path, overrides: &[String]) -> Result<ResolvedStudy, StudyError> {
        Self::read(file)?.resolve(overrides)
    }

    /// As [`load`](Self::load), for a study of either kind.
    ///
    /// # Errors
    ///
    /// As [`load`](Self::load).
    pub fn load_any(file: &Path, overrides: &[String]) -> Result<AnyStudy, StudyError> {
        Self::read(file)?.resolve_any(overrides)
    }

    /// Reads the study file `file`.
    ///
    /// # Errors
    ///
    /// [`StudyError`] where it cannot be read, or is no TOML.
    pub fn read(file: &Path) -> Result<Self, StudyError> {
        Self::parse(file, read_text(file)?)
    }

    /// Parses the `text` of a study file whose name is, or would be, `file`.
    ///
    /// # Errors
    ///
    /// [`StudyError`] where it is no TOML.
    pub fn parse(file: &Path, text: String) -> Result<Self, StudyError> {
        let document = parse_table(file, &text)?;
        Ok(Self { file: file.to_owned(), text, document })
    }

    /// Applies the `overrides`, each `key=value`, fills in the defaults and checks it all.
    ///
    /// # Errors
    ///
    /// [`StudyError`] with every mistake.
    pub fn resolve(self, overrides: &[String]) -> Result<ResolvedStudy, StudyError> {
        self.resolve_with(overrides, |mut root, ledger, folders, study_file| match resolve::kind(&mut root)? {
            Kind::UniformRisk => resolve::study(root, ledger, folders, study_file),
            Kind::Displacement => {
                if let Some(field) = root.field("kind") {
                    field.mistake(
                        "this study is of displacement spectra, and has no uniform risk spectra",
                        "`uplift check`, `run` and `status` take it, and `uplift table`, `plot` and `report` its result; for the rest a study of uniform risk is needed",
                    );
                }
                None
            }
        })
    }

    /// As [`resolve`](Self::resolve), for a study of either kind.
    ///
    /// # Errors
    ///
    /// [`StudyError`] with every mistake.
    pub fn resolve_any(self, overrides: &[String]) -> Result<AnyStudy, StudyError> {
        self.resolve_with(overrides, |mut root, ledger, folders, study_file| match resolve::kind(&mut root)? {
            Kind::UniformRisk => {
                resolve::study(root, ledger, folders, study_file).map(|study| AnyStudy::UniformRisk(Box::new(study)))
            }
            Kind::Displacement => displacement::study(root, ledger, folders, study_file)
                .map(|study| AnyStudy::Displacement(Box::new(study))),
        })
    }

    fn resolve_with<T>(
        mut self,
        overrides: &[String],
        read: impl FnOnce(Section<'_>, &Ledger, &Folders, &Path) -> Option<T>,
    ) -> Result<T, StudyError> {
        let unreadable = |error: std::io::Error| StudyError::Unreadable {
            file: self.file.display().to_string(),
            reason: format!("no current directory: {error}"),
        };
        let current = std::env::current_dir().map_err(unreadable)?;
        let study_file = tidy(&current.join(&self.file));
        let study_folder = study_file.parent().unwrap_or(&current).to_owned();
        let folders = Folders { study: study_folder, current };
        let ledger = Ledger::default();
        for (index, text) in overrides.iter().enumerate() {
            if let Err(finding) = overrides::apply(&mut self.document, index, text) {
                ledger.add(finding);
            }
        }
        let root = Section::root(&self.document, &ledger);
        let resolved = read(root, &ledger, &folders, &study_file);
        let findings = ledger.into_findings();
        match resolved {
            Some(study) if findings.is_empty() => Ok(study),
            _ => Err(refused(&self.file, self.text, findings, overrides)),
        }
    }
}

/// The text of the file `file`, if it is one that people write.
pub(super) fn read_text(file: &Path) -> Result<String, StudyError> {
    let unreadable = |reason: String| StudyError::Unreadable { file: file.display().to_string(), reason };
    let failed = |error: std::io::Error| unreadable(error.to_string());
    if !fs::metadata(file).map_err(failed)?.is_file() {
        return Err(unreadable("it is not a file".to_owned()));
    }
    let mut bytes = Vec::new();
    let opened = fs::File::open(file).map_err(failed)?;
    opened.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(unreadable(format!("it has more than {LARGEST_FILE} bytes; is it a study file?")));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = valid.split(|&byte| byte == b'\n').count();
        unreadable(format!("line {line} is not UTF-8 text; save it as UTF-8"))
    })
}

/// The text as TOML; the errors are those of its syntax.
pub(super) fn parse_table(file: &Path, text: &str) -> Result<Table, StudyError> {
    Table::parse(text).map_err(|mut errors| {
        errors.sort_by_key(|error| error.span().map(|span| span.start));
        let listed = errors.iter().take(MOST_LISTED).map(|error| StudyMistake {
            key: String::new(),
            place: place(text, error.span().unwrap_or_default()),
            message: format!("not TOML: {}", error.message()),
            help: Some(syntax_help(error.message()).to_owned()),
        });
        let listed: Vec<_> = listed.collect();
        let left_out = errors.len() - listed.len();
        StudyError::of_mistakes(file, text.to_owned(), listed, left_out)
    })
}

/// The `findings` in order, with their places in `text` and among the `overrides`.
pub(super) fn refused(file: &Path, text: String, mut findings: Vec<Finding>, overrides: &[String]) -> StudyError {
    findings.sort_by_key(|finding| match &finding.origin {
        Origin::File(span) => (0, span.start),
        Origin::Override(index) => (1, *index),
        Origin::Study => (2, 0),
    });
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
    StudyError::of_mistakes(file, text, listed, left_out)
}

/// What to do about a mistake of TOML syntax.
fn syntax_help(message: &str) -> &'static str {
    if message.contains("duplicate") {
        "each key and each [section] may stand once; write [[sites]] for one site more"
    } else {
        "put texts, paths and grids in double quotes, lists in [ ]"
    }
}

/// The bytes `span` of `text` with their line and column.
fn place(text: &str, span: std::ops::Range<usize>) -> Place {
    let before = text.get(..span.start).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    Place::File { line: 1 + before.matches('\n').count(), column: 1 + before[line_start..].chars().count(), span }
}
