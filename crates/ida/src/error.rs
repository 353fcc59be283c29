//! What can be wrong with a plan, or end an analysis.

use thiserror::Error;
use uplift_oscillator::OscillatorError;

/// Why an incremental dynamic analysis cannot be planned or finished.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum IdaError {
    /// One of the three axes of the analysis is empty.
    #[error("the analysis has no {what}: give at least one")]
    Empty {
        /// Records, strengths, blocks or levels.
        what: &'static str,
    },
    /// A level is not positive and finite, or does not exceed the one before.
    #[error("intensity level {index} is {value} after {before}: levels must be positive, finite and ascending")]
    Levels {
        /// Index of the level, from 0.
        index: usize,
        /// Its value, in the unit of the measure.
        value: f64,
        /// The level before, 0 for the first.
        before: f64,
    },
    /// A record whose intensity is zero cannot be scaled to a level.
    #[error("record {record}: its intensity measure is {value}, so it cannot be scaled; leave the record out")]
    Unscalable {
        /// Identifier of the record.
        record: String,
        /// Its intensity measure.
        value: f64,
    },
    /// The record or the scale factor does not suit the oscillator.
    #[error("record {record}: {source}")]
    Oscillator {
        /// Identifier of the record.
        record: String,
        /// What is wrong.
        source: OscillatorError,
    },
    /// The motion of a block under a record is not computed.
    #[error("record {record}: {reason}")]
    Block {
        /// Identifier of the record.
        record: String,
        /// What is wrong.
        reason: String,
    },
    /// The analysis was told to stop.
    #[error("the analysis was interrupted")]
    Cancelled,
}
