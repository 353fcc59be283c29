//! Paths of a study: found, made absolute, checked; or taken as they stand.

use std::fs;
use std::path::{Path, PathBuf};

use super::suggestion::did_you_mean_file;
use super::text::{BACKSLASH, STANDARD_INPUT};
use super::{Field, Origin};
use crate::error::in_words;

/// What becomes of the paths in a study.
#[derive(Debug, Clone)]
pub(crate) enum Paths {
    /// Those of a study that is to be run: made absolute, and the files that are read must be there.
    Checked {
        /// The study file, absolute; paths in it start from its folder.
        study_file: PathBuf,
        /// The current directory: for paths on the command line.
        current: PathBuf,
    },
    /// Those of a study that was run: they were checked then, and its files may be elsewhere or gone.
    AsWritten,
}

impl Paths {
    /// The path that `field` names; absolute unless it is taken as it stands.
    fn named(&self, field: &Field<'_>) -> Option<PathBuf> {
        let text = field.filled_text()?;
        let path = match self {
            Self::Checked { study_file, current } => {
                let folder = match field.node.origin {
                    Origin::File(_) | Origin::Study => study_file.parent().unwrap_or(current),
                    Origin::Override(_) => current,
                };
                tidy(&folder.join(text))
            }
            Self::AsWritten => return Some(PathBuf::from(text)),
        };
        if path.to_str().is_none() {
            return field.refuse(
                format!("the path {} is not Unicode text", path.display()),
                "rename the folder, or give an absolute path without it",
            );
        }
        Some(path)
    }

    /// The path of the input file that `field` names, which must be readable.
    pub(crate) fn input(&self, field: &Field<'_>) -> Option<PathBuf> {
        let path = self.named(field)?;
        if matches!(self, Self::AsWritten) {
            return Some(path);
        }
        let from = match field.node.origin {
            Origin::File(_) | Origin::Study => "the folder of the study file",
            Origin::Override(_) => "the current directory",
        };
        let is_folder = path.is_dir();
        let reason = match fs::metadata(&path) {
            Ok(_) if is_folder => "this is a folder".to_owned(),
            // Opening what is no file, a pipe for one, may wait forever.
            Ok(metadata) if !metadata.is_file() => "this is not a file".to_owned(),
            Ok(_) => match fs::File::open(&path) {
                Ok(_) => return Some(path),
                Err(error) => format!("cannot open the file: {}", in_words(&error)),
            },
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => "file not found".to_owned(),
            Err(error) => format!("cannot find the file: {}", in_words(&error)),
        };
        // "C:\temp\new.csv" in double quotes is TOML, with a tab and the end of a line in it
        let meant = || did_you_mean_file(&path, path.extension()?.to_str()?);
        let backslash = path.to_string_lossy().contains(char::is_control);
        let help = if backslash {
            BACKSLASH.to_owned()
        } else if is_folder {
            "give a file; a manifest of a folder of records: uplift records import FOLDER -o records.csv".to_owned()
        } else {
            meant().unwrap_or_else(|| format!("give an existing file; a relative path starts from {from}"))
        };
        field.refuse(format!("{reason}: {}", path.display()), help)
    }

    /// The path of the file that `field` names, which is to be written and is none of the `inputs`.
    pub(crate) fn output<'a>(&self, field: &Field<'_>, mut inputs: impl Iterator<Item = &'a Path>) -> Option<PathBuf> {
        let path = self.named(field)?;
        let Self::Checked { study_file, .. } = self else { return Some(path) };
        if path.is_dir() {
            return field.refuse(
                format!("this is a folder: {}", path.display()),
                "give the name of the result file in it, e.g. results/study.h5",
            );
        }
        if path == *study_file || inputs.any(|input| input == path) {
            field.mistake(
                format!("the results would overwrite an input: {}", path.display()),
                "give the result file a name of its own, e.g. results/study.h5",
            );
        } else if path.extension().is_none_or(|extension| extension != "h5") {
            field.mistake(
                format!("the result is an HDF5 file, but this name says otherwise: {}", path.display()),
                "give it a name that ends in .h5, e.g. results/study.h5",
            );
        }
        Some(path)
    }

    /// The result file of a study that names none: in the current directory, by the name of the study file.
    pub(crate) fn default_output(&self) -> PathBuf {
        match self {
            Self::Checked { study_file, current } => {
                let stem = study_file.file_stem().filter(|stem| *stem != STANDARD_INPUT);
                let mut name = stem.unwrap_or("study".as_ref()).to_owned();
                name.push(".h5");
                tidy(&current.join("results").join(name))
            }
            Self::AsWritten => PathBuf::from("study.h5"),
        }
    }
}

/// The path without `.` and `..`, as far as its folders exist; a link in the last place stays.
pub(crate) fn tidy(path: &Path) -> PathBuf {
    match (path.parent(), path.file_name()) {
        (Some(parent), Some(name)) => {
            let folder = fs::canonicalize(parent).unwrap_or_else(|_| tidy(parent));
            folder.join(name)
        }
        _ => path.to_owned(),
    }
}
