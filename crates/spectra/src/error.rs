//! What can be wrong.

use thiserror::Error;
use uplift_block::BlockError;
use uplift_ida::IdaError;
use uplift_oscillator::OscillatorError;
use uplift_structure::StructureError;

/// Why a displacement spectrum cannot be computed.
#[derive(Debug, Error)]
pub enum SpectraError {
    /// A set without records.
    #[error("record set {set:?} is empty: check its tag and what is left out of it")]
    EmptySet {
        /// Name of the set.
        set: String,
    },
    /// A component without motion, which no factor brings to a peak.
    #[error("{motion}: its {measure} is {value}, so it cannot be scaled; leave the record out")]
    Unscalable {
        /// The component.
        motion: String,
        /// The measure.
        measure: &'static str,
        /// Its value, in the measure's unit.
        value: f64,
    },
    /// A number out of its range.
    #[error("{name} = {value}: must be {requirement}")]
    OutOfRange {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        requirement: &'static str,
    },
    /// No slenderness of the search range lets the block stand, or every one does.
    #[error(
        "record set {set:?}, {scaling}: the demand meets the capacity line 2H tan(alpha) nowhere between \
         tan(alpha) = {lowest} and {highest}; widen the range"
    )]
    NoIntersection {
        /// Name of the set.
        set: String,
        /// How it is scaled.
        scaling: String,
        /// Lowest tangent searched.
        lowest: f64,
        /// Highest tangent searched.
        highest: f64,
    },
    /// Not a system that can be solved.
    #[error(transparent)]
    System(#[from] OscillatorError),
    /// Not a block that can be solved.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// A rule refused.
    #[error(transparent)]
    Rule(#[from] StructureError),
    /// An analysis that cannot be planned or finished, or was stopped from outside.
    #[error(transparent)]
    Analysis(#[from] IdaError),
}
