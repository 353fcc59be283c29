//! What can be wrong with an oscillator or its excitation.

use thiserror::Error;

/// A parameter that no oscillator can have.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum OscillatorError {
    /// A number is outside the range that makes physical sense.
    #[error("{name} is {value} {unit}: it must be {requirement}")]
    OutOfRange {
        /// Name of the parameter, as in the study file.
        name: &'static str,
        /// The value given.
        value: f64,
        /// Its unit, empty for a pure number.
        unit: &'static str,
        /// What would be accepted.
        requirement: &'static str,
    },
    /// The displacement capacity of a negative-stiffness system does not exceed its uplift displacement.
    #[error(
        "capacity_m is {capacity_m} m, not above uplift_displacement_m = {uplift_displacement_m} m: \
         the force would have to vanish before the system uplifts; give a larger capacity or leave it out for the \
         ZSBE system"
    )]
    CapacityBelowUplift {
        /// Displacement at which the restoring force vanishes, m.
        capacity_m: f64,
        /// Displacement at uplift, m.
        uplift_displacement_m: f64,
    },
    /// An acceleration history needs at least two samples.
    #[error("the acceleration history has {samples} samples: at least 2 are needed")]
    TooFewSamples {
        /// Number of samples given.
        samples: usize,
    },
    /// An acceleration sample is NaN or infinite.
    #[error("acceleration sample {index} is {value} m/s²: every sample must be finite")]
    NotFinite {
        /// Index of the sample, from 0.
        index: usize,
        /// The value found.
        value: f64,
    },
}
