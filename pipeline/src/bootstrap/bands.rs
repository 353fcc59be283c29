//! Confidence bands of the spectra: the bootstrap over records (Section 4.5).

use rayon::prelude::*;
use uplift_bootstrap::{
    Band, BootstrapError, Interval, Replicates, ResamplingPlan, acceleration, error_of_median, leave_one_out,
    range_of_interval, simultaneous_bands, weighted_quantile,
};
use uplift_motion::IntensityMeasure;
use uplift_risk::{PooledDemand, StripeWeights};

use crate::error::UpliftError;
use crate::result::{StoredMeasure, StoredStripes};

/// What kind of bands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BandSettings {
    /// Share of the replicates between the limits.
    pub(super) confidence: f64,
    /// How a limit is read.
    pub(super) interval: Interval,
    /// Whether bands that hold whole spectra are made too.
    pub(super) simultaneous: bool,
    /// Only strengths above this count in Eq. 4.9 and 4.10.
    pub(super) strength_above: f64,
}

/// The bands of one strength.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StrengthBands {
    /// Over `[site, poe, size]`; after these the joint ones over `[site with branches, poe, size]`.
    pub(super) bands: Vec<Band>,
    /// All replicates over `[site, poe, size, replicate]`, m, where whole spectra are wanted.
    pub(super) replicates_m: Vec<f64>,
}

/// The bands of one measure; arrays run over `[site, poe, size, strength]`, m.
#[derive(Debug, Clone, PartialEq)]
pub struct Bands {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Lower limits.
    pub lower_m: Vec<f64>,
    /// Medians.
    pub median_m: Vec<f64>,
    /// Upper limits.
    pub upper_m: Vec<f64>,
    /// Lower and upper limits of the band of whole spectra, if made.
    pub simultaneous_m: Option<[Vec<f64>; 2]>,
    /// Bands over records and hazard together, for the sites with branches.
    pub joint: Vec<JointBands>,
    /// Eq. 4.9 over `[site, poe, size]`.
    pub error_of_median: Vec<Option<f64>>,
    /// Eq. 4.10 over `[site, poe, size]`.
    pub range_of_interval: Vec<Option<f64>>,
}

/// The bands of one site over records and weighted hazard curves together; arrays run over `[poe, size, strength]`, m.
#[derive(Debug, Clone, PartialEq)]
pub struct JointBands {
    /// Position of the site.
    pub site: usize,
    /// Lower limits.
    pub lower_m: Vec<f64>,
    /// Medians.
    pub median_m: Vec<f64>,
    /// Upper limits.
    pub upper_m: Vec<f64>,
    /// Eq. 4.10 over `[poe, size]`.
    pub range_of_interval: Vec<Option<f64>>,
}

/// The bands of the strength at `index`.
///
/// # Errors
/// Numbers that do not fit together, in a file that was changed.
pub(super) fn bands_of_strength(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    index: usize,
    plan: &ResamplingPlan,
    settings: &BandSettings,
) -> Result<StrengthBands, UpliftError> {
    let demand = measure.demand(index, stored.strengths.len())?;
    let targets = &stored.targets_per_year;
    let mut done = StrengthBands { bands: Vec::new(), replicates_m: Vec::new() };
    let mut sorted = Vec::new();
    for (site, weights) in measure.weights.iter().enumerate() {
        let sites: [&StripeWeights; 1] = [weights];
        let replicates = Replicates::of(&demand, &sites, targets, plan)?;
        let without_each = match settings.interval {
            Interval::Percentile => Vec::new(),
            Interval::Bca => leave_one_out(&demand, weights, targets)?,
        };
        for poe in 0..targets.len() {
            let estimate_m = measure.spectra_m[stored.ordinate(site, poe, index)];
            let without_each_m: Vec<f64> = without_each.iter().skip(poe).step_by(targets.len()).copied().collect();
            for (size_index, &size) in plan.sizes().iter().enumerate() {
                let ordinates_m = replicates.ordinates_m(0, poe, size_index);
                sorted.clear();
                sorted.extend_from_slice(ordinates_m);
                sorted.sort_unstable_by(f64::total_cmp);
                done.bands.push(match settings.interval {
                    Interval::Percentile => Band::percentile(&sorted, settings.confidence),
                    Interval::Bca => {
                        let acceleration = acceleration(&without_each_m, size);
                        Band::bca(&sorted, settings.confidence, estimate_m, acceleration)
                    }
                });
                if settings.simultaneous {
                    done.replicates_m.extend_from_slice(ordinates_m);
                }
            }
        }
    }
    for branches in measure.branches.iter().filter(|branches| !branches.is_empty()) {
        done.bands.extend(joint_bands(&demand, branches, targets, plan, settings)?);
    }
    Ok(done)
}

/// The bands of one strength and site over `[poe, size]`, of all pairs of a replicate and a branch: a replicate counts
/// as much in every branch, and a branch as much as it weighs.
fn joint_bands(
    demand: &PooledDemand,
    branches: &[(f64, StripeWeights)],
    targets: &[f64],
    plan: &ResamplingPlan,
    settings: &BandSettings,
) -> Result<Vec<Band>, BootstrapError> {
    let weights: Vec<&StripeWeights> = branches.iter().map(|(_, weights)| weights).collect();
    let replicates = Replicates::of(demand, &weights, targets, plan)?;
    let tail = 0.5 * (1.0 - settings.confidence);
    let mut bands = Vec::with_capacity(targets.len() * plan.sizes().len());
    let mut pairs = Vec::with_capacity(branches.len() * plan.replicates());
    for poe in 0..targets.len() {
        for size in 0..plan.sizes().len() {
            pairs.clear();
            for (branch, (weight, _)) in branches.iter().enumerate() {
                pairs.extend(replicates.ordinates_m(branch, poe, size).iter().map(|&u_m| (u_m, *weight)));
            }
            pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
            let [lower_m, median_m, upper_m] =
                [tail, 0.5, 1.0 - tail].map(|probability| weighted_quantile(&pairs, probability));
            bands.push(Band { lower_m, median_m, upper_m });
        }
    }
    Ok(bands)
}

/// The bands of all strengths, in order, as arrays; with the two figures of Table 4.1.
pub(super) fn gather_bands(
    stored: &StoredStripes,
    measure: &StoredMeasure,
    plan: &ResamplingPlan,
    settings: &BandSettings,
    strengths: &[&StrengthBands],
) -> Bands {
    let sizes = plan.sizes().len();
    let cells = stored.sites.len() * stored.poes.len() * sizes;
    let of = |value: fn(&Band) -> f64| -> Vec<f64> {
        (0..cells).flat_map(|cell| strengths.iter().map(move |strength| value(&strength.bands[cell]))).collect()
    };
    let (lower_m, median_m, upper_m) = (of(|band| band.lower_m), of(|band| band.median_m), of(|band| band.upper_m));
    let first = stored.strengths.partition_point(|&strength| strength <= settings.strength_above);
    let (mut errors, mut ranges) = (Vec::with_capacity(cells), Vec::with_capacity(cells));
    for cell in 0..cells {
        let row = cell * strengths.len() + first..(cell + 1) * strengths.len();
        let poes = stored.poes.len();
        let spectrum = stored.spectrum(&measure.spectra_m, cell / sizes / poes, cell / sizes % poes);
        errors.push(error_of_median(&median_m[row.clone()], &spectrum[first..]));
        ranges.push(range_of_interval(&lower_m[row.clone()], &median_m[row.clone()], &upper_m[row]));
    }
    let simultaneous_m = settings.simultaneous.then(|| {
        let count = plan.replicates();
        let limits: Vec<(f64, f64)> = (0..cells)
            .into_par_iter()
            .flat_map_iter(|cell| {
                let replicates: Vec<Vec<f64>> = strengths
                    .iter()
                    .map(|strength| strength.replicates_m[cell * count..(cell + 1) * count].to_vec())
                    .collect();
                simultaneous_bands(&replicates, settings.confidence)
            })
            .collect();
        [limits.iter().map(|limits| limits.0).collect(), limits.iter().map(|limits| limits.1).collect()]
    });
    let with_branches = (0..stored.sites.len()).filter(|&site| !measure.branches[site].is_empty());
    let joint = with_branches
        .enumerate()
        .map(|(place, site)| {
            let per_site = stored.poes.len() * sizes;
            let start = cells + place * per_site;
            let of = |value: fn(&Band) -> f64| -> Vec<f64> {
                (start..start + per_site)
                    .flat_map(|cell| strengths.iter().map(move |strength| value(&strength.bands[cell])))
                    .collect()
            };
            let (lower_m, median_m, upper_m) =
                (of(|band| band.lower_m), of(|band| band.median_m), of(|band| band.upper_m));
            let range_of_interval = (0..per_site)
                .map(|cell| {
                    let row = cell * strengths.len() + first..(cell + 1) * strengths.len();
                    range_of_interval(&lower_m[row.clone()], &median_m[row.clone()], &upper_m[row])
                })
                .collect();
            JointBands { site, lower_m, median_m, upper_m, range_of_interval }
        })
        .collect();
    Bands {
        measure: measure.measure,
        lower_m,
        median_m,
        upper_m,
        simultaneous_m,
        joint,
        error_of_median: errors,
        range_of_interval: ranges,
    }
}
