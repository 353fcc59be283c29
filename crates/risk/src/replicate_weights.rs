//! The ordinates of a few replicates at once, where every run of each has a weight of its own.
//!
//! A replicate whose records are weighed anew has no table that could be shared with others, as
//! [`ResamplingTable`](crate::ResamplingTable) is. So its runs are walked in the order of falling demand, until the
//! last target is crossed; that order is shared by [`REPLICATES_AT_ONCE`] replicates, whose weights lie side by side
//! for the processor to add at once. Weights are whole numbers, so the ordinates are those of
//! [`RiskCurve::weighted`](crate::RiskCurve::weighted), to the bit.

use crate::run_weights::UnitScale;
use crate::{PooledDemand, RiskError, StripeWeights};

/// Replicates whose weights lie side by side.
pub const REPLICATES_AT_ONCE: usize = 8;

/// Runs that are added before the limits are looked at.
const BLOCK: usize = 16;

/// The weights of all runs for up to [`REPLICATES_AT_ONCE`] replicates at one site: room that is used again and again.
#[derive(Debug, Clone)]
pub struct ReplicateWeights {
    scale: UnitScale,
    record_count: usize,
    /// Weights in units, `[level, record][replicate]`.
    units: Vec<[u64; REPLICATES_AT_ONCE]>,
}

impl ReplicateWeights {
    /// Room for replicates of `record_count` records at the stripes of one site.
    pub fn new(stripes: &StripeWeights, record_count: usize) -> Self {
        let units = vec![[0; REPLICATES_AT_ONCE]; stripes.level_count() * record_count];
        Self { scale: UnitScale::new(stripes), record_count, units }
    }

    /// Weighs one of the replicates by its shares, `[level, record]`, as [`RunWeights::new`](crate::RunWeights::new)
    /// does.
    ///
    /// # Errors
    /// As there.
    ///
    /// # Panics
    /// Unless `replicate` is below [`REPLICATES_AT_ONCE`], which is a bug of the caller.
    pub fn weigh(&mut self, replicate: usize, shares: &[f64]) -> Result<(), RiskError> {
        assert!(replicate < REPLICATES_AT_ONCE, "replicate {replicate} of {REPLICATES_AT_ONCE}");
        let units = &mut self.units;
        self.scale.weigh(shares, self.record_count, |cell, weight| units[cell][replicate] = weight)
    }

    /// Exact ordinates of the first `replicates` replicates, m, `[replicate, target]`: 0 where nothing is exceeded so
    /// often, +∞ where overturning alone is.
    ///
    /// - `targets_per_year`: target rates, 1/yr, `[target]`.
    /// - `ordinates_m`: receives the ordinates, `[replicate, target]`.
    ///
    /// # Errors
    /// Demand of another number of records or levels; a target that is not positive and finite.
    ///
    /// # Panics
    /// Unless there is space for one ordinate a replicate and target, which is a bug of the caller.
    pub fn ordinates(
        &self,
        demand: &PooledDemand,
        replicates: usize,
        targets_per_year: &[f64],
        ordinates_m: &mut [f64],
    ) -> Result<(), RiskError> {
        let targets = targets_per_year.len();
        assert!(replicates <= REPLICATES_AT_ONCE, "{replicates} replicates of {REPLICATES_AT_ONCE}");
        assert_eq!(ordinates_m.len(), replicates * targets, "one ordinate a replicate and target");
        for (what, found, expected) in [
            ("records with shares", self.record_count, demand.record_count()),
            ("stripe weights", self.scale.level_count(), demand.level_count()),
        ] {
            if found != expected {
                return Err(RiskError::Count { what, found, expected });
            }
        }
        let mut limits = targets_per_year
            .iter()
            .enumerate()
            .map(|(position, &target)| Ok((self.scale.limit(target)?, position)))
            .collect::<Result<Vec<_>, RiskError>>()?;
        // demands fall during the walk and rates rise: the rarest target is met first
        limits.sort_unstable();
        ordinates_m.fill(0.0);

        let limit_of = |met: usize| limits.get(met).map_or(u64::MAX, |limit| limit.0);
        let mut met = [0; REPLICATES_AT_ONCE];
        let mut limit = [u64::MAX; REPLICATES_AT_ONCE];
        limit[..replicates].fill(limit_of(0));
        let mut open = replicates * targets;
        let mut sums = [0_u64; REPLICATES_AT_ONCE];
        for (runs, demands_m) in demand.runs().chunks(BLOCK).zip(demand.edp_m().chunks(BLOCK)) {
            if open == 0 {
                break;
            }
            let units_of = |run: &crate::demand::Run| {
                &self.units[usize::from(run.level) * self.record_count + usize::from(run.record)]
            };
            let mut after = sums;
            for run in runs {
                for (sum, units) in after.iter_mut().zip(units_of(run)) {
                    *sum += units;
                }
            }
            if after.iter().zip(&limit).any(|(sum, limit)| sum > limit) {
                // the same block again, one run after the other
                for (run, &demand_m) in runs.iter().zip(demands_m) {
                    for (replicate, units) in units_of(run).iter().enumerate() {
                        sums[replicate] += units;
                        while sums[replicate] > limit[replicate] {
                            ordinates_m[replicate * targets + limits[met[replicate]].1] = demand_m;
                            met[replicate] += 1;
                            limit[replicate] = limit_of(met[replicate]);
                            open -= 1;
                        }
                    }
                }
            }
            sums = after;
        }
        Ok(())
    }
}
