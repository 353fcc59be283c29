//! What can be wrong with stripes, thresholds and counts.

use thiserror::Error;

/// Why a fragility could not be made.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FragilityError {
    /// There is no level, or no record.
    #[error("stripes: {levels} levels and {records} records: at least one of each is needed")]
    Empty {
        /// Number of levels given.
        levels: usize,
        /// Number of records given.
        records: usize,
    },
    /// The demand array does not hold records × levels values.
    #[error(
        "stripes: {found} demands for {records} records of {levels} levels, {stride} values apart: \
         give the array [record, level] in row-major order"
    )]
    Shape {
        /// Number of values in the array.
        found: usize,
        /// Number of records expected.
        records: usize,
        /// Number of levels expected.
        levels: usize,
        /// Distance between the first values of two records.
        stride: usize,
    },
    /// A level is not positive and finite, or not above the level before it.
    #[error("level {index} is {value}: levels must be positive, finite and strictly increasing")]
    Level {
        /// Position of the level, counted from 0.
        index: usize,
        /// The offending level, in the unit of the intensity measure.
        value: f64,
    },
    /// A demand is negative or not a number.
    #[error(
        "record {record}, level {level}: demand {value} m: it must be zero or positive; \
         write infinity for an overturned structure"
    )]
    Demand {
        /// Position of the record, counted from 0.
        record: usize,
        /// Position of the level, counted from 0.
        level: usize,
        /// The offending demand, m.
        value: f64,
    },
    /// The shares of the records are not those of records × levels.
    #[error(
        "{found} shares of {records} records at {levels} levels: give the array [level, record] in row-major order"
    )]
    Shares {
        /// Number of shares given.
        found: usize,
        /// Number of levels.
        levels: usize,
        /// Number of records.
        records: usize,
    },
    /// The shares of the records at a level are not those of a whole.
    #[error("level {level}: shares of the records add up to {sum}: none may be negative, and all together must be 1")]
    ShareSum {
        /// Position of the level, counted from 0.
        level: usize,
        /// What they add up to.
        sum: f64,
    },
    /// A threshold is negative or not finite.
    #[error("threshold {value} m: a displacement threshold must be finite and zero or positive")]
    Threshold {
        /// The offending threshold, m.
        value: f64,
    },
    /// More exceedances than trials.
    #[error("level {level}: {exceedances} exceedances in {trials} trials: count each record once")]
    Count {
        /// The level, in the unit of the intensity measure.
        level: f64,
        /// Number of exceedances given.
        exceedances: u32,
        /// Number of trials given.
        trials: u32,
    },
    /// A median or a dispersion is not positive and finite.
    #[error("lognormal fragility: {name} is {value}: it must be positive and finite")]
    Parameter {
        /// `median` or `dispersion`.
        name: &'static str,
        /// The offending value.
        value: f64,
    },
    /// The likelihood has no maximum: no exceedance anywhere.
    #[error("lognormal fit: no exceedance at any level: the median lies above the last level; use higher levels")]
    NoExceedance,
    /// The likelihood has no maximum: every trial exceeds.
    #[error("lognormal fit: every trial exceeds: the median lies below the first level; use lower levels")]
    AllExceed,
    /// The likelihood has no maximum: exceedances and survivals do not overlap, so the dispersion tends to zero.
    #[error(
        "lognormal fit: exceedances begin at level {first_exceedance} and survivals end at {last_survival}: \
         without overlap the dispersion is not identifiable; use levels closer together"
    )]
    Separated {
        /// The lowest level with an exceedance.
        first_exceedance: f64,
        /// The highest level with a survival.
        last_survival: f64,
    },
    /// The best fit does not rise with intensity.
    #[error("lognormal fit: exceedance does not become likelier with intensity: a lognormal fragility does not apply")]
    NotRising,
    /// A threshold that demands which count as zero reach.
    #[error(
        "zero-inflated fit: threshold {threshold_m} m: it must exceed the displacement at uplift, {uplift_m} m, up to \
         which demands count as zero"
    )]
    NotBeyondUplift {
        /// The threshold, m.
        threshold_m: f64,
        /// Displacement at uplift, m.
        uplift_m: f64,
    },
    /// Nothing scatters.
    #[error("spread of a lognormal fit: {units} independent records: at least two are needed")]
    TooFewUnits {
        /// Number of units given.
        units: usize,
    },
    /// An intensity of a surface is not positive and finite.
    #[error("fragility surface: an intensity of trial {index} is {value}: intensities must be positive and finite")]
    Intensity {
        /// Position of the trial, counted from 0.
        index: usize,
        /// The offending intensity.
        value: f64,
    },
    /// The two intensities of a surface cannot be told apart.
    #[error("fragility surface: both intensities rise and fall together, or one has a single value: use one of them")]
    Collinear,
    /// The likelihood of a surface has no maximum.
    #[error(
        "fragility surface: no fit: a line separates exceedances from survivals, or nearly so; use more records, or \
         levels closer together"
    )]
    NoSurface,
    /// The iteration came to no end.
    #[error("lognormal fit: no convergence after {iterations} iterations: use the empirical fragility")]
    NoConvergence {
        /// Number of iterations made.
        iterations: usize,
    },
}
