//! What can be wrong with samples.

use thiserror::Error;

/// Why samples cannot be compared.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ValidationError {
    /// A sample has no values.
    #[error("a sample has no values: at least one is needed")]
    Empty,
    /// A value is none.
    #[error("value {index} is {value}: peaks are finite or +inf (a collapse)")]
    Value {
        /// Its place, from 0.
        index: usize,
        /// The value.
        value: f64,
    },
    /// Pairs are of samples of the same size.
    #[error("{measured} measured and {computed} computed values: pairs need as many of each")]
    Unpaired {
        /// Measured values.
        measured: usize,
        /// Computed values.
        computed: usize,
    },
    /// The caller stopped it.
    #[error("stopped before it was done")]
    Stopped,
    /// A number is out of range.
    #[error("{name} is {value}: it must be {requirement}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// The value given.
        value: f64,
        /// What would be accepted.
        requirement: &'static str,
    },
}
