//! A small study to start from, with hazard curves of a site; its records are made by the program.

use std::path::{Path, PathBuf};

use uplift_job::table::write_atomically;
use uplift_job::{JobError, outputs};

use crate::error::UpliftError;

/// The files of the study, the study first: name and content.
const FILES: [(&str, &str); 3] = [
    ("study.toml", include_str!("init/study.toml")),
    ("hazard/athens-pgv.csv", include_str!("../../../hazard/athens/pgv.csv")),
    ("hazard/athens-pga.csv", include_str!("../../../hazard/athens/pga.csv")),
];

/// Writes the study into `folder`, and says which files these are.
///
/// # Errors
/// A file that is there already, or that cannot be written.
pub fn init(folder: &Path) -> Result<Vec<PathBuf>, UpliftError> {
    let files = FILES.map(|(name, content)| (folder.join(name), content));
    if let Some((file, _)) = files.iter().find(|(file, _)| file.exists()) {
        let file = file.display();
        return Err(JobError::Usage(format!("{file} exists and is not overwritten: name another folder")).into());
    }
    for (file, content) in &files {
        outputs::provide_folder(file.parent().unwrap_or(folder))?;
        write_atomically(file, content.as_bytes())?;
    }
    Ok(files.map(|(file, _)| file).into())
}
