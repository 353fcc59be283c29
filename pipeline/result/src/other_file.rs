//! What is there in place of a result.

use std::io::ErrorKind;
use std::path::Path;

use uplift_atomic_file::FileError;
use uplift_job::JobError;
use uplift_job::lock::ResultLock;
use uplift_labelled::LabelledError;
use uplift_study::{Structure, Study, did_you_mean_file};

use crate::error::ResultError;

/// What to say where the file at `path` cannot be opened as a result.
pub(super) fn no_result(path: &Path, error: LabelledError) -> ResultError {
    let name = path.display();
    let ends = |ending: &str| path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending));
    let told = match &error {
        LabelledError::File(FileError::Io { source, .. }) if source.kind() == ErrorKind::NotFound => {
            let mut checkpoint = path.as_os_str().to_owned();
            checkpoint.push(".part");
            Some(if let Some(holder) = ResultLock::holder(path) {
                format!("{holder} is computing it now; `uplift status {name}` shows how far it is")
            } else if Path::new(&checkpoint).exists() {
                format!("its run was interrupted: repeat it to resume it; `uplift status {name}` shows how far it is")
            } else {
                let advice = "`uplift run STUDY.toml` writes results, results/STUDY.h5 by default";
                format!("there is no such file: {}", did_you_mean_file(path, "h5").unwrap_or_else(|| advice.to_owned()))
            })
        }
        LabelledError::NotHdf5 { .. } if ends("toml") && Study::read(path).is_ok() => {
            return JobError::input(format!("{name}: is a study, not a result: {}", its_result(path))).into();
        }
        LabelledError::NotHdf5 { .. } if ends("toml") => Some(if Structure::load(path).is_ok() {
            "is a structure, not a result: `uplift design` and `overturning` take it, with --urs RESULT".to_owned()
        } else {
            "is a text file, not a result: give the .h5 file that `uplift run` wrote".to_owned()
        }),
        LabelledError::NotHdf5 { .. } if ends("part") => Some(format!(
            "holds the finished part of a command that was interrupted, and is no result: repeat the command to resume \
             it; `uplift status {name}` shows how far it is"
        )),
        LabelledError::NotHdf5 { .. } if ends("csv") => {
            Some("is a table, not a result: give the .h5 file beside it, which `uplift run` wrote".to_owned())
        }
        _ => None,
    };
    told.map_or_else(|| error.into(), |told| JobError::input(format!("{name}: {told}"))).into()
}

/// Which file is the result of the `study`, and what to type where there is none.
fn its_result(study: &Path) -> String {
    let shown = |path: &Path| {
        let folder = std::env::current_dir().ok();
        folder.and_then(|folder| path.strip_prefix(folder).ok()).unwrap_or(path).display().to_string()
    };
    let compute = format!("run `uplift run {}` first", study.display());
    match Study::load_any(study, &[]).map(|study| study.output().file.clone()) {
        Ok(result) if result.is_file() => format!("give its result, {}", shown(&result)),
        Ok(result) => format!("{compute}, and give {}", shown(&result)),
        Err(_) => compute,
    }
}
