//! Two horizontal components of one ground motion.

use std::collections::BTreeMap;
use std::fmt;

use crate::accelerogram::Accelerogram;

/// One of the two horizontal components of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Horizontal {
    /// The first component.
    H1,
    /// The second component.
    H2,
}

impl fmt::Display for Horizontal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::H1 => "h1",
            Self::H2 => "h2",
        })
    }
}

/// The two horizontal components of one ground motion.
///
/// They need not have the same length, time step or start.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordPair {
    /// Name of the record in tables and results.
    pub id: String,
    /// First horizontal component.
    pub h1: Accelerogram,
    /// Second horizontal component.
    pub h2: Accelerogram,
    /// What is known about the record (event, magnitude, distance, …), as text.
    pub metadata: BTreeMap<String, String>,
}

impl RecordPair {
    /// One of the two accelerograms.
    pub fn component(&self, which: Horizontal) -> &Accelerogram {
        match which {
            Horizontal::H1 => &self.h1,
            Horizontal::H2 => &self.h2,
        }
    }
}
