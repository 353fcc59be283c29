//! Confidence bands of the spectra: the bootstrap over records (Section 4.5).

use rayon::prelude::*;
use uplift_bootstrap::{Band, Interval, Replicates, ResamplingPlan, simultaneous_bands, without_each};
use uplift_job::Array;
use uplift_result::{InferredBands, MeasureBands, StoredSpectraBands};
use uplift_risk::StripeWeights;
use uplift_uniform_risk::{StoredMeasure, StoredStripes};

use super::joint::{joint_bands, joint_from_draws};
use crate::error::QuestionsError;

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

impl BandSettings {
    /// Position of the first strength that counts in Eq. 4.9 and 4.10.
    pub(super) fn first_strength(&self, strengths: &[f64]) -> usize {
        strengths.partition_point(|&strength| strength <= self.strength_above)
    }
}

/// Lower limit, median and upper limit of each band, one after the other.
pub(super) fn numbers_of_bands(bands: &[Band]) -> impl Iterator<Item = f64> {
    bands.iter().flat_map(|band| [band.lower_m, band.median_m, band.upper_m])
}

pub(super) fn bands_of_numbers(numbers: &[f64]) -> Vec<Band> {
    let band = |band: &[f64]| Band { lower_m: band[0], median_m: band[1], upper_m: band[2] };
    numbers.chunks_exact(3).map(band).collect()
}

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

/// Bands `[site, poe, size, strength]` of spectra `[site, poe, strength]`, m, with the figures of Table 4.1 over the
/// strengths from the position `first` on.
pub(super) fn spectra_bands(bands: &Array<4, Band>, spectra_m: &Array<3>, first: usize) -> StoredSpectraBands {
    let limits_m = limits(bands);
    let [sites, poes, sizes, _] = bands.shape();
    let error_of_median = Array::from_fn([sites, poes, sizes], |at @ [site, poe, _]| {
        let (median_m, spectrum_m) = (limits_m[1].block(at), spectra_m.block([site, poe]));
        percent(uplift_bootstrap::error_of_median(&median_m[first..], &spectrum_m[first..]))
    });
    let range_of_interval = ranges(&limits_m, first);
    StoredSpectraBands { limits_m, simultaneous_m: None, error_of_median, range_of_interval, joint: None }
}

/// Lower limits, medians and upper limits.
pub(super) fn limits(bands: &Array<4, Band>) -> [Array<4>; 3] {
    [|band: &Band| band.lower_m, |band: &Band| band.median_m, |band: &Band| band.upper_m]
        .map(|value: fn(&Band) -> f64| bands.map(value))
}

/// Widths of the interval `[site, poe, size]`, % (Eq. 4.10), over the strengths from the position `first` on.
pub(super) fn ranges(limits_m: &[Array<4>; 3], first: usize) -> Array<3> {
    let [sites, poes, sizes, _] = limits_m[0].shape();
    Array::from_fn([sites, poes, sizes], |at| {
        let [lower, median, upper] = limits_m.each_ref().map(|limits| &limits.block(at)[first..]);
        percent(uplift_bootstrap::range_of_interval(lower, median, upper))
    })
}

/// A share in per cent; NaN for none.
fn percent(share: Option<f64>) -> f64 {
    share.map_or(f64::NAN, |share| 100.0 * share)
}
