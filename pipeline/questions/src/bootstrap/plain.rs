//! The bands of spectra of records that count alike: the bootstrap over records (Section 4.5).

use rayon::prelude::*;
use uplift_bootstrap::{Band, Replicates, ResamplingPlan, simultaneous_bands, without_each};
use uplift_job::Array;
use uplift_result::{InferredBands, MeasureBands};
use uplift_risk::StripeWeights;
use uplift_uniform_risk::{StoredMeasure, StoredStripes};

use super::bands::{BandSettings, spectra_bands};
use super::joint::{joint_bands, joint_from_draws};
use crate::error::QuestionsError;

/// The bands of one strength.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StrengthBands {
    /// Over `[site, poe, size]`; after these the joint ones over `[site with branches, poe, size]`.
    pub(super) bands: Vec<Band>,
    /// All replicates over `[site, poe, size, replicate]`, m, where whole spectra are wanted.
    pub(super) replicates_m: Vec<f64>,
}

/// The bands of the strength at `index`.
pub(super) fn bands_of_strength(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    index: usize,
    plan: &ResamplingPlan,
    settings: &BandSettings,
) -> Result<StrengthBands, QuestionsError> {
    let demand = measure.demand(index)?;
    let targets = &stored.targets_per_year;
    let BandSettings { confidence, interval, .. } = *settings;
    let left_out = interval.left_out(plan)?;
    let mut done = StrengthBands { bands: Vec::new(), replicates_m: Vec::new() };
    for (site, weights) in measure.weights.iter().enumerate() {
        let sites: [&StripeWeights; 1] = [weights];
        let replicates = Replicates::from_plan(&demand, &sites, targets, plan)?;
        for (poe, without_each_m) in without_each(&demand, weights, targets, &left_out)?.iter().enumerate() {
            let estimate_m = measure.exact_m[[site, poe, index]];
            for (size_index, &size) in plan.sizes().iter().enumerate() {
                let ordinates_m = replicates.ordinates_m(0, poe, size_index);
                let of_sample = (without_each_m.as_slice(), plan.units_drawn(size));
                done.bands.push(interval.band(ordinates_m, confidence, estimate_m, of_sample));
                if settings.simultaneous {
                    done.replicates_m.extend_from_slice(ordinates_m);
                }
            }
        }
    }
    for branches in measure.branches.iter().filter(|branches| !branches.is_empty()) {
        done.bands.extend(joint_bands(&demand, branches, targets, plan, confidence)?);
    }
    Ok(done)
}

/// The bands of all strengths, in order, as arrays; with the two figures of Table 4.1.
pub(super) fn gather_bands(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    plan: &ResamplingPlan,
    settings: &BandSettings,
    (strengths, inferred): (&[&StrengthBands], InferredBands),
) -> MeasureBands {
    let (sites, poes, sizes) = (stored.sites.len(), stored.poes.len(), plan.sizes().len());
    let shape = [sites, poes, sizes, strengths.len()];
    let cell = |site: usize, poe: usize, size: usize| (site * poes + poe) * sizes + size;
    let first = settings.first_strength(&stored.strengths);
    let simultaneous_m = settings.simultaneous.then(|| {
        let count = plan.replicates();
        // [site, poe, size][strength]
        let limits: Vec<Vec<(f64, f64)>> = (0..sites * poes * sizes)
            .into_par_iter()
            .map(|cell| {
                let replicates: Vec<Vec<f64>> = strengths
                    .iter()
                    .map(|strength| strength.replicates_m[cell * count..(cell + 1) * count].to_vec())
                    .collect();
                simultaneous_bands(&replicates, settings.confidence)
            })
            .collect();
        let limits = Array::from_fn(shape, |[site, poe, size, strength]| limits[cell(site, poe, size)][strength]);
        [limits.map(|limits| limits.0), limits.map(|limits| limits.1)]
    });
    let band = |[site, poe, size, strength]: [usize; 4]| strengths[strength].bands[cell(site, poe, size)];
    let mut plain = spectra_bands(&Array::from_fn(shape, band), &measure.exact_m, first);
    plain.simultaneous_m = simultaneous_m;
    let with_branches = (0..sites).filter(|&site| !measure.branches[site].is_empty()).collect();
    // behind those of the sites
    plain.joint = joint_from_draws(with_branches, shape, first, |place, [poe, size, strength]| {
        strengths[strength].bands[cell(sites + place, poe, size)]
    });
    MeasureBands { measure: measure.measure, plain, inferred: Some(inferred), repaired: None }
}
