//! The oscillators of a structure under the records and the hazard of a site.

use uplift_risk::{Ordinate, PooledDemand, SiteWeights};
use uplift_structure::{EquivalentSystem, Rule, relative_error};
use uplift_uniform_risk::{EventRisk, Stripes, pooled_demand};

use super::certainty::Scatter;
use super::hazard::Hazard;
use super::limit::{FrameLimit, LimitRisk};
use super::risk::risk_of_exceeding;
use super::sweep::OWN;
use crate::error::DesignError;

/// The oscillators of a structure and of its neighbours under the records and the hazard of a site.
pub(super) struct Shaken<'a> {
    pub(super) weights: &'a SiteWeights<'a>,
    pub(super) system: &'a EquivalentSystem,
    /// Rate of the demand, 1/yr.
    pub(super) target_per_year: f64,
    years: f64,
    /// Of each oscillator.
    pub(super) demands: Vec<PooledDemand>,
    /// The demand on each, in the displacement of the structure.
    pub(super) ordinates: Vec<Ordinate>,
}

impl<'a> Shaken<'a> {
    /// Of `system`, so many `oscillators` with the `stripes` over `[record, oscillator, level]`, for a demand of
    /// `target_per_year` at the site of `weights`.
    pub(super) fn new(
        (stripes, oscillators): (&Stripes, usize),
        (weights, system): (&'a SiteWeights<'a>, &'a EquivalentSystem),
        (target_per_year, years): (f64, f64),
    ) -> Result<Self, DesignError> {
        let demands = (0..oscillators).map(|of| pooled_demand(stripes, of)).collect::<Result<Vec<_>, _>>()?;
        let ordinate = |demand: &PooledDemand| -> Result<Ordinate, DesignError> {
            let ordinate = weights.curve(demand)?.exact_ordinate(target_per_year)?;
            Ok(Ordinate { displacement_m: system.participation() * ordinate.displacement_m, ..ordinate })
        };
        let ordinates = demands.iter().map(ordinate).collect::<Result<_, _>>()?;
        Ok(Self { weights, system, target_per_year, years, demands, ordinates })
    }

    /// The demand on an oscillator, m.
    pub(super) fn displacement_m(&self, oscillator: usize) -> f64 {
        self.ordinates[oscillator].displacement_m
    }

    /// How often an oscillator exceeds `threshold_m`.
    pub(super) fn risk(&self, oscillator: usize, threshold_m: f64) -> Result<EventRisk, DesignError> {
        risk_of_exceeding(&self.demands[oscillator], self.weights, threshold_m, self.years)
    }

    /// How often the structure's own oscillator moves the structure to `limit`.
    pub(super) fn beyond_limit(
        &self,
        limit: FrameLimit,
        (hazard, scatter): (&Hazard<'_>, &Scatter),
    ) -> Result<LimitRisk, DesignError> {
        let threshold_m = limit.displacement_m / self.system.participation();
        LimitRisk::new(&self.demands[OWN], (hazard, self.weights.repaired()), scatter, (threshold_m, self.years))
    }

    /// Its rate, 1/yr.
    pub(super) fn per_year(&self, oscillator: usize, threshold_m: f64) -> Result<f64, DesignError> {
        Ok(self.risk(oscillator, threshold_m)?.per_year)
    }

    /// The demand by `rule`, m, from that on a ZSBE oscillator, and its error against that on the structure's; NaN
    /// where there is none to refer to.
    pub(super) fn by_rule(&self, rule: Rule, [zero, own]: [usize; 2]) -> Result<[f64; 2], DesignError> {
        let zero_m = self.displacement_m(zero);
        let demand_m = self.system.capacity().and_then(|capacity| rule.demand(&capacity, zero_m))?.displacement_m();
        Ok([demand_m, relative_error(demand_m, self.displacement_m(own)).unwrap_or(f64::NAN)])
    }
}
