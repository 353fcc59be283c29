//! The ordinates of one strength for all replicates.

use uplift_risk::{PooledDemand, ResamplingTable, StripeWeights};

use crate::{BootstrapError, ResamplingPlan};

/// Ordinates of one oscillator, m, `[site, target, size, replicate]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Replicates {
    ordinates_m: Vec<f64>,
    targets: usize,
    sizes: usize,
    per_size: usize,
}

impl Replicates {
    /// The exact ordinates of every replicate of `plan`.
    ///
    /// - `demand`: all runs of the oscillator.
    /// - `sites`: the hazard of each site, as weights of the stripes.
    /// - `targets_per_year`: target rates, 1/yr.
    ///
    /// # Errors
    /// Parts with different numbers of levels or records; a target that is not positive and finite.
    pub fn from_plan(
        demand: &PooledDemand,
        sites: &[&StripeWeights],
        targets_per_year: &[f64],
        plan: &ResamplingPlan,
    ) -> Result<Self, BootstrapError> {
        let (targets, samples) = (targets_per_year.len(), plan.samples().len());
        let mut ordinates_m = vec![0.0; sites.len() * targets * samples];
        for (weights, of_site_m) in sites.iter().zip(ordinates_m.chunks_exact_mut((targets * samples).max(1))) {
            ResamplingTable::new(demand, weights)?.ordinates(plan.samples(), targets_per_year, of_site_m)?;
        }
        Ok(Self { ordinates_m, targets, sizes: plan.sizes().len(), per_size: plan.replicates() })
    }

    /// The ordinates of one site, target and size, m, `[replicate]`.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn ordinates_m(&self, site: usize, target: usize, size: usize) -> &[f64] {
        assert!(target < self.targets && size < self.sizes, "target and size within the plan");
        let start = ((site * self.targets + target) * self.sizes + size) * self.per_size;
        &self.ordinates_m[start..start + self.per_size]
    }
}
