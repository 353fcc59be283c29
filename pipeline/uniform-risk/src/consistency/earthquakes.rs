//! The earthquakes that the site's hazard is made of, beside those of the records.

use std::path::PathBuf;

use uplift_atomic_file::read_file;
use uplift_hazard::{Disaggregation, MAX_JSON_BYTES, read_disaggregation};
use uplift_job::JobError;

use super::Question;
use super::report::{ConsistencyRow, EarthquakeRow, TargetRow};
use crate::error::UniformRiskError;

/// How far a rate of a disaggregation may lie from that of a probability of the result.
const SAME_RATE: f64 = 0.01;

/// Reads the tables of sites, `[file]` of (position of the site, its disaggregations).
///
/// # Errors
/// A file that cannot be read as one; a site that the result does not have, or none where it has several.
pub fn disaggregated(
    question: &Question,
    files: &[(Option<String>, PathBuf)],
) -> Result<Vec<(usize, Vec<Disaggregation>)>, UniformRiskError> {
    let of_file = |(site, path): &(Option<String>, PathBuf)| {
        let known = match site {
            Some(name) => question.sites.iter().position(|site| site.eq_ignore_ascii_case(name)),
            None => (question.sites.len() == 1).then_some(0),
        };
        let at = known.ok_or_else(|| JobError::Choice {
            option: "--disaggregation SITE=FILE",
            noun: "site",
            wanted: site.clone(),
            known: question.sites.clone(),
        })?;
        let name = path.display().to_string();
        let bytes = read_file(path, MAX_JSON_BYTES).map_err(|error| JobError::input(error.to_string()))?;
        let text = String::from_utf8_lossy(&bytes);
        Ok((at, read_disaggregation(&text, &name)?))
    };
    files.iter().map(of_file).collect()
}

/// What the disaggregations say at the probabilities of the result, beside the records.
pub fn earthquakes(
    question: &Question,
    rows: &[ConsistencyRow],
    shaken: &[(usize, Vec<Disaggregation>)],
) -> Vec<EarthquakeRow> {
    let mut found = Vec::new();
    for row in rows {
        let own = shaken.iter().filter(|(site, _)| question.sites[*site] == row.site);
        let own: Vec<&Disaggregation> = own.flat_map(|(_, all)| all).filter(|one| one.is_of(row.scaled_to)).collect();
        for (index, target) in row.targets.iter().enumerate() {
            let rate = question.targets_per_year[index];
            let is_there = |one: &&&Disaggregation| (one.rate_per_year() / rate - 1.0).abs() < SAME_RATE;
            let Some(site) = own.iter().find(is_there) else { continue };
            let repaired: Option<&TargetRow> = row.repair.as_ref().and_then(|repair| repair.targets.get(index));
            found.push(EarthquakeRow {
                site: row.site.clone(),
                scaled_to: row.scaled_to,
                poe: target.poe,
                mean_magnitude: site.mean_magnitude,
                mean_distance_km: site.mean_distance_km,
                magnitude: target.magnitude,
                distance_km: target.distance_km,
                repaired_magnitude: repaired.and_then(|target| target.magnitude),
                repaired_distance_km: repaired.and_then(|target| target.distance_km),
            });
        }
    }
    found
}
