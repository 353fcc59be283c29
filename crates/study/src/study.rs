//! The study file as it is read, and the ways from it to a resolved study.

use std::path::{Path, PathBuf};

use crate::error::{StudyError, Unreadable};
use crate::kind::{AnyStudy, Kind};
use crate::reading::findings::refused;
use crate::reading::letters::refuse_null_characters;
use crate::reading::other_file::Wanted;
use crate::reading::paths::tidy;
use crate::reading::text::{STANDARD_INPUT, input_text, parse_table, read_text};
use crate::reading::{Findings, Paths, Section, Table, overrides};
use crate::uniform_risk::{self, UniformRiskStudy};

/// What messages call a study that is no file of its own.
const STORED: &str = "the study in the result";

/// A study file that is TOML; what it says is not checked yet.
#[derive(Debug, Clone)]
pub struct Study {
    file: PathBuf,
    text: String,
    document: Table,
}

impl Study {
    /// Reads the study file `file`, which must be of uniform risk spectra, applies the `overrides`, each `key=value`,
    /// and checks it all.
    ///
    /// # Errors
    ///
    /// [`StudyError`] with every mistake in the file and the overrides; those of TOML syntax come alone.
    pub fn load(file: &Path, overrides: &[String]) -> Result<UniformRiskStudy, StudyError> {
        Self::read(file)?.resolve(overrides)
    }

    /// As [`load`](Self::load), for a study of any kind; the file `-` is standard input, and paths in it start from
    /// the current directory.
    ///
    /// # Errors
    ///
    /// As [`load`](Self::load).
    pub fn load_any(file: &Path, overrides: &[String]) -> Result<AnyStudy, StudyError> {
        Self::read_or_input(file, Wanted::Study)?.resolve_any(overrides)
    }

    /// As [`read`](Self::read), of what is `wanted`; the file `-` is standard input.
    pub(crate) fn read_or_input(file: &Path, wanted: Wanted) -> Result<Self, StudyError> {
        let text = if file == Path::new(STANDARD_INPUT) { input_text() } else { read_text(file, wanted) }?;
        let study = Self::parse(file, text)?;
        match wanted.refusal_of_table(&study.document) {
            Some(reason) => Err(StudyError::unreadable(file, reason)),
            None => Ok(study),
        }
    }

    /// The study of a result, from the text that [`AnyStudy::to_toml`] made of it.
    ///
    /// It is read and checked as a study file is, but for its paths: they are taken as they stand, and nothing needs to
    /// be there any more. Whoever reads the records or curves finds out.
    ///
    /// # Errors
    ///
    /// [`StudyError`] with every mistake.
    pub fn stored(text: &str) -> Result<AnyStudy, StudyError> {
        Self::parse(Path::new(STORED), text.to_owned())?.checked(&[], &Paths::AsWritten, AnyStudy::read)
    }

    /// Reads the study file `file`.
    ///
    /// # Errors
    ///
    /// [`StudyError`] where it cannot be read, is no TOML, or is a structure or a library.
    pub fn read(file: &Path) -> Result<Self, StudyError> {
        Self::read_or_input(file, Wanted::Study)
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
    /// [`StudyError`] with every mistake; a study of another kind is one.
    pub fn resolve(self, overrides: &[String]) -> Result<UniformRiskStudy, StudyError> {
        let paths = self.checked_paths()?;
        self.checked(overrides, &paths, |mut root, paths| match Kind::read(&mut root)? {
            Kind::UniformRisk => uniform_risk::read(root, paths),
            other @ (Kind::Displacement | Kind::ShakeTable) => root.field("kind")?.refuse(
                format!("this study is of {}, and has no {}", other.key(), Kind::UniformRisk.key()),
                "use `uplift check`, `run` and `status`, and `uplift table`, `plot` and `report` on its result; other \
                 commands need a study of uniform risk",
            ),
        })
    }

    /// As [`resolve`](Self::resolve), for a study of any kind.
    ///
    /// # Errors
    ///
    /// [`StudyError`] with every mistake.
    pub fn resolve_any(self, overrides: &[String]) -> Result<AnyStudy, StudyError> {
        self.resolve_by(overrides, AnyStudy::read)
    }

    /// As [`resolve`](Self::resolve), for a file whose sections `read` reads.
    pub(crate) fn resolve_by<T>(
        self,
        overrides: &[String],
        read: impl FnOnce(Section<'_>, &Paths) -> Option<T>,
    ) -> Result<T, StudyError> {
        let paths = self.checked_paths()?;
        self.checked(overrides, &paths, read)
    }

    fn checked_paths(&self) -> Result<Paths, StudyError> {
        let current = std::env::current_dir()
            .map_err(|error| StudyError::unreadable(&self.file, Unreadable::NoCurrentDirectory(error)))?;
        Ok(Paths::Checked { study_file: tidy(&current.join(&self.file)), current })
    }

    /// What `read` makes of the document with its `overrides`, unless anything is wrong.
    fn checked<T>(
        mut self,
        overrides: &[String],
        paths: &Paths,
        read: impl FnOnce(Section<'_>, &Paths) -> Option<T>,
    ) -> Result<T, StudyError> {
        let findings = Findings::default();
        for (index, text) in overrides.iter().enumerate() {
            if let Err(finding) = overrides::apply(&mut self.document, index, text) {
                findings.add(finding);
            }
        }
        if matches!(paths, Paths::Checked { .. }) {
            refuse_null_characters(&self.document, "", &findings);
        }
        let resolved = read(Section::root(&self.document, &findings), paths);
        let findings = findings.into_vec();
        match resolved {
            Some(study) if findings.is_empty() => Ok(study),
            _ => Err(refused(&self.file, self.text, findings, overrides)),
        }
    }
}
