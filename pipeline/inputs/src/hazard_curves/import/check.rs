//! Whether the exports are of one site, whole, and of use to a study.

use std::collections::BTreeMap;

use uplift_hazard::{ExportedCurve, RealizationWeight, SiteSelection, Statistic};
use uplift_job::JobError;

use crate::error::InputsError;

/// How far apart two exports may have the same site, km.
const ONE_PLACE_KM: f64 = 1.0;

/// The weight of a realization; none of other statistics.
pub(super) fn weight_of(kind: &Statistic, weights: &BTreeMap<u32, RealizationWeight>) -> Option<f64> {
    match kind {
        Statistic::Realization(number) => weights.get(number).map(|weight| weight.weight),
        Statistic::Branch(path) => {
            weights.values().find(|weight| weight.branch_path == *path).map(|weight| weight.weight)
        }
        _ => None,
    }
}

/// Refuses weights of only some realizations of a measure.
pub(super) fn check_weights(
    curves: &[ExportedCurve],
    weights: &BTreeMap<u32, RealizationWeight>,
) -> Result<(), InputsError> {
    let mut sums: BTreeMap<&str, (f64, usize)> = BTreeMap::new();
    for curve in curves {
        if let Some(weight) = weight_of(&curve.kind, weights) {
            let sum = sums.entry(curve.curve.measure()).or_default();
            *sum = (sum.0 + weight, sum.1 + 1);
        }
    }
    match sums.iter().find(|(_, (sum, _))| (sum - 1.0).abs() > 1e-4) {
        Some((measure, (sum, count))) => Err(JobError::input(format!(
            "{measure}: {count} of {} realizations are given, and their weights add up to {sum:.4}: give the exports \
             of all realizations",
            weights.len()
        ))
        .into()),
        None => Ok(()),
    }
}

/// The name of the site that all curves belong to.
pub(super) fn one_site(curves: &[ExportedCurve], selection: &SiteSelection) -> Result<String, InputsError> {
    let Some(first) = curves.first() else {
        return Err(JobError::input("the export has no hazard curve").into());
    };
    let key = |curve: &ExportedCurve| {
        (curve.site.name.clone(), curve.site.longitude_deg.to_bits(), curve.site.latitude_deg.to_bits())
    };
    let mut sites: Vec<_> = curves.iter().map(key).collect();
    sites.sort();
    sites.dedup();
    // several engines write the same place with other digits
    let chosen = *selection != SiteSelection::All;
    if let (true, Some(other)) = (
        chosen,
        curves
            .iter()
            .find(|other| other.site.distance_km(first.site.longitude_deg, first.site.latitude_deg) > ONE_PLACE_KM),
    ) {
        return Err(JobError::input(format!(
            "the exports give two places for one site, {} and {}, {:.1} km apart: import them one by one, or give \
             exports of the same sites",
            first.site,
            other.site,
            other.site.distance_km(first.site.longitude_deg, first.site.latitude_deg)
        ))
        .into());
    }
    if sites.len() > 1 && !chosen {
        return Err(JobError::Usage(format!(
            "the exports hold {} sites: pick one by --near LON,LAT{}",
            sites.len(),
            if sites.iter().any(|(name, ..)| name.is_some()) { " or --name NAME" } else { "" }
        ))
        .into());
    }
    Ok(first.site.name.clone().unwrap_or_else(|| format!("{} {}", first.site.longitude_deg, first.site.latitude_deg)))
}
