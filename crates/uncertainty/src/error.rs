//! What can be wrong with random quantities.

use thiserror::Error;

/// Why a quantity has no distribution, or several have none together.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum UncertaintyError {
    /// A number is out of range.
    #[error("{name} is {value}: it must be {requirement}")]
    OutOfRange {
        /// Name of the number.
        name: &'static str,
        /// The value given.
        value: f64,
        /// What would be accepted.
        requirement: &'static str,
    },
    /// Percentiles that do not rise.
    #[error(
        "the {first} % percentile is {first_value} and the {second} % percentile {second_value}: give two that rise \
         together, or a coefficient of variation of 0 for a quantity that is known"
    )]
    Percentiles {
        /// The lower percentage.
        first: f64,
        /// Its value.
        first_value: f64,
        /// The higher percentage.
        second: f64,
        /// Its value.
        second_value: f64,
    },
    /// Limits that do not rise.
    #[error("the limits are {lower} and {upper}, the mode {mode}: give lower < upper, with the mode between them")]
    Limits {
        /// Lower limit.
        lower: f64,
        /// The mode; the middle where none was given.
        mode: f64,
        /// Upper limit.
        upper: f64,
    },
    /// A bounded distribution that goes beyond what the quantity can be.
    #[error("it reaches from {lower} to {upper}, and it can be from {least} to {most}: bring its limits within")]
    Beyond {
        /// Its lower limit.
        lower: f64,
        /// Its upper limit.
        upper: f64,
        /// The least that the quantity can be.
        least: f64,
        /// The most.
        most: f64,
    },
    /// Too much of an unbounded distribution lies where the quantity cannot be.
    #[error(
        "{:.0} % of it lies outside of {least} to {most}, where it cannot be: take less scatter, another mean, or a \
         distribution with limits",
        100.0 * .share
    )]
    CutOff {
        /// The share outside, 0 to 1.
        share: f64,
        /// The least that the quantity can be.
        least: f64,
        /// The most.
        most: f64,
    },
    /// A correlation of a quantity with itself, of one that is not there, or one that was given before.
    #[error("the correlation of {first} with {second} cannot be: name two different quantities, each pair once")]
    Pair {
        /// Position of the first quantity.
        first: usize,
        /// Position of the second.
        second: usize,
    },
    /// Correlations that no quantities can have together.
    #[error(
        "the correlations contradict each other: their matrix is not positive definite; bring the strongest of them \
         closer to 0"
    )]
    NotPositiveDefinite,
    /// As many distributions as the copula has dimensions are needed.
    #[error("{found} distributions for correlations of {expected} quantities")]
    Count {
        /// Distributions.
        found: usize,
        /// Dimensions of the copula.
        expected: usize,
    },
    /// A sample that cannot be drawn.
    #[error("{points} points in {dimensions} dimensions: {requirement}")]
    Sample {
        /// Points.
        points: usize,
        /// Dimensions.
        dimensions: usize,
        /// What would be accepted.
        requirement: &'static str,
    },
    /// Results that do not belong together.
    #[error("{found} results where there are {expected} in the first matrix")]
    Results {
        /// How many there are.
        found: usize,
        /// How many belong there.
        expected: usize,
    },
}
