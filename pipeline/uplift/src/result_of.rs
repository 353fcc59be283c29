//! The result of a study: the one that is there if it is the study's, else the study is run.

use std::path::{Path, PathBuf};

use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::study_run::RunOptions;
use uplift_result::{ResultFile, replaces_another};
use uplift_study::{AnyStudy, UniformRiskStudy};

use crate::error::UpliftError;
use crate::finished::is_result_of;
use crate::run::run;

/// The result file of `study`; a study without one is run.
///
/// # Errors
/// Inputs that cannot be used; as [`run`].
pub fn result_of(study: &UniformRiskStudy, options: &RunOptions, events: &dyn Events) -> Result<PathBuf, UpliftError> {
    let path = options.result_file(&study.output.file);
    let of_kind = AnyStudy::UniformRisk(Box::new(study.clone()));
    if path.exists() && is_result_of(study, path)? {
        refuse_other_question(study, path)?;
        events.remark("result", &format!("{} is that of the study", path.display()));
    } else if let Some(reason) = replaces_another(&of_kind, options)? {
        let name = path.display();
        return Err(JobError::Usage(format!(
            "{reason}: give {name} in place of the study file, the --set values of that result, or --force to \
             overwrite it"
        ))
        .into());
    } else {
        events.remark("result", &format!("computing {} first", path.display()));
        run(&of_kind, options, events)?;
    }
    Ok(path.to_owned())
}

/// What the study asks of the consistency is in the result as it was run, and bands and repaired spectra are made of
/// it: other keys are another run, of the same peaks. Not `repair`, which adds to the file.
fn refuse_other_question(study: &UniformRiskStudy, path: &Path) -> Result<(), UpliftError> {
    let kept = ResultFile::open(path)?.stored_study()?.consistency;
    let differing = study.consistency.differing_keys(&kept);
    if differing.is_empty() {
        return Ok(());
    }
    Err(JobError::Usage(format!(
        "{} was run with other values of consistency.{}: run the study with these first (uplift run with the same \
         --set, some seconds), or give the result in place of the study",
        path.display(),
        differing.join(", consistency.")
    ))
    .into())
}
