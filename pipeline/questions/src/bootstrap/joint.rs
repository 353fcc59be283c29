//! Bands over records and a site's weighted hazard curves together: of all pairs of a replicate and a branch, a
//! replicate counts as much in every branch, and a branch as much as it weighs.

use rayon::prelude::*;
use uplift_bootstrap::{Band, BootstrapError, Replicates, ResamplingPlan, weighted_quantile};
use uplift_ida::Watch;
use uplift_job::Array;
use uplift_result::StoredJointBands;
use uplift_risk::{PooledDemand, StripeWeights};
use uplift_uniform_risk::consistency::{Reweighed, ReweighedBranch};

use super::bands::{bands_of_numbers, limits, numbers_of_bands, ranges};
use super::repaired::{SiteShape, failed_shares, replicates_m};
use crate::error::QuestionsError;

/// Joint bands of the sites at the positions `places`, of all sites in `shape` `[site, poe, size, strength]`; none of
/// no sites. `band` is that of the place among them at `[poe, size, strength]`, and only strengths from the position
/// `first` on count in Eq. 4.10.
pub(super) fn joint_from_draws(
    places: Vec<usize>,
    shape: [usize; 4],
    first: usize,
    band: impl Fn(usize, [usize; 3]) -> Band,
) -> Option<StoredJointBands> {
    if places.is_empty() {
        return None;
    }
    let none = Band { lower_m: f64::NAN, median_m: f64::NAN, upper_m: f64::NAN };
    let limits_m = limits(&Array::from_fn(shape, |[site, poe, size, strength]| {
        let place = places.iter().position(|&own| own == site);
        place.map_or(none, |place| band(place, [poe, size, strength]))
    }));
    let range_of_interval = ranges(&limits_m, first);
    Some(StoredJointBands { sites: places, limits_m, range_of_interval, failed: None })
}

/// The joint bands of one strength and site over `[poe, size]`, of records that count alike.
pub(super) fn joint_bands(
    demand: &PooledDemand,
    branches: &[(f64, StripeWeights)],
    targets_per_year: &[f64],
    plan: &ResamplingPlan,
    confidence: f64,
) -> Result<Vec<Band>, BootstrapError> {
    let weights: Vec<&StripeWeights> = branches.iter().map(|(_, weights)| weights).collect();
    let replicates = Replicates::from_plan(demand, &weights, targets_per_year, plan)?;
    let mut bands = Vec::with_capacity(targets_per_year.len() * plan.sizes().len());
    for poe in 0..targets_per_year.len() {
        for size in 0..plan.sizes().len() {
            let of_branch = |(branch, (weight, _)): (usize, &(f64, StripeWeights))| {
                (*weight, replicates.ordinates_m(branch, poe, size))
            };
            bands.push(band_of_pairs(branches.iter().enumerate().map(of_branch), confidence));
        }
    }
    Ok(bands)
}

/// The band of `branches`, each with its weight and its replicates, m.
fn band_of_pairs<'a>(branches: impl Iterator<Item = (f64, &'a [f64])>, confidence: f64) -> Band {
    let of_branch = |(weight, ordinates_m): (f64, &'a [f64])| ordinates_m.iter().map(move |&u_m| (u_m, weight));
    let mut pairs: Vec<(f64, f64)> = branches.flat_map(of_branch).collect();
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let tail = 0.5 * (1.0 - confidence);
    let [lower_m, median_m, upper_m] =
        [tail, 0.5, 1.0 - tail].map(|probability| weighted_quantile(&pairs, probability));
    Band { lower_m, median_m, upper_m }
}

/// The joint bands of the repaired spectra of one site by one measure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JointSiteBands {
    /// The bands `[poe, size, strength]`.
    pub(super) bands: Vec<Band>,
    /// Share of the pairs whose weights do not bring the branch's hazard `[size]`, as the branches weigh.
    pub(super) failed: Vec<f64>,
}

impl JointSiteBands {
    /// All numbers in a row, for a checkpoint.
    pub(super) fn numbers(&self) -> Vec<f64> {
        numbers_of_bands(&self.bands).chain(self.failed.iter().copied()).collect()
    }

    /// The bands of such a row; none where it is of another shape.
    pub(super) fn from_numbers(numbers: &[f64], shape: SiteShape) -> Option<Self> {
        let (bands, failed) = numbers.split_at_checked(3 * shape.cells())?;
        (failed.len() == shape.sizes).then(|| Self { bands: bands_of_numbers(bands), failed: failed.to_vec() })
    }
}

/// The joint bands of the repaired spectra of a site, whose `demands` are of all strengths: the weights are solved
/// again for every pair of a sample and a branch. NaN where a branch has no repair.
pub(super) fn joint_bands_of_site(
    branches: &[ReweighedBranch<'_>],
    (demands, targets_per_year): (&[PooledDemand], &[f64]),
    (plan, confidence): (&ResamplingPlan, f64),
    watch: &dyn Watch,
) -> Result<JointSiteBands, QuestionsError> {
    let shape = SiteShape { poes: targets_per_year.len(), sizes: plan.sizes().len(), strengths: demands.len() };
    let mut drawn: Vec<(f64, Reweighed)> = Vec::with_capacity(branches.len());
    for branch in branches {
        let Ok(analysis) = &branch.analysis else {
            let none = Band { lower_m: f64::NAN, median_m: f64::NAN, upper_m: f64::NAN };
            return Ok(JointSiteBands { bands: vec![none; shape.cells()], failed: vec![f64::NAN; shape.sizes] });
        };
        drawn.push((branch.weight, analysis.ordinates(demands, targets_per_year, plan.samples(), watch)?));
    }
    let of_cell = |cell: usize| {
        let branches = drawn.iter().map(|(weight, own)| (*weight, replicates_m(own, plan, shape, cell)));
        band_of_pairs(branches, confidence)
    };
    let total: f64 = drawn.iter().map(|(weight, _)| weight).sum();
    let mut failed = vec![0.0; shape.sizes];
    for (weight, own) in &drawn {
        failed.iter_mut().zip(failed_shares(own, plan)).for_each(|(sum, share)| *sum += weight / total * share);
    }
    Ok(JointSiteBands { bands: (0..shape.cells()).into_par_iter().map(of_cell).collect(), failed })
}

/// The joint bands of all sites, in order, as arrays; none where no site has some.
pub(super) fn gather_joint(
    sites: &[Option<&JointSiteBands>],
    shape: SiteShape,
    first: usize,
) -> Option<StoredJointBands> {
    let SiteShape { poes, sizes, strengths } = shape;
    let own: Vec<&JointSiteBands> = sites.iter().copied().flatten().collect();
    let places = (0..sites.len()).filter(|&site| sites[site].is_some()).collect();
    let mut joint = joint_from_draws(places, [sites.len(), poes, sizes, strengths], first, |place, at| {
        own[place].bands[shape.cell(at)]
    })?;
    joint.failed =
        Some(Array::from_fn([sites.len(), sizes], |[site, size]| sites[site].map_or(f64::NAN, |own| own.failed[size])));
    Some(joint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_branch_counts_as_much_as_it_weighs() {
        let (few, many) = ([1.0, 2.0], [3.0, 4.0]);
        let band =
            |weights: [f64; 2]| band_of_pairs([(weights[0], &few[..]), (weights[1], &many[..])].into_iter(), 0.5);
        // pairs of 1, 2, 3 and 4 m with a quarter each; then 0.1, 0.1, 0.4 and 0.4
        assert_eq!(band([0.5, 0.5]), Band { lower_m: 1.0, median_m: 2.0, upper_m: 3.0 });
        assert_eq!(band([0.2, 0.8]), Band { lower_m: 3.0, median_m: 3.0, upper_m: 4.0 });
    }

    #[test]
    fn a_checkpoint_gives_back_what_it_was_given_and_sites_without_branches_have_nothing() {
        let shape = SiteShape { poes: 1, sizes: 2, strengths: 1 };
        let band = |at: f64| Band { lower_m: at, median_m: at + 0.5, upper_m: at + 1.0 };
        let of_site = JointSiteBands { bands: [1.0, 2.0].map(band).to_vec(), failed: vec![0.0, 0.25] };
        let numbers = of_site.numbers();
        assert_eq!(JointSiteBands::from_numbers(&numbers, shape), Some(of_site.clone()));
        assert_eq!(JointSiteBands::from_numbers(&numbers[1..], shape), None);
        assert_eq!(gather_joint(&[None, None], shape, 0), None);
        let joint = gather_joint(&[None, Some(&of_site)], shape, 0);
        let found = joint.map(|own| {
            let failed = own.failed.as_ref().map(|failed| (failed[[0, 1]].is_nan(), failed[[1, 1]]));
            let lower = own.limits_m[0].values().to_vec();
            (own.sites, failed, lower[2..].to_vec(), lower[0].is_nan(), own.range_of_interval[[1, 0, 0]])
        });
        assert_eq!(found, Some((vec![1], Some((true, 0.25)), vec![1.0, 2.0], true, 100.0 * (1.0 / 1.5))));
    }
}
