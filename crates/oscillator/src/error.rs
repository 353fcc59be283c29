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
    /// The oscillator is so stiff, or falls so steeply, that no motion resolves it and no run of it ends in time.
    #[error(
        "the stiffness {branch} is {stiffness_per_s2:e} 1/s²: it must be {most_per_s2:e} 1/s² at most (16 kHz); it \
         follows from strength {strength}, gravity_m_s2 = {gravity_m_s2} and uplift_displacement_m = \
         {uplift_displacement_m}, with the capacity or the stiffness after uplift: is one of them in another unit?"
    )]
    TooStiff {
        /// While attached or after uplift.
        branch: &'static str,
        /// Stiffness over the mass, 1/s²; negative where the force falls.
        stiffness_per_s2: f64,
        /// The largest that is followed, 1/s².
        most_per_s2: f64,
        /// Strength η.
        strength: f64,
        /// Acceleration of gravity, m/s².
        gravity_m_s2: f64,
        /// Displacement at uplift, m.
        uplift_displacement_m: f64,
    },
    /// A run that would take for ever, or a history that no memory holds.
    #[error(
        "{duration_s} s of motion are {steps:.1e} steps of {dt_s} s and half cycles of the oscillator: {most:e} are \
         computed at most; follow the free vibration for a shorter time, or give a softer system"
    )]
    TooManySteps {
        /// Duration of the run, s.
        duration_s: f64,
        /// Time step of the motion, s.
        dt_s: f64,
        /// Samples and half cycles.
        steps: f64,
        /// The most that are computed.
        most: f64,
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

/// Refuses `value` unless what is required of it holds.
pub(crate) fn require(
    holds: bool,
    name: &'static str,
    value: f64,
    unit: &'static str,
    requirement: &'static str,
) -> Result<(), OscillatorError> {
    if holds { Ok(()) } else { Err(OscillatorError::OutOfRange { name, value, unit, requirement }) }
}

pub(crate) fn require_positive(name: &'static str, value: f64, unit: &'static str) -> Result<(), OscillatorError> {
    require(value.is_finite() && value > 0.0, name, value, unit, "finite and positive")
}
