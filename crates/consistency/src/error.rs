//! What hazard consistency cannot be asked of.

use thiserror::Error;
use uplift_fragility::FragilityError;
use uplift_hazard::HazardError;
use uplift_risk::RiskError;

use crate::NoRepair;

/// Why there is no diagnosis, or no repair.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ConsistencyError {
    /// A set of no records.
    #[error("the record set is empty: give at least one record, and 20 for a repair")]
    NoRecords,
    /// An intensity that cannot be scaled.
    #[error("record {record}, counted from 0: its {what} is {value}: it must be finite and above 0")]
    Intensity {
        /// Position of the record, counted from 0.
        record: usize,
        /// Which intensity.
        what: &'static str,
        /// Its value, in the unit of its curve.
        value: f64,
    },
    /// No target rate.
    #[error("no target rate given: the range of rates that are compared follows from them")]
    NoTargets,
    /// A target rate that is none.
    #[error("target rate {rate} per year: it must be positive and finite, for example 0.000404 (2 % in 50 years)")]
    Target {
        /// The rate, 1/yr.
        rate: f64,
    },
    /// A smoothness that is none.
    #[error("consistency.smoothness is {value}: it must be finite and 0 or more; 0.05 is usual")]
    Smoothness {
        /// The value.
        value: f64,
    },
    /// Multiplicities or shares of another shape than the analysis.
    #[error("{found} {what} given, {expected} expected: they do not belong to this record set")]
    Count {
        /// What was counted.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A sample that draws no record.
    #[error("the sample draws no record: at least one multiplicity must be above 0")]
    NothingDrawn,
    /// The set cannot be repaired; [`NoRepair::sentence`] says it in the words of a site.
    #[error("the records cannot be weighted to the site's hazard: {0:?}")]
    NoRepair(NoRepair),
    /// A curve refused a level or a rate.
    #[error(transparent)]
    Hazard(#[from] HazardError),
    /// Stripe levels were refused.
    #[error(transparent)]
    Stripes(#[from] FragilityError),
    /// Weights were refused.
    #[error(transparent)]
    Risk(#[from] RiskError),
}
