//! What is asked of a structure that is not known exactly.

use uplift_ida::System;

use crate::hazard::Hazard;
use crate::risk::{OVERTURNING_M, capacity_m};

/// What is asked of the structures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Event {
    /// How often they overturn, 1/yr.
    Overturning,
    /// How often they exceed the capacity that each of them has, 1/yr.
    BeyondCapacity,
    /// The demand of this rate, 1/yr, on the structure, m.
    Demand(f64),
}

impl Event {
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Overturning => "overturning",
            Self::BeyondCapacity => "exceeding the capacity",
            Self::Demand(_) => "demand",
        }
    }

    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::Overturning | Self::BeyondCapacity => "1/yr",
            Self::Demand(_) => "m",
        }
    }

    /// Whether a `system` may do it at all, so that runs which do not show it are no proof of never.
    pub(super) fn may_happen(self, system: &System) -> bool {
        match self {
            Self::Overturning => system.can_overturn(),
            Self::BeyondCapacity => capacity_m(system).is_some(),
            Self::Demand(_) => false,
        }
    }

    /// What is exceeded, m of the oscillator; none of a demand, and where there is no capacity.
    pub(super) fn threshold_m(self, system: &System) -> Option<f64> {
        match self {
            Self::Overturning => Some(OVERTURNING_M),
            Self::BeyondCapacity => capacity_m(system),
            Self::Demand(_) => None,
        }
    }
}

#[derive(Debug)]
pub(crate) struct SiteQuestions<'a> {
    pub(crate) name: &'a str,
    pub(crate) hazard: &'a Hazard<'a>,
    /// Each with its answer for the structure as described.
    pub(crate) asked: Vec<(Event, f64)>,
}
