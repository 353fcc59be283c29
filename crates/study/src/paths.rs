//! Paths of a study: found, made absolute, checked.

use std::fs;
use std::path::{Path, PathBuf};

use super::document::Origin;
use super::reader::Field;

/// The folders that relative paths start from.
#[derive(Debug, Clone)]
pub(super) struct Folders {
    /// The folder of the study file: for paths in it.
    pub(super) study: PathBuf,
    /// The current directory: for paths on the command line.
    pub(super) current: PathBuf,
}

impl Folders {
    /// The absolute path that `field` names.
    pub(super) fn absolute(&self, field: &Field<'_>) -> Option<PathBuf> {
        let text = field.filled_text()?;
        let folder = match field.node.origin {
            Origin::File(_) | Origin::Study => &self.study,
            Origin::Override(_) => &self.current,
        };
        let path = tidy(&folder.join(text));
        if path.to_str().is_none() {
            field.mistake(
                format!("the path {} is not Unicode text", path.display()),
                "rename the folder, or give an absolute path without it",
            );
            return None;
        }
        Some(path)
    }

    /// The absolute path of the input file that `field` names, which must be readable.
    pub(super) fn input(&self, field: &Field<'_>) -> Option<PathBuf> {
        let path = self.absolute(field)?;
        let from = match field.node.origin {
            Origin::File(_) | Origin::Study => "the folder of the study file",
            Origin::Override(_) => "the current directory",
        };
        let reason = match fs::metadata(&path) {
            // Opening what is no file, a pipe for one, may wait forever.
            Ok(metadata) if !metadata.is_file() => "this is not a file".to_owned(),
            Ok(_) => match fs::File::open(&path) {
                Ok(_) => return Some(path),
                Err(error) => format!("cannot open the file: {error}"),
            },
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => "file not found".to_owned(),
            Err(error) => format!("cannot find the file: {error}"),
        };
        field.mistake(
            format!("{reason}: {}", path.display()),
            format!("give an existing file; a relative path starts from {from}"),
        );
        None
    }

    /// The absolute path of the file that `field` names, which is to be written.
    pub(super) fn output(&self, field: &Field<'_>) -> Option<PathBuf> {
        let path = self.absolute(field)?;
        if path.is_dir() {
            field.mistake(
                format!("this is a folder: {}", path.display()),
                "give the name of the result file in it, e.g. results/study.h5",
            );
            return None;
        }
        Some(path)
    }
}

/// The path without `.` and `..`, as far as its folders exist; a link in the last place stays.
pub(super) fn tidy(path: &Path) -> PathBuf {
    match (path.parent(), path.file_name()) {
        (Some(parent), Some(name)) => {
            let folder = fs::canonicalize(parent).unwrap_or_else(|_| tidy(parent));
            folder.join(name)
        }
        _ => path.to_owned(),
    }
}
