//! Several samples ahead evaluated together, in the vectors of the processor.
//!
//! Arrays that are read in this way are longer by [`AHEAD`] samples than the record.

use uplift_instructions::{LANES, by_halves};
pub(crate) use uplift_instructions::{larger, smaller};

/// Samples evaluated together, a power of two.
pub(crate) const AHEAD: usize = LANES;

/// One number of each of the samples.
pub(crate) type Lanes = [f64; AHEAD];

/// `samples` with zeros after the last one.
pub(crate) fn padded(mut samples: Vec<f64>) -> Vec<f64> {
    samples.extend([0.0; AHEAD]);
    samples
}

/// The samples from `first` on.
#[inline(always)]
pub(crate) fn ahead(samples: &[f64], first: usize) -> &Lanes {
    debug_assert!(first + AHEAD <= samples.len(), "not padded");
    samples[first..].first_chunk().unwrap_or(&[0.0; AHEAD])
}

/// The intervals up to the first `count` samples of which an end is not quiet, a bit each: the first begins at the
/// start, the others at the sample before theirs.
#[inline(always)]
pub(crate) fn intervals_to_look_at(quiet_samples: u32, quiet_start: bool, count: usize) -> u32 {
    !(quiet_samples & (quiet_samples << 1 | u32::from(quiet_start))) & ((1 << count) - 1)
}

/// The largest.
#[inline(always)]
pub(crate) fn largest(x: Lanes) -> f64 {
    by_halves(x, larger)
}
