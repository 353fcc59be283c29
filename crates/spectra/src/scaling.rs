//! How the motions of a set are scaled.

use std::fmt;

use uplift_motion::IntensityMeasure;

/// Whose peak is brought to the target. The dissertation does not say which of the two it took.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ScaledBy {
    /// Every component by its own peak: all motions of the set have the same peak.
    Component,
    /// Both components of a record by the geometric mean of their peaks: they keep their ratio.
    Record,
}

impl ScaledBy {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Component, Self::Record];

    /// Its word in files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Component => "component",
            Self::Record => "record",
        }
    }
}

/// How a set is scaled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scaling {
    /// As recorded.
    Unscaled,
    /// To a multiple of the set's median, Eq. 2.16 or 2.17.
    To {
        /// Of which peak.
        measure: IntensityMeasure,
        /// The multiple, 0.5, 1 and 2 in the dissertation.
        multiple: f64,
        /// Whose peak.
        by: ScaledBy,
    },
}

impl fmt::Display for Scaling {
    /// `unscaled`, or `0.5 PGA`; whose peak is not said.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unscaled => f.write_str("unscaled"),
            Self::To { measure, multiple, .. } => write!(f, "{multiple} {}", measure.label()),
        }
    }
}
