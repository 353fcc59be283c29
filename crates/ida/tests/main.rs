//! Stripes against single runs, on any number of threads, in shards, and gone on with.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod blocks;
mod cells;
mod directions;
mod frames;
mod real_records;
mod stripes;

use uplift_ida::Peaks;

/// All that was computed, to the bit.
fn bits(peaks: &Peaks) -> Vec<(u64, u32)> {
    peaks.displacement_m().iter().map(|value| value.to_bits()).zip(peaks.impacts().iter().copied()).collect()
}
