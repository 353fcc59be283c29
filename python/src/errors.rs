//! What the crates refuse, as Python's exceptions: `OSError` for a file that cannot be read, else `ValueError`.

use std::fmt::Display;
use std::fs::File;
use std::io;
use std::path::Path;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_hazard::HazardError;
use uplift_motion::MotionError;
use uplift_plausible::{Implausible, Range};
use uplift_study::{Place, StudyError, Unreadable};

/// `ValueError` with the message of a crate.
pub(crate) fn refused(error: impl Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// What is wrong with a record or its file.
pub(crate) fn from_motion(error: MotionError) -> PyErr {
    match &error {
        MotionError::Unreadable { reason, .. } => io::Error::new(reason.kind(), error.to_string()).into(),
        _ => refused(error),
    }
}

/// What is wrong with the hazard curves of the file at `path`.
pub(crate) fn from_hazard_file(error: HazardError, path: &Path) -> PyErr {
    let unreadable = match &error {
        HazardError::File { .. } if path.is_dir() => Some(io::ErrorKind::IsADirectory),
        HazardError::File { .. } => File::open(path).err().map(|reason| reason.kind()),
        _ => None,
    };
    unreadable.map_or_else(|| refused(&error), |kind| io::Error::new(kind, error.to_string()).into())
}

/// What is wrong with a structure: `StudyError` of the package with all mistakes, or `OSError`.
pub(crate) fn from_study(py: Python<'_>, error: &StudyError) -> PyErr {
    let StudyError::Unreadable { reason, .. } = error else {
        return from_mistakes(py, error).unwrap_or_else(|failure| failure);
    };
    let kind = match reason {
        Unreadable::System(system) => system.kind(),
        Unreadable::Missing { .. } => io::ErrorKind::NotFound,
        Unreadable::NotAFile => io::ErrorKind::IsADirectory,
        _ => return refused(error),
    };
    io::Error::new(kind, error.to_string()).into()
}

fn from_mistakes(py: Python<'_>, error: &StudyError) -> PyResult<PyErr> {
    let module = PyModule::import(py, "uplift_urs._program")?;
    let mistakes = error.mistakes().iter().map(|mistake| {
        let (line, column) = match &mistake.place {
            Place::File { line, column, .. } => (Some(*line), Some(*column)),
            Place::Override(_) | Place::Study => (None, None),
        };
        let (message, key, help) = (&mistake.message, &mistake.key, &mistake.help);
        module.getattr("Mistake")?.call1((message, key, line, column, None::<&str>, help))
    });
    let mistakes = mistakes.collect::<PyResult<Vec<_>>>()?;
    Ok(PyErr::from_value(module.getattr("StudyError")?.call1((error.to_string(), mistakes))?))
}

/// Refuses numbers that no system, record or person means, all of them at once: the range of each, its name, and the
/// number where it is given.
pub(crate) fn check_plausible(given: &[(Range, &'static str, Option<f64>)]) -> PyResult<()> {
    let of = |(range, name, value): &(Range, &'static str, Option<f64>)| range.check(name, (*value)?).err();
    let mistakes: Vec<String> = given.iter().filter_map(of).map(|mistake: Implausible| mistake.to_string()).collect();
    if mistakes.is_empty() { Ok(()) } else { Err(refused(mistakes.join("; "))) }
}
