//! Displacements of a result at any strength and return period, with what to know before they are used.

use std::path::Path;

use serde::Serialize;
use uplift_alarms::{BELOW_FIRST_LEVEL, BEYOND_LAST_LEVEL, FEW_EFFECTIVE_RECORDS, Scope, alarms_of, number_alarms};
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_plausible::USUAL_CAPACITY;
use uplift_result::ResultFile;
use uplift_uniform_risk::{
    DisplacementOptions, DisplacementReport, TargetRisks, at_target_risks, displacements, site_index,
};

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

/// The displacements that a structure must accommodate, read off the result at `path` for the strengths and risks asked
/// for.
///
/// # Errors
/// A file that is missing, damaged, of another kind, or without sites; strengths, risks, sites or a measure that it
/// does not have; repaired spectra where no site has one.
pub fn spectrum(path: &Path, asked: &DisplacementOptions) -> Result<SpectrumReport, UpliftError> {
    let file = at_target_risks(ResultFile::open(path)?, &asked.risk)?;
    let found = displacements(&file, asked)?;
    if found.repaired && found.displacements.iter().all(|own| own.u_m.is_nan()) {
        return Err(JobError::Usage(format!(
            "--repaired: no weights repair the records by {}: use the spectrum without --repaired, and see which \
             records are missing: uplift consistency {} --details",
            found.measure.label(),
            path.display()
        ))
        .into());
    }
    let axes = file.axes()?;
    let site = match &asked.sites[..] {
        [only] => Some(site_index("--site", &axes.sites, only)?),
        _ => None,
    };
    let strengths = between(&axes.strengths, &asked.strengths);
    let (measure, repaired) = (Some(found.measure), found.repaired);
    let mut printed = found.displacements.iter().map(|own| own.poe);
    let only = printed.next().filter(|first| printed.all(|other| other == *first));
    let poe = axes.poes.iter().position(|own| Some(*own) == only);
    let mut alarms = alarms_of(&file, &Scope { site, measure, poe, strengths, repaired, for_design: false })?;
    // of risks asked for, what the printed numbers rest on comes before what is true of the whole set
    if asked.risk != TargetRisks::default() {
        let of_numbers = [FEW_EFFECTIVE_RECORDS, BEYOND_LAST_LEVEL, BELOW_FIRST_LEVEL];
        alarms.sort_by_key(|alarm| (alarm.severity, !of_numbers.contains(&alarm.kind)));
    }
    let unlikely = number_alarms("spectrum", &[(USUAL_CAPACITY, "--capacity-m", asked.capacity_m)]);
    Ok(SpectrumReport { found, alarms: [unlikely, alarms].concat() })
}

/// The `known` strengths, in rising order, between which the `asked` ones are read; none where none are asked for.
fn between(known: &[f64], asked: &[f64]) -> Option<(f64, f64)> {
    let least = asked.iter().copied().min_by(f64::total_cmp)?;
    let most = asked.iter().copied().max_by(f64::total_cmp)?;
    let below = known.iter().rev().find(|strength| **strength <= least);
    let above = known.iter().find(|strength| **strength >= most);
    Some((*below.unwrap_or(&least), *above.unwrap_or(&most)))
}

#[cfg(test)]
mod tests {
    use super::between;

    #[test]
    fn strengths_are_read_between_their_neighbours() {
        let known = [0.0, 0.1, 0.2, 0.4];
        assert_eq!(between(&known, &[]), None);
        assert_eq!(between(&known, &[0.13]), Some((0.1, 0.2)));
        assert_eq!(between(&known, &[0.3, 0.1]), Some((0.1, 0.4)));
        assert_eq!(between(&known, &[0.5]), Some((0.4, 0.5)));
    }
}
