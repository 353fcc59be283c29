//! What the spectra say in a few numbers.

use serde::Serialize;
use uplift_block::Overturning;

use super::compute::{PulseSpectra, Spectrum};
use super::plan::wavelet;

/// The overturned part of the spectra of one wavelet. Bounds are values of the grids; none where no point overturns.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// The wavelet.
    pub wavelet: &'static str,
    /// Points of the spectrum over ωₚ/p.
    pub points: usize,
    /// Points that overturn without impact.
    pub overturned_without_impact: usize,
    /// Points that overturn after one impact or more.
    pub overturned_after_impact: usize,
    /// Smallest aₚ/(g tan α) at which a block overturns.
    pub smallest_overturning_acceleration: Option<f64>,
    /// Largest ωₚ/p at which a block overturns.
    pub largest_overturning_frequency: Option<f64>,
    /// Largest base 2b ωₚ²/aₚ at which a block overturns (Section 2.3.2: roughly nine).
    pub largest_overturning_base: Option<f64>,
    /// Whether that is the last base of the grid, so that larger ones may overturn too.
    pub larger_bases_may_overturn: bool,
}

/// Sum up the spectra of one wavelet.
pub fn summary(spectra: &PulseSpectra) -> Summary {
    let spectrum = &spectra.by_frequency;
    let ways = |way| spectrum.points.iter().filter(|point| point.overturning == way).count();
    let half_widths = &spectra.by_half_width.plan.sizes;
    let largest_half_width = largest_overturning_size(&spectra.by_half_width);
    Summary {
        wavelet: wavelet(spectra.shape),
        points: spectrum.points.len(),
        overturned_without_impact: ways(Overturning::WithoutImpact),
        overturned_after_impact: ways(Overturning::AfterImpact),
        smallest_overturning_acceleration: overturned(spectrum)
            .map(|(_, acceleration)| acceleration)
            .min_by(f64::total_cmp),
        largest_overturning_frequency: largest_overturning_size(spectrum),
        largest_overturning_base: largest_half_width.map(|half_width| 2.0 * half_width),
        larger_bases_may_overturn: largest_half_width.is_some() && largest_half_width == half_widths.last().copied(),
    }
}

/// Size and acceleration of the points that overturn.
fn overturned(spectrum: &Spectrum) -> impl Iterator<Item = (f64, f64)> {
    let overturns = |point: &uplift_block::SpectrumPoint| point.overturning != Overturning::None;
    spectrum.rows().filter(move |(_, _, point)| overturns(point)).map(|(size, acceleration, _)| (size, acceleration))
}

fn largest_overturning_size(spectrum: &Spectrum) -> Option<f64> {
    overturned(spectrum).map(|(size, _)| size).max_by(f64::total_cmp)
}
