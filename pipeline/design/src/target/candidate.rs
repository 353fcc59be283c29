//! A value that is tried: the structures that it may be, and what their stripes say.

use uplift_ida::System;
use uplift_structure::EquivalentSystem;
use uplift_uniform_risk::EventRisk;

use super::TargetEvent;
use crate::certainty::Bands;
use crate::risk::{OVERTURNING_M, capacity_m};

/// The structures that a value may be.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    /// As described, with the value.
    pub(super) system: EquivalentSystem,
    /// The first of the yield and failure of its tendons, in its own displacement, m.
    pub(super) tendon_limit_m: Option<f64>,
    /// The oscillators that shake: one where all is known; else one a branch, or those of each record, one record after
    /// the other.
    pub(super) systems: Vec<System>,
}

/// A value that was analysed.
#[derive(Debug, Clone)]
pub(super) struct Attempt {
    pub(super) candidate: Candidate,
    /// On average over the structures that it may be.
    pub(super) risk: EventRisk,
    /// Its bands by the runs of this value alone; none of a structure that is not known exactly, of a single record,
    /// and where no run shows it.
    pub(super) bands: Option<Bands>,
    /// In which share of the structures that it may be it happens, `[record, level]`.
    pub(super) happens: Vec<f64>,
    /// What each record contributes on average by the mean hazard curve, 1/yr: their mean is the frequency, where
    /// records count alike.
    pub(super) record_per_year: Vec<f64>,
    /// The same by every weighted hazard curve, `[curve][record]`; none where there is but one.
    pub(super) by_branch: Vec<Vec<f64>>,
    /// The same risk of every branch; of one where all is known, and where each record has structures of its own.
    pub(super) structures: Vec<StructureRisk>,
}

/// The risk of one structure.
#[derive(Debug, Clone)]
pub(super) struct StructureRisk {
    pub(super) risk: EventRisk,
    /// What each record contributes, 1/yr.
    pub(super) record_per_year: Vec<f64>,
    /// The same by the hazard curve that goes with the structure; none where the site has but one.
    pub(super) with_hazard: Option<Vec<f64>>,
}

impl Attempt {
    pub(super) fn meets(&self, target_per_year: f64) -> bool {
        self.risk.per_year <= target_per_year
    }
}

impl Candidate {
    /// What must not be exceeded, m, in the displacement of the `oscillator`: Γ times it is the structure's.
    pub(super) fn threshold_m(&self, event: TargetEvent, oscillator: &System) -> f64 {
        let of_oscillator = |own_m: f64| own_m / self.system.participation();
        match event {
            TargetEvent::Beyond(displacement_m) => of_oscillator(displacement_m),
            TargetEvent::BeyondCapacity(factor) => capacity_m(oscillator).map_or(OVERTURNING_M, |own_m| own_m / factor),
            TargetEvent::BeyondLimit => {
                let limits_m = capacity_m(oscillator).into_iter().chain(self.tendon_limit_m.map(of_oscillator));
                limits_m.min_by(f64::total_cmp).unwrap_or(OVERTURNING_M)
            }
            TargetEvent::Overturning => OVERTURNING_M,
        }
    }
}
