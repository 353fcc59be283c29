//! Displacements of a result at any strength and return period, with what to know before they are used.

use std::path::Path;

use serde::Serialize;
use uplift_alarms::{Scope, alarms_of};
use uplift_job::alarm::Alarm;
use uplift_result::ResultFile;
use uplift_uniform_risk::{DisplacementOptions, DisplacementReport, at, displacements, site_index};

use crate::error::UpliftError;

/// Displacements with their confidence bands, and the warnings of what was asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpectrumReport {
    /// The displacements.
    #[serde(flatten)]
    pub found: DisplacementReport,
    /// What to know before using them, the worst first.
    pub alarms: Vec<Alarm>,
}

/// The displacements that a structure must survive, read off the result at `path` for the strengths and risks asked
/// for.
///
/// # Errors
/// A file that is missing, damaged, of another kind, or without sites; strengths, risks, sites or a measure that it
/// does not have.
pub fn spectrum(path: &Path, asked: &DisplacementOptions) -> Result<SpectrumReport, UpliftError> {
    let file = at(ResultFile::open(path)?, &asked.risk)?;
    let found = displacements(&file, asked)?;
    let site = match &asked.sites[..] {
        [only] => Some(site_index(&file.axes()?.sites, only)?),
        _ => None,
    };
    let alarms = alarms_of(&file, &Scope { site, measure: Some(found.measure), ..Scope::default() })?;
    Ok(SpectrumReport { found, alarms })
}
