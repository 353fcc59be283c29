//! The same ordinates for thousands of record samples: λ split by record, so that a resample costs a few dot products.
//!
//! λ(c) = Σ m(record)/n · W(record, c), where W is what the runs of one record with EDP > c weigh together. W is stored
//! at every [`BLOCK`]-th demand of the pool. A search over these gives the block that holds the ordinate, a walk
//! through the block the ordinate itself. Sums are in double precision with their error bound; where it leaves doubt
//! whether λ ≤ target, the exact sum of [`RiskCurve`] decides. So the ordinates are those of
//! [`RiskCurve::exact_ordinate`], to the bit.

// what is not inlined into a search is not compiled for the instructions that it is compiled for
#![allow(clippy::inline_always)]

use uplift_instructions::{Instructions, LANES, Vectors, Work, by_halves};

use crate::fixed_point::{QUANTUM_PER_YEAR, rate_per_year};
use crate::{PooledDemand, RecordSample, RiskCurve, RiskError, StripeWeights};

/// Demands between two rows of the table.
const BLOCK: usize = 32;

/// The risk of one oscillator at one site, split by record: for many samples of the records.
///
/// Memory: 8 bytes for each record and each 32nd run, 0.23 MB for 105 records at 82 levels.
#[derive(Debug, Clone)]
pub struct ResamplingTable<'a> {
    demand: &'a PooledDemand,
    weights: &'a StripeWeights,
    /// `[block, record]`: weight of the runs of a record before the block, 1/yr; rows are padded to whole lanes.
    before: Vec<f64>,
    /// Weight of each stripe, 1/yr.
    per_year: Vec<f64>,
    row: usize,
    /// Bound on the relative error of a sum.
    error: f64,
}

impl<'a> ResamplingTable<'a> {
    /// Splits the risk of `demand` by record.
    ///
    /// # Errors
    /// Demand and weights with different numbers of levels.
    pub fn new(demand: &'a PooledDemand, weights: &'a StripeWeights) -> Result<Self, RiskError> {
        RiskCurve::new(demand, weights)?;
        if demand.shares().is_some() {
            // what a record weighs depends on the others of its level in the sample: the exact curve does it all
            return Ok(Self { demand, weights, before: Vec::new(), per_year: Vec::new(), row: 0, error: 0.0 });
        }
        let row = demand.record_count().next_multiple_of(LANES);
        let quanta = weights.quanta();
        let (mut sums, mut rates) = (vec![0_u128; demand.record_count()], vec![0.0; row]);
        let mut before = Vec::with_capacity((demand.runs().len() / BLOCK + 1) * row);
        for block in demand.runs().chunks(BLOCK) {
            before.extend_from_slice(&rates);
            for run in block {
                let (sum, rate) = (&mut sums[usize::from(run.record)], &mut rates[usize::from(run.record)]);
                *sum += quanta[usize::from(run.level)];
                *rate = rate_per_year(*sum, 1);
            }
        }
        // every term of a sum is rounded once or twice and passes through at most so many additions
        let error = (row + BLOCK + 8) as f64 * f64::EPSILON;
        Ok(Self { demand, weights, before, per_year: weights.per_year(), row, error })
    }

    /// Exact ordinates of a sample, m, `[target]`: 0 where nothing is exceeded so often, +∞ where overturning alone is.
    ///
    /// - `targets_per_year`: target rates, 1/yr, `[target]`; rising targets are found fastest.
    /// - `ordinates_m`: receives the ordinates, `[target]`.
    ///
    /// # Errors
    /// A sample of another number of records, or one that leaves a level with records of its own without any; a target
    /// that is not positive and finite.
    ///
    /// # Panics
    /// Unless there is space for one ordinate a target, which is a bug of the caller.
    pub fn ordinates(
        &self,
        sample: &RecordSample,
        targets_per_year: &[f64],
        ordinates_m: &mut [f64],
    ) -> Result<(), RiskError> {
        assert_eq!(targets_per_year.len(), ordinates_m.len(), "one ordinate a target");
        // the exact curve also refuses what does not fit
        let exact = RiskCurve::resampled(self.demand, self.weights, sample)?;
        if self.demand.shares().is_some() {
            for (ordinate_m, ordinate) in ordinates_m.iter_mut().zip(exact.exact_ordinates(targets_per_year)?) {
                *ordinate_m = ordinate.displacement_m;
            }
            return Ok(());
        }
        let instructions = Instructions::chosen();
        for (&target, ordinate_m) in targets_per_year.iter().zip(ordinates_m) {
            if !target.is_finite() || target <= 0.0 {
                return Err(RiskError::Target { rate: target });
            }
            let search = Search { table: self, sample, limit: target * f64::from(sample.size()) };
            *ordinate_m = match instructions.run(search) {
                Some(displacement_m) => displacement_m,
                None => exact.exact_ordinate(target)?.displacement_m,
            };
        }
        Ok(())
    }
}

/// A search for the ordinate at which the sum of weights passes a limit; none where rounding leaves doubt.
struct Search<'a> {
    table: &'a ResamplingTable<'a>,
    sample: &'a RecordSample,
    /// The target rate times the size of the sample, 1/yr.
    limit: f64,
}

impl Work for Search<'_> {
    type Output = Option<f64>;

    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) -> Option<f64> {
        let Self { table, sample, limit } = self;
        let draws = sample.lanes();
        // the exact curve rounds the target to whole quanta
        let margin = limit * table.error + 2.0 * f64::from(sample.size()) * QUANTUM_PER_YEAR;
        let (surely_within, surely_beyond) = (limit - margin, limit + margin);
        let blocks = table.before.len() / table.row;
        // the last block that begins within the limit: the first begins with nothing
        let (mut low, mut high) = (0, blocks);
        let mut sum = 0.0;
        while high - low > 1 {
            let middle = usize::midpoint(low, high);
            let middle_sum = dot(vectors, draws, &table.before[middle * table.row..(middle + 1) * table.row]);
            if middle_sum < surely_within {
                (low, sum) = (middle, middle_sum);
            } else if middle_sum > surely_beyond {
                high = middle;
            } else {
                return None;
            }
        }
        let start = low * BLOCK;
        let (edp_m, runs) = (table.demand.edp_m(), table.demand.runs());
        for (run, &demand_m) in runs[start..].iter().zip(&edp_m[start..]) {
            sum += draws[usize::from(run.record)] * table.per_year[usize::from(run.level)];
            if sum > surely_beyond {
                return Some(demand_m);
            }
            if sum >= surely_within {
                return None;
            }
        }
        Some(0.0)
    }
}

/// Scalar product; both of the same whole number of lanes.
#[inline(always)]
fn dot<V: Vectors>(vectors: V, a: &[f64], b: &[f64]) -> f64 {
    let mut sums = vectors.splat(0.0);
    for (a, b) in a.as_chunks().0.iter().zip(b.as_chunks().0) {
        sums = vectors.add(sums, vectors.mul(vectors.load(a), vectors.load(b)));
    }
    by_halves(vectors.store(sums), |a, b| a + b)
}
