//! The ordinates of a few replicates, where every run of each has a weight of its own.
//!
//! A replicate whose records are weighed anew has no table that could be shared with others, as
//! [`ResamplingTable`](crate::ResamplingTable) is. Its weights are summed up once, over the levels of each record, and
//! with these sums an ordinate of any oscillator is found by few additions (`stretches.rs`). Weights are whole numbers,
//! so the ordinates are those of [`RiskCurve::weighted`](crate::RiskCurve::weighted), to the bit.

use uplift_instructions::{Instructions, Vectors, Work};

use crate::error::check_count;
use crate::run_weights::UnitScale;
use crate::stretches::{LANES, LaneWeights};
use crate::{PooledDemand, RiskError, StripeWeights};

/// Replicates whose weights lie side by side.
pub const REPLICATES_AT_ONCE: usize = LANES;

/// Runs by which the first ordinate of a target may lie earlier than that of the strength before, most often.
const MARGIN: usize = 32;

/// The weights of all runs for up to [`REPLICATES_AT_ONCE`] replicates at one site: room that is used again and again.
#[derive(Debug, Clone)]
pub struct ReplicateWeights {
    scale: UnitScale,
    record_count: usize,
    /// How many replicates have been weighed.
    replicates: usize,
    /// Their weights, in units.
    weights: LaneWeights,
    /// Where the first ordinate of each target was found last, `[target]`: that of the next strength is near.
    first: Vec<usize>,
}

impl ReplicateWeights {
    /// Room for replicates of `record_count` records at the stripes of one site.
    pub fn new(stripes: &StripeWeights, record_count: usize) -> Self {
        let weights = LaneWeights::new(record_count, stripes.level_count());
        Self { scale: UnitScale::new(stripes), record_count, replicates: 0, weights, first: Vec::new() }
    }

    /// Weighs replicates by their shares, `[replicate][level, record]`, as [`RunWeights::new`](crate::RunWeights::new)
    /// does.
    ///
    /// # Errors
    /// As there.
    ///
    /// # Panics
    /// If there are more than [`REPLICATES_AT_ONCE`], which is a bug of the caller.
    pub fn weigh(&mut self, shares: &[&[f64]]) -> Result<(), RiskError> {
        let records = self.record_count;
        self.replicates = shares.len();
        assert!(self.replicates <= REPLICATES_AT_ONCE, "{} replicates of {REPLICATES_AT_ONCE}", self.replicates);
        shares.iter().try_for_each(|shares| self.scale.check(shares, records))?;
        Instructions::chosen().run(Weighing { scale: &self.scale, shares, records, weights: &mut self.weights });
        Ok(())
    }

    /// Exact ordinates of the weighed replicates, m, `[replicate, target]`: 0 where nothing is exceeded so often, +∞
    /// where overturning alone is.
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
        &mut self,
        demand: &PooledDemand,
        targets_per_year: &[f64],
        ordinates_m: &mut [f64],
    ) -> Result<(), RiskError> {
        let targets = targets_per_year.len();
        assert_eq!(ordinates_m.len(), self.replicates * targets, "one ordinate a replicate and target");
        check_count("records with shares", self.record_count, demand.record_count())?;
        check_count("stripe weights", self.scale.level_count(), demand.level_count())?;
        let limits =
            targets_per_year.iter().map(|&target| self.scale.limit(target)).collect::<Result<Vec<_>, RiskError>>()?;
        let (demands_m, stretches) = (demand.edp_m(), demand.stretches());
        self.first.resize(targets, 0);
        for (target, (&limit, first)) in limits.iter().zip(&mut self.first).enumerate() {
            let (asked, near) = ((limit, self.replicates), first.saturating_sub(MARGIN));
            let found = stretches.crossings(&self.weights, asked, near);
            let found = &found[..self.replicates];
            for (replicate, &position) in found.iter().enumerate() {
                ordinates_m[replicate * targets + target] = demands_m.get(position).copied().unwrap_or(0.0);
            }
            *first = found.iter().copied().min().unwrap_or(0);
        }
        Ok(())
    }
}

/// See [`ReplicateWeights::weigh`].
struct Weighing<'a> {
    scale: &'a UnitScale,
    shares: &'a [&'a [f64]],
    records: usize,
    weights: &'a mut LaneWeights,
}

impl Work for Weighing<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Vectors>(self, _: V) -> Self::Output {
        let Self { scale, shares, records, weights } = self;
        weights.fill(|record, level| {
            let of = |shares: &&[f64]| scale.units(level, shares[level * records + record]);
            std::array::from_fn(|replicate| shares.get(replicate).map_or(0, of))
        });
    }
}
