//! What a job on a structure chooses of a result: site, measure, records.

use std::path::Path;

use uplift_inputs::RecordSet;
use uplift_job::JobError;
use uplift_motion::IntensityMeasure;
use uplift_uniform_risk::StudyOfResult;

use crate::error::DesignError;

/// Position of the site `wanted`; of the only one where none is.
pub(super) fn site_index(source: &StudyOfResult, wanted: Option<&str>) -> Result<usize, DesignError> {
    let found = match wanted {
        Some(wanted) => source.sites.iter().position(|site| site.eq_ignore_ascii_case(wanted)),
        None => (source.sites.len() == 1).then_some(0),
    };
    Ok(found.ok_or_else(|| JobError::Choice {
        option: "--site",
        wanted: wanted.map(str::to_owned),
        known: source.sites.clone(),
    })?)
}

/// Position of the measure `wanted`; of the first where none is, which is PGV if the result has it.
pub(super) fn measure_index(source: &StudyOfResult, wanted: Option<IntensityMeasure>) -> Result<usize, DesignError> {
    let found = match wanted {
        Some(wanted) => source.measures.iter().position(|measure| measure.measure() == wanted),
        None => (!source.measures.is_empty()).then_some(0),
    };
    Ok(found.ok_or_else(|| JobError::Choice {
        option: "--measure",
        wanted: wanted.map(|wanted| wanted.key().to_owned()),
        known: source.measures.iter().map(|measure| measure.measure().key().to_owned()).collect(),
    })?)
}

/// The records of the result; none where they cannot be read, with the reason, unless a manifest was given for them.
pub(super) fn records(
    source: &StudyOfResult,
    manifest: Option<&Path>,
) -> Result<Result<RecordSet, String>, DesignError> {
    match source.records() {
        Err(reason) if manifest.is_some() => Err(JobError::input(reason).into()),
        other => Ok(other),
    }
}
