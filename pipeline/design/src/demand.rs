//! The demand on a structure itself: its own oscillator put through the records and the hazard that a spectrum was made
//! from.

use serde::Serialize;
use uplift_uniform_risk::EventRisk;

use super::certainty::{DemandBands, Scatter, demand_bands};
use super::hazard::Hazard;
use super::risk::{OVERTURNING_M, bounded, oscillator_capacity_m};
use super::sensitivity::{Sensitivity, sensitivity};
use super::shaken::Shaken;
use super::sweep::{OF_STUDY, OWN, Sweep, ZERO_STIFFNESS};
use crate::error::DesignError;

/// What the structure's own stripes say, in its own displacement; infinite where it overturns more often than the
/// target.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExactDemand {
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Demand on the study's ZSBE oscillator at the structure's strength, m: what the spectrum has there, without
    /// interpolation.
    pub zero_stiffness_demand_of_spectrum_m: f64,
    /// Demand on the structure's own ZSBE oscillator, with its uplift displacement and restitution, m: what the rules
    /// start from.
    pub zero_stiffness_demand_m: f64,
    /// Demand on the structure, m.
    pub demand_m: f64,
    /// Displacement capacity less the demand on the structure, m; none for a structure without one.
    pub capacity_less_demand_m: Option<f64>,
    /// Whether it overturns more often than the target rate.
    pub overturns: bool,
    /// Share of the risk at the demand that comes from below the first stripe, 0 to 1.
    pub lower_tail_share: f64,
    /// Share of the risk at the demand that comes from above the last stripe, 0 to 1.
    pub upper_tail_share: f64,
    /// The displacement capacity is exceeded; none for a structure without one.
    pub beyond_capacity: Option<EventRisk>,
    /// It overturns.
    pub overturning: EventRisk,
    /// Confidence bands of these by the records; none of a single record.
    pub bands: Option<DemandBands>,
    /// What a small change of the strength and rounding make of it; none where that was not asked.
    #[serde(flatten)]
    pub sensitivity: Option<Sensitivity>,
}

/// The demand on the structure of `shaken`, whose oscillators are `sweep`, by so many `analyses`, exactly as spectra
/// are made; `hazard` is that of the site.
pub(super) fn exact_demand(
    shaken: &Shaken<'_>,
    analyses: u64,
    sweep: &Sweep,
    (hazard, scatter): (&Hazard<'_>, &Scatter),
) -> Result<ExactDemand, DesignError> {
    let Shaken { weights, system, target_per_year, .. } = *shaken;
    let factor = system.participation();
    // all of it is scaled by the same factor: the oscillator exceeds capacity/factor where the structure exceeds its
    // capacity
    let capacity_m = oscillator_capacity_m(&sweep.oscillators[OWN]);
    let may_happen = |risk: EventRisk| bounded(risk, weights, &scatter.pairs);
    let beyond = |capacity_m: f64| shaken.risk(OWN, capacity_m).map(may_happen);
    let overturning = shaken.risk(OWN, OVERTURNING_M)?;
    let demand = shaken.ordinates[OWN];
    let sensitivity = sweep.neighbours.as_ref().map(|of| sensitivity(shaken, of, capacity_m)).transpose()?;
    Ok(ExactDemand {
        bands: demand_bands(
            &shaken.demands[OWN],
            (hazard, weights.repaired()),
            scatter,
            (target_per_year, factor, capacity_m),
        )?,
        analyses,
        zero_stiffness_demand_of_spectrum_m: shaken.displacement_m(OF_STUDY),
        zero_stiffness_demand_m: shaken.displacement_m(ZERO_STIFFNESS),
        demand_m: demand.displacement_m,
        capacity_less_demand_m: capacity_m.map(|capacity_m| factor * capacity_m - demand.displacement_m),
        overturns: demand.displacement_m.is_infinite(),
        lower_tail_share: demand.lower_tail_share,
        upper_tail_share: demand.upper_tail_share,
        beyond_capacity: capacity_m.map(beyond).transpose()?,
        // what has no capacity cannot overturn
        overturning: if capacity_m.is_some() { may_happen(overturning) } else { overturning },
        sensitivity,
    })
}
