//! The same ordinates for thousands of record samples: λ split by record, so that a resample costs a few dot products.
//!
//! λ(c) = Σ m(record)/n · W(record, c), where W is what the runs of one record with EDP > c weigh together. W is stored
//! at every [`BLOCK`]-th demand of the pool. A search over these gives the block that holds the ordinate, a walk
//! through the block the ordinate itself. Sums are in double precision with their error bound; where it leaves doubt
//! whether λ ≤ target, the exact sum of [`RiskCurve`] decides. So the ordinates are those of
//! [`RiskCurve::exact_ordinate`], to the bit.

use std::hint::select_unpredictable;

use uplift_instructions::{Instructions, LANES, Vectors, Work, by_halves};

use crate::error::check_target;
use crate::fixed_point::{QUANTUM_PER_YEAR, rate_per_year};
use crate::sample::Lanes;
use crate::{PooledDemand, RecordSample, RiskCurve, RiskError, StripeWeights};

/// Demands between two rows of the table.
const BLOCK: usize = 32;
/// Searches side by side.
const TOGETHER: usize = 4;

/// The risk of one oscillator at one site, split by record: for many samples of the records.
///
/// Memory: 8 bytes for each record and each 32nd run, 0.23 MB for 105 records at 82 levels.
#[derive(Debug, Clone)]
pub struct ResamplingTable<'a> {
    demand: &'a PooledDemand,
    weights: &'a StripeWeights,
    /// `[block, record]`: weight of the runs of a record before the block, 1/yr; a row is of whole lanes.
    before: Vec<Lanes>,
    /// Weight of each stripe, 1/yr.
    per_year: Vec<f64>,
    /// What all records have before each block, over their number, 1/yr.
    means: Vec<f64>,
    /// Lanes of a row.
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
            return Ok(Self {
                demand,
                weights,
                before: Vec::new(),
                means: Vec::new(),
                per_year: Vec::new(),
                row: 0,
                error: 0.0,
            });
        }
        let records = demand.record_count();
        let row = records.div_ceil(LANES);
        let quanta = weights.quanta();
        let (mut sums, mut rates) = (vec![0_u128; records], vec![0.0; records]);
        let blocks = demand.runs().len() / BLOCK + 1;
        let (mut before, mut means) = (Vec::with_capacity(blocks * row), Vec::with_capacity(blocks));
        for block in demand.runs().chunks(BLOCK) {
            before.extend(Lanes::from_numbers(&rates));
            means.push(rates.iter().sum::<f64>() / records as f64);
            for run in block {
                let (sum, rate) = (&mut sums[usize::from(run.record)], &mut rates[usize::from(run.record)]);
                *sum += quanta[usize::from(run.level)];
                *rate = rate_per_year(*sum, 1);
            }
        }
        // every term of a sum is rounded once or twice and passes through at most so many additions
        let error = (row * LANES + BLOCK + 8) as f64 * f64::EPSILON;
        Ok(Self { demand, weights, before, means, per_year: weights.per_year(), row, error })
    }

    /// Exact ordinates of samples, m, `[target, sample]`: 0 where nothing is exceeded so often, +∞ where overturning
    /// alone is.
    ///
    /// - `targets_per_year`: target rates, 1/yr, `[target]`.
    /// - `ordinates_m`: receives the ordinates, `[target, sample]`.
    ///
    /// # Errors
    /// A sample of another number of records, or one that leaves a level with records of its own without any; a target
    /// that is not positive and finite.
    ///
    /// # Panics
    /// Unless there is space for one ordinate a sample and target, which is a bug of the caller.
    pub fn ordinates(
        &self,
        samples: &[RecordSample],
        targets_per_year: &[f64],
        ordinates_m: &mut [f64],
    ) -> Result<(), RiskError> {
        assert_eq!(samples.len() * targets_per_year.len(), ordinates_m.len(), "one ordinate a sample and target");
        // the exact curve also refuses what does not fit
        let exact = |sample| RiskCurve::resampled(self.demand, self.weights, sample);
        if self.demand.shares().is_some() {
            for (place, sample) in samples.iter().enumerate() {
                for (target, found) in exact(sample)?.exact_ordinates(targets_per_year)?.into_iter().enumerate() {
                    ordinates_m[target * samples.len() + place] = found.displacement_m;
                }
            }
            return Ok(());
        }
        samples.iter().try_for_each(|sample| exact(sample).map(drop))?;
        targets_per_year.iter().try_for_each(|&target| check_target(target))?;
        let instructions = Instructions::chosen();
        let rows_m = ordinates_m.chunks_exact_mut(samples.len().max(1));
        for (&target_per_year, row_m) in targets_per_year.iter().zip(rows_m) {
            let near = self.means.partition_point(|&mean| mean <= target_per_year);
            for (samples, found_m) in samples.chunks(TOGETHER).zip(row_m.chunks_mut(TOGETHER)) {
                // where fewer are left, the last is sought more than once
                let all = std::array::from_fn(|place| &samples[place.min(samples.len() - 1)]);
                let found = instructions.run(Searches { table: self, samples: all, target_per_year, near });
                for ((sample, found_m), found) in samples.iter().zip(found_m).zip(found) {
                    *found_m = match found {
                        Some(displacement_m) => displacement_m,
                        None => exact(sample)?.exact_ordinate(target_per_year)?.displacement_m,
                    };
                }
            }
        }
        Ok(())
    }

    /// The first demand from the run at `start` on at which the sum of the weights of a sample is beyond the limit;
    /// none where that is in doubt.
    #[inline(always)]
    fn walk(&self, sample: &RecordSample, (start, mut sum): (usize, f64), [within, beyond]: [f64; 2]) -> Option<f64> {
        let draws = sample.multiplicities();
        for (run, &demand_m) in self.demand.runs()[start..].iter().zip(&self.demand.edp_m()[start..]) {
            sum += f64::from(draws[usize::from(run.record)]) * self.per_year[usize::from(run.level)];
            if sum > beyond {
                return Some(demand_m);
            }
            if sum >= within {
                return None;
            }
        }
        Some(0.0)
    }
}

/// Searches for the ordinates at which the rates of samples pass a target: side by side, so that the processor waits
/// for none of them.
struct Searches<'a> {
    table: &'a ResamplingTable<'a>,
    samples: [&'a RecordSample; TOGETHER],
    target_per_year: f64,
    /// The first block before which all records pass the target.
    near: usize,
}

impl Work for Searches<'_> {
    /// None where rounding leaves doubt.
    type Output = [Option<f64>; TOGETHER];

    #[inline(always)]
    fn run<V: Vectors>(self, vectors: V) -> Self::Output {
        let Self { table, samples, target_per_year, near } = self;
        // between these limits of the sum of weights there is doubt
        let doubtful = samples.map(|sample| {
            let limit = target_per_year * f64::from(sample.size());
            // the exact curve rounds the target to whole quanta
            let margin = limit * table.error + 2.0 * f64::from(sample.size()) * QUANTUM_PER_YEAR;
            [limit - margin, limit + margin]
        });
        let blocks = table.before.len() / table.row;
        // the last block that begins within the limit: the first begins with nothing
        let (mut low, mut high) = ([0; TOGETHER], [blocks; TOGETHER]);
        // from where all records pass the target with longer and longer steps, until the block lies between two
        let (mut places, mut step) = ([near.clamp(1, blocks.max(2) - 1); TOGETHER], 1);
        let (mut sums, mut is_doubtful) = ([0.0_f64.to_bits(); TOGETHER], [false; TOGETHER]);
        while (0..TOGETHER).any(|at| high[at] > low[at] + 1) {
            for at in 0..TOGETHER {
                let place = places[at];
                let row = &table.before[place * table.row..(place + 1) * table.row];
                let sum = dot(vectors, samples[at].lanes(), row);
                let (is_within, is_beyond) = (sum < doubtful[at][0], sum > doubtful[at][1]);
                is_doubtful[at] |= !(is_within || is_beyond);
                low[at] = select_unpredictable(is_within, place, low[at]);
                high[at] = select_unpredictable(is_within, high[at], place);
                sums[at] = select_unpredictable(is_within, sum.to_bits(), sums[at]);
                let middle = usize::midpoint(low[at], high[at]);
                let (up, down) = (middle.min(place + step), middle.max(place.saturating_sub(step)));
                places[at] = select_unpredictable(is_within, up, down);
            }
            step = step.saturating_mul(2);
        }
        std::array::from_fn(|at| {
            if is_doubtful[at] {
                None
            } else {
                table.walk(samples[at], (low[at] * BLOCK, f64::from_bits(sums[at])), doubtful[at])
            }
        })
    }
}

/// Scalar product.
#[inline(always)]
fn dot<V: Vectors>(vectors: V, a: &[Lanes], b: &[Lanes]) -> f64 {
    let mut sums = vectors.splat(0.0);
    for (Lanes(a), Lanes(b)) in a.iter().zip(b) {
        sums = vectors.add(sums, vectors.mul(vectors.load(a), vectors.load(b)));
    }
    by_halves(vectors.store(sums), |a, b| a + b)
}
