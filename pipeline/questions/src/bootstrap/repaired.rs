//! Confidence bands of repaired spectra: the weights are solved again for every sample of the records.
//!
//! With the weights of the whole set for every sample, bands would be too narrow. Weights are those of all strengths
//! together, so that a site is done at once, where plain bands are done a strength after the other.

use rayon::prelude::*;
use uplift_bootstrap::{Band, ResamplingPlan, simultaneous_bands};
use uplift_ida::Watch;
use uplift_job::Array;
use uplift_result::{InferredBands, StoredRepairedBands};
use uplift_risk::{PooledDemand, RecordSample};
use uplift_uniform_risk::consistency::{RepairedAnalysis, Reweighed};

use super::bands::{BandSettings, bands_of_numbers, numbers_of_bands, spectra_bands};
use crate::error::QuestionsError;

/// The bands of the repaired spectra of one site by one measure.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SiteBands {
    /// The bands `[poe, size, strength]`.
    pub(super) bands: Vec<Band>,
    /// Limits of the bands of whole spectra `[poe, size, strength]`, m, if wanted.
    pub(super) simultaneous_m: Vec<(f64, f64)>,
    /// The spectra of all records `[poe, strength]`, m, read exactly.
    pub(super) spectra_m: Vec<f64>,
    /// Share of the samples whose weights miss the site's hazard `[size]`.
    pub(super) failed: Vec<f64>,
}

/// Lengths of the axes of the bands of a site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SiteShape {
    pub(super) poes: usize,
    pub(super) sizes: usize,
    pub(super) strengths: usize,
}

impl SiteShape {
    /// Number of the bands of a site.
    pub(super) fn cells(self) -> usize {
        self.poes * self.sizes * self.strengths
    }

    /// Position of a band.
    pub(super) fn cell(self, [poe, size, strength]: [usize; 3]) -> usize {
        (poe * self.sizes + size) * self.strengths + strength
    }

    /// `[poe, size, strength]` of the band at `cell`.
    fn indices(self, cell: usize) -> [usize; 3] {
        [cell / (self.sizes * self.strengths), cell / self.strengths % self.sizes, cell % self.strengths]
    }
}

impl SiteBands {
    /// All numbers in a row, for a checkpoint.
    pub(super) fn numbers(&self) -> Vec<f64> {
        let bands = numbers_of_bands(&self.bands);
        let simultaneous = self.simultaneous_m.iter().flat_map(|limits| [limits.0, limits.1]);
        bands.chain(simultaneous).chain(self.spectra_m.iter().copied()).chain(self.failed.iter().copied()).collect()
    }

    /// The bands of such a row; none where it is of another shape.
    pub(super) fn from_numbers(numbers: &[f64], shape: SiteShape, simultaneous: bool) -> Option<Self> {
        let (bands, rest) = numbers.split_at_checked(3 * shape.cells())?;
        let (limits, rest) = rest.split_at_checked(if simultaneous { 2 * shape.cells() } else { 0 })?;
        let (spectra_m, failed) = rest.split_at_checked(shape.poes * shape.strengths)?;
        (failed.len() == shape.sizes).then(|| Self {
            bands: bands_of_numbers(bands),
            simultaneous_m: limits.chunks_exact(2).map(|limits| (limits[0], limits[1])).collect(),
            spectra_m: spectra_m.to_vec(),
            failed: failed.to_vec(),
        })
    }
}

/// The bands of a site by a measure, whose `demands` are of all strengths.
pub(super) fn bands_of_site(
    analysis: &RepairedAnalysis<'_>,
    (demands, targets_per_year): (&[PooledDemand], &[f64]),
    (plan, settings): (&ResamplingPlan, &BandSettings),
    watch: &dyn Watch,
) -> Result<SiteBands, QuestionsError> {
    let weighed_anew = |samples: &[RecordSample]| analysis.ordinates(demands, targets_per_year, samples, watch);
    let of_set_m = analysis.ordinates_of_set(demands, targets_per_year)?;
    let drawn = weighed_anew(plan.samples())?;
    let BandSettings { confidence, interval, .. } = *settings;
    let left_out = interval.left_out(plan)?;
    let without_each_m = if left_out.is_empty() { Vec::new() } else { weighed_anew(&left_out)?.ordinates_m };
    let shape = SiteShape { poes: targets_per_year.len(), sizes: plan.sizes().len(), strengths: demands.len() };
    let SiteShape { poes, sizes, strengths } = shape;
    let band = |cell: usize| {
        let [poe, size, strength] = shape.indices(cell);
        let without_each_m = &without_each_m[(strength * poes + poe) * left_out.len()..][..left_out.len()];
        let of_sample = (without_each_m, plan.units_drawn(plan.sizes()[size]));
        interval.band(replicates_m(&drawn, plan, shape, cell), confidence, of_set_m[strength][poe], of_sample)
    };
    let bands = (0..shape.cells()).into_par_iter().map(band).collect();
    let spectra = if settings.simultaneous { poes * sizes } else { 0 };
    let of_spectrum = |spectrum: usize| {
        let of_strength = |strength| replicates_m(&drawn, plan, shape, spectrum * strengths + strength).to_vec();
        let spectra_m: Vec<Vec<f64>> = (0..strengths).map(of_strength).collect();
        simultaneous_bands(&spectra_m, confidence)
    };
    let simultaneous_m: Vec<Vec<(f64, f64)>> = (0..spectra).into_par_iter().map(of_spectrum).collect();
    Ok(SiteBands {
        bands,
        simultaneous_m: simultaneous_m.concat(),
        spectra_m: (0..poes).flat_map(|poe| of_set_m.iter().map(move |of_strength| of_strength[poe])).collect(),
        failed: failed_shares(&drawn, plan).collect(),
    })
}

/// The replicates of the band at `cell` of a site, m, among all that were `drawn`.
pub(super) fn replicates_m<'a>(
    drawn: &'a Reweighed,
    plan: &ResamplingPlan,
    shape: SiteShape,
    cell: usize,
) -> &'a [f64] {
    let [poe, size, strength] = shape.indices(cell);
    let (samples, replicates) = (plan.samples().len(), plan.replicates());
    // [strength, poe, size, replicate]
    &drawn.ordinates_m[(strength * shape.poes + poe) * samples + size * replicates..][..replicates]
}

/// Share of the samples of each size whose weights miss the hazard.
pub(super) fn failed_shares<'a>(drawn: &'a Reweighed, plan: &ResamplingPlan) -> impl Iterator<Item = f64> + use<'a> {
    let replicates = plan.replicates();
    let failed = |reached: &[bool]| reached.iter().filter(|is_reached| !**is_reached).count();
    drawn.is_reached.chunks_exact(replicates).map(move |reached| failed(reached) as f64 / replicates as f64)
}

/// The bands of all sites, in order, as arrays; with the two figures of Table 4.1, from the strength at `first` on; and
/// where `simultaneous` with those of whole spectra, whether a site has some or not; `inferred` are of all sites.
pub(super) fn gather_repaired(
    (sites, inferred): (&[Option<&SiteBands>], InferredBands),
    shape: SiteShape,
    first: usize,
    simultaneous: bool,
) -> StoredRepairedBands {
    let SiteShape { poes, sizes, strengths } = shape;
    let all = [sites.len(), poes, sizes, strengths];
    let none = Band { lower_m: f64::NAN, median_m: f64::NAN, upper_m: f64::NAN };
    let band = |[site, poe, size, strength]: [usize; 4]| {
        sites[site].map_or(none, |own| own.bands[shape.cell([poe, size, strength])])
    };
    let spectra_m = Array::from_fn([sites.len(), poes, strengths], |[site, poe, strength]| {
        sites[site].map_or(f64::NAN, |own| own.spectra_m[poe * strengths + strength])
    });
    let mut bands = spectra_bands(&Array::from_fn(all, band), &spectra_m, first);
    if simultaneous {
        let limits = Array::from_fn(all, |[site, poe, size, strength]| {
            sites[site].map_or((f64::NAN, f64::NAN), |own| own.simultaneous_m[shape.cell([poe, size, strength])])
        });
        bands.simultaneous_m = Some([limits.map(|limits| limits.0), limits.map(|limits| limits.1)]);
    }
    let failed =
        Array::from_fn([sites.len(), sizes], |[site, size]| sites[site].map_or(f64::NAN, |own| own.failed[size]));
    StoredRepairedBands { bands, failed, inferred: Some(inferred) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_checkpoint_gives_back_what_it_was_given() {
        let shape = SiteShape { poes: 1, sizes: 2, strengths: 2 };
        let band = |at: f64| Band { lower_m: at, median_m: at + 0.5, upper_m: f64::INFINITY };
        let bands = SiteBands {
            bands: [1.0, 2.0, 3.0, 4.0].map(band).to_vec(),
            simultaneous_m: vec![(0.1, 0.2); 4],
            spectra_m: vec![1.0, 2.0],
            failed: vec![0.0, 0.25],
        };
        let numbers = bands.numbers();
        assert_eq!(SiteBands::from_numbers(&numbers, shape, true), Some(bands.clone()));
        assert_eq!(SiteBands::from_numbers(&numbers, shape, false), None);
        assert_eq!(SiteBands::from_numbers(&numbers[1..], shape, true), None);
        let none_m = || [0; 2].map(|_| Array::from_fn([2, 1, 2, 2], |_| f64::NAN));
        let inferred = || InferredBands { truth_m: none_m(), prediction_m: none_m() };
        let gathered = gather_repaired((&[None, Some(&bands)], inferred()), shape, 0, true);
        assert!(gathered.failed[[0, 1]].is_nan() && gathered.failed[[1, 1]] == 0.25);
        assert_eq!(gathered.bands.limits_m[0].block([1, 0]), [1.0, 2.0, 3.0, 4.0]);
        // a measure by which no site is repaired has the same columns
        let none = gather_repaired((&[None, None], inferred()), shape, 0, true);
        assert_eq!(none.bands.simultaneous_m.map(|[lower, _]| lower.shape()), Some([2, 1, 2, 2]));
        // |1.5 − 1|/1 and |2.5 − 2|/2 of the first size, Eq. 4.9 takes the largest
        assert!((gathered.bands.error_of_median[[1, 0, 0]] - 50.0).abs() < 1e-10);
        assert!(gathered.bands.error_of_median[[0, 0, 0]].is_nan());
    }
}
