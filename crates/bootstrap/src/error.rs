//! What a bootstrap cannot be made of.

use thiserror::Error;
use uplift_risk::RiskError;

/// Why there is no bootstrap.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BootstrapError {
    /// Nothing to draw from, or nothing to draw.
    #[error(
        "a resampling plan needs records, sample sizes and replicates: found {records} records, {sizes} sizes and \
         {replicates} replicates"
    )]
    Empty {
        /// Records.
        records: usize,
        /// Sample sizes.
        sizes: usize,
        /// Replicates of each size.
        replicates: usize,
    },
    /// An invalid sample size, or one given twice.
    #[error("sample size {size}: sizes are whole numbers from 1 to {limit}, each given once")]
    Size {
        /// The size.
        size: u32,
        /// The largest one allowed.
        limit: u32,
    },
    /// Multiplicities of another shape than the plan.
    #[error("{found} multiplicities, where {expected} were expected: one for each size, replicate and record")]
    Shape {
        /// Found.
        found: usize,
        /// Expected.
        expected: usize,
    },
    /// A replicate that does not draw as many records as its size says.
    #[error("replicate {replicate} of size {size} draws {found} records")]
    Draws {
        /// Its size.
        size: u32,
        /// Its number, from 0.
        replicate: usize,
        /// Records drawn.
        found: u64,
    },
    /// Records of a single earthquake, which are to be drawn with their earthquakes.
    #[error("all records are of one earthquake: there are no earthquakes to resample")]
    OneEvent,
    /// Records of a single pair, which are to be drawn with their pairs.
    #[error("all records are of one pair: there are no pairs to resample")]
    OnePair,
    /// Demand and hazard that do not belong together.
    #[error(transparent)]
    Risk(#[from] RiskError),
}
