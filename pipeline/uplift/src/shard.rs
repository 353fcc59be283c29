//! A study of either kind shared among machines: one shard of it computed, and all of them joined into its result.

use std::path::{Path, PathBuf};

use uplift_engine::analysis::{ShardReport, hold, join};
use uplift_engine::checkpoint::FinishedRows;
use uplift_ida::Shard;
use uplift_inputs::read_hazard;
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::outputs::check_shard_name;
use uplift_job::study_run::RunOptions;
use uplift_studies::uniform_risk::site_table;
use uplift_studies::{displacement, uniform_risk};
use uplift_study::AnyStudy;

use crate::error::UpliftError;
use crate::run::{RunReport, check_outputs, check_replaced, run_with};

/// Carries out one shard of the analyses of a study into the file `path`, but for what is known from an `earlier`
/// result.
///
/// # Errors
/// A name that is not one of a shard; else as [`run`](crate::run()).
pub fn run_shard(
    study: &AnyStudy,
    path: &Path,
    shard: Shard,
    earlier: Option<&Path>,
    events: &dyn Events,
) -> Result<ShardReport, UpliftError> {
    check_shard_name(path)?;
    let _lock = hold(path)?;
    match study {
        AnyStudy::UniformRisk(study) => Ok(uniform_risk::run_shard(study, (path, shard), earlier, events)?),
        AnyStudy::Displacement(study) => Ok(displacement::run_shard(study, (path, shard), events)?),
        AnyStudy::ShakeTable(_) => Err(not_cut()),
    }
}

/// Looks at whatever of a study does not go into its shards, so that a mistake in it is found before they are computed.
///
/// # Errors
/// A result that cannot be written; hazard and sites that cannot be used.
pub fn check_inputs(study: &AnyStudy, options: &RunOptions, events: &dyn Events) -> Result<(), UpliftError> {
    check_outputs(study, options)?;
    check_replaced(study, options)?;
    match study {
        AnyStudy::UniformRisk(study) => {
            read_hazard(study)?;
            site_table::read(study, events)?;
        }
        AnyStudy::Displacement(_) | AnyStudy::ShakeTable(_) => {}
    }
    Ok(())
}

/// Joins the `shards` of a run into its result; or the results of the slices of its table of sites.
///
/// # Errors
/// Every shard or slice that is missing, there twice, unfinished or of other work, at once; else as
/// [`run`](crate::run()).
pub fn merge(
    study: &AnyStudy,
    shards: &[PathBuf],
    options: &RunOptions,
    events: &dyn Events,
) -> Result<RunReport, UpliftError> {
    let is_slice = |path: &&PathBuf| path.extension().is_some_and(|ending| ending == "h5");
    if let (Some(result), AnyStudy::UniformRisk(study_of_slices)) = (shards.iter().find(is_slice), study) {
        if !shards.iter().all(|path| is_slice(&path)) {
            let name = result.display();
            let words = format!("{name} is a result, and others are shards: give shards, or the results of slices");
            return Err(JobError::Usage(words).into());
        }
        let slices = site_table::sorted_slices(study_of_slices, shards)?;
        return run_with(study, &RunOptions { slices, ..options.clone() }, FinishedRows::default(), events);
    }
    let result = options.result_file(&study.output().file);
    let known = match study {
        AnyStudy::UniformRisk(study) => {
            let inputs = uniform_risk::Inputs::read(study, events)?;
            uniform_risk::needs(study, &inputs.records, None).with_rows_of(shards).require(result, events)?;
            join(shards, &inputs.work(study, &[])?)?
        }
        AnyStudy::Displacement(study) => {
            let inputs = displacement::Inputs::read(study, events)?;
            let sets = inputs.sets(study)?;
            displacement::needs(study, &inputs.records, &sets.motions).with_rows_of(shards).require(result, events)?;
            join(shards, &sets.work(study)?)?
        }
        AnyStudy::ShakeTable(_) => return Err(not_cut()),
    };
    events.remark("merged", &format!("{} analysis rows of {} shards", known.len(), shards.len()));
    run_with(study, options, known, events)
}

/// The tests of a shaking table take seconds.
fn not_cut() -> UpliftError {
    JobError::Usage("studies of a shaking table have no shards: run the study".to_owned()).into()
}
