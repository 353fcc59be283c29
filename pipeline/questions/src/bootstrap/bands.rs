//! Confidence bands as arrays, with the two figures of Table 4.1, whatever they are made of.

use uplift_bootstrap::{Band, Interval};
use uplift_job::Array;
use uplift_result::StoredSpectraBands;

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
