//! What can be wrong on the way from stripes and hazard to an ordinate.

use thiserror::Error;
use uplift_fragility::FragilityError;
use uplift_hazard::HazardError;

use crate::fixed_point::{MAX_RATE_PER_YEAR, MAX_SAMPLE_SIZE};

/// Why a risk could not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RiskError {
    /// The hazard curve refused a level.
    #[error(transparent)]
    Hazard(#[from] HazardError),
    /// A threshold or a fragility was refused.
    #[error(transparent)]
    Fragility(#[from] FragilityError),
    /// No stripe level at all.
    #[error("hazard rates: none given: one is needed for each stripe level")]
    NoLevels,
    /// A hazard rate is not positive, too large, or above the rate of the level before it.
    #[error(
        "level {index}: hazard rate {rate} per year: rates must be positive, at most {MAX_RATE_PER_YEAR}, \
         and must not rise from one level to the next"
    )]
    Rate {
        /// Position of the level, counted from 0.
        index: usize,
        /// The offending rate, 1/yr.
        rate: f64,
    },
    /// The rate at the first abscissa of the hazard curve is below the rate of the first stripe, or out of range.
    #[error(
        "first abscissa of the hazard curve: rate {rate} per year: it must be at least the rate {first_stripe} \
         of the first stripe and at most {MAX_RATE_PER_YEAR}"
    )]
    FirstAbscissaRate {
        /// The offending rate, 1/yr.
        rate: f64,
        /// Rate of the first stripe, 1/yr.
        first_stripe: f64,
    },
    /// Two inputs are of different numbers of levels or records.
    #[error("{found} {what} given, {expected} expected: the inputs do not belong together")]
    Count {
        /// What was counted.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many the other input has.
        expected: usize,
    },
    /// More levels or records than the pooled demands can index.
    #[error("{what}: {found} are more than the {limit} that can be pooled: split the study")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// The largest number allowed.
        limit: usize,
    },
    /// A probability is outside 0 to 1.
    #[error("level {index}: probability of exceedance {probability}: it must lie between 0 and 1")]
    Probability {
        /// Position of the level, counted from 0.
        index: usize,
        /// The offending probability.
        probability: f64,
    },
    /// The shares of the records at a level are not those of a whole.
    #[error("level {level}: shares of the records add up to {sum}: none may be negative, and all together must be 1")]
    Shares {
        /// Position of the level, counted from 0.
        level: usize,
        /// What they add up to.
        sum: f64,
    },
    /// None of the records of a level is in a sample.
    #[error("level {level}: none of its records is in the sample: draw more records, or give the level more of them")]
    EmptyLevel {
        /// Position of the level, counted from 0.
        level: usize,
    },
    /// Weights ask for a record at a level that it does not belong to.
    #[error("level {level}, record {record}: has a weight, and does not belong to the level")]
    NoRun {
        /// Position of the level, counted from 0.
        level: usize,
        /// Position of the record, counted from 0.
        record: usize,
    },
    /// A sample of records is empty or too large.
    #[error("record sample: {size} draws: between 1 and {MAX_SAMPLE_SIZE} are possible")]
    SampleSize {
        /// Number of draws.
        size: u64,
    },
    /// A target rate is not positive and finite.
    #[error("target rate {rate} per year: it must be positive and finite, for example 0.000404 (2 % in 50 years)")]
    Target {
        /// The offending rate, 1/yr.
        rate: f64,
    },
    /// A target rate that no fragility exceeds on this hazard curve.
    #[error(
        "target rate {target} per year: the hazard curve begins at {most} per year, and nothing fails more often than \
         the ground moves: give a rarer target"
    )]
    AboveHazard {
        /// The offending rate, 1/yr.
        target: f64,
        /// Rate of the curve's first abscissa, 1/yr.
        most: f64,
    },
    /// A grid of thresholds does not start at 0 or does not rise.
    #[error(
        "threshold {index} is {value} m: thresholds must be finite, start at 0 and increase strictly; \
         two at least are needed"
    )]
    Grid {
        /// Position of the threshold, counted from 0.
        index: usize,
        /// The offending threshold, m (NaN where it is missing).
        value: f64,
    },
}

/// Whether there are as many as expected.
///
/// # Errors
/// [`RiskError::Count`] if there are not.
pub fn check_count(what: &'static str, found: usize, expected: usize) -> Result<(), RiskError> {
    if found == expected { Ok(()) } else { Err(RiskError::Count { what, found, expected }) }
}

/// Whether a rate can be a target, 1/yr.
///
/// # Errors
/// [`RiskError::Target`] if it is not positive and finite.
pub fn check_target(rate: f64) -> Result<(), RiskError> {
    if rate.is_finite() && rate > 0.0 { Ok(()) } else { Err(RiskError::Target { rate }) }
}
