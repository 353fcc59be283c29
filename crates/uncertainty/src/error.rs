//! What can be wrong with random quantities.

use thiserror::Error;

/// To four digits, which say what is wrong: what follows from a mean and a scatter has sixteen.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Why a quantity has no distribution, or several have none together.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum UncertaintyError {
    /// A number is out of range.
    #[error("{name} is {}: it must be {requirement}", rounded(*.value))]
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
        "the {first} % percentile is {} and the {second} % percentile {}: give two that rise together, or a \
         coefficient of variation of 0 for a certain quantity",
        rounded(*.first_value),
        rounded(*.second_value)
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
    #[error(
        "the limits are {} and {}, the mode {}: give lower < upper, with the mode between them",
        rounded(*.lower),
        rounded(*.upper),
        rounded(*.mode)
    )]
    Limits {
        /// Lower limit.
        lower: f64,
        /// The mode; the middle where none was given.
        mode: f64,
        /// Upper limit.
        upper: f64,
    },
    /// A bounded distribution that goes beyond what the quantity can be.
    #[error(
        "it reaches from {} to {}, but the possible range is {least} to {most}: keep its limits within",
        rounded(*.lower),
        rounded(*.upper)
    )]
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
        "{:.0} % of it is outside the possible range, {least} to {most}: use less scatter, another mean, or a \
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
    #[error("correlation of {first} with {second}: name two different quantities, each pair once")]
    Pair {
        /// Position of the first quantity.
        first: usize,
        /// Position of the second.
        second: usize,
    },
    /// Correlations that no quantities can have together.
    #[error(
        "the correlations contradict each other: their matrix is not positive definite; move the strongest of them \
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_say_what_is_wrong() {
        let beyond = UncertaintyError::Beyond { lower: 0.123_456_789, upper: 1.0 + 1.0 / 3.0, least: 0.0, most: 1.0 };
        assert!(
            beyond.to_string().starts_with("it reaches from 0.1235 to 1.333, but the possible range is 0 to 1"),
            "{beyond}"
        );
        assert_eq!([1e-6, 0.06, 12.0, f64::INFINITY].map(rounded), [1e-6, 0.06, 12.0, f64::INFINITY]);
    }
}
