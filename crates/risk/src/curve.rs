//! λ(c): the mean annual frequency of exceeding a displacement, one oscillator at one site.

use std::borrow::Cow;

use uplift_fragility::check_threshold;

use crate::error::{check_count, check_target};
use crate::fixed_point::{MAX_RATE_PER_YEAR, quanta, rate_per_year};
use crate::grid::interpolate_log_rate;
use crate::{
    Disaggregation, Ordinate, OrdinateFlag, PooledDemand, RecordSample, RiskError, RunWeights, StripeWeights,
    ThresholdGrid,
};

/// The risk curve λ(c) of one oscillator at one site, for all records, for a sample of them, or for records that count
/// differently.
///
/// λ(c) = Σ w(level) m(record)/n, or Σ w(level) p(level, record), over the runs with EDP > c: a right-continuous step
/// function that falls at the demands. It is a view: nothing is computed before it is asked for, but for the weights of
/// runs whose levels have [records of their own](uplift_fragility::Stripes::with_shares).
#[derive(Debug, Clone)]
pub struct RiskCurve<'a> {
    demand: &'a PooledDemand,
    weights: &'a StripeWeights,
    counting: Counting<'a>,
    /// What the counts of the records at a level add up to.
    size: u32,
}

/// How much each record counts.
#[derive(Debug, Clone)]
enum Counting<'a> {
    /// Once.
    Once,
    /// As often as it was drawn.
    Drawn(&'a RecordSample),
    /// By its share at the level.
    Shared(Cow<'a, RunWeights>),
}

impl<'a> RiskCurve<'a> {
    /// Every record once, or by the shares of the demand where it has some.
    ///
    /// # Errors
    /// Demand and weights with different numbers of levels.
    pub fn new(demand: &'a PooledDemand, weights: &'a StripeWeights) -> Result<Self, RiskError> {
        check_count("stripe weights", weights.level_count(), demand.level_count())?;
        if let Some(shares) = demand.shares() {
            return Self::shared(demand, weights, shares);
        }
        // At most 65 535 records.
        let size = u32::try_from(demand.record_count()).unwrap_or(u32::MAX);
        Ok(Self { demand, weights, counting: Counting::Once, size })
    }

    /// Each record as often as the sample has it; where the demand has shares, these times as often, so that those of a
    /// level add up to 1 again.
    ///
    /// # Errors
    /// Demand and weights with different numbers of levels, demand and sample with different numbers of records; a
    /// level none of whose records is in the sample.
    pub fn resampled(
        demand: &'a PooledDemand,
        weights: &'a StripeWeights,
        sample: &'a RecordSample,
    ) -> Result<Self, RiskError> {
        check_count("multiplicities of records", sample.multiplicities().len(), demand.record_count())?;
        if let Some(shares) = demand.shares() {
            check_count("stripe weights", weights.level_count(), demand.level_count())?;
            return Self::shared(demand, weights, &sample.weigh(shares)?);
        }
        let curve = Self::new(demand, weights)?;
        Ok(Self { counting: Counting::Drawn(sample), size: sample.size(), ..curve })
    }

    /// Each record by its share at each level.
    ///
    /// # Errors
    /// Demand and weights with different numbers of levels or records; a weight of a record at a level that it does not
    /// belong to.
    pub fn weighted(demand: &'a PooledDemand, weights: &'a RunWeights) -> Result<Self, RiskError> {
        let records = weights.record_count();
        check_count("records with shares", records, demand.record_count())?;
        check_count("stripe weights", weights.stripes().level_count(), demand.level_count())?;
        if let Some(own) = demand.shares() {
            let no_run = weights.shares().iter().zip(own).position(|(&share, &own)| share > 0.0 && own == 0.0);
            if let Some(cell) = no_run {
                return Err(RiskError::NoRun { level: cell / records, record: cell % records });
            }
        }
        Ok(Self { demand, weights: weights.stripes(), counting: Counting::Shared(Cow::Borrowed(weights)), size: 1 })
    }

    fn shared(demand: &'a PooledDemand, weights: &'a StripeWeights, shares: &[f64]) -> Result<Self, RiskError> {
        let counting = Counting::Shared(Cow::Owned(RunWeights::new(weights, shares)?));
        Ok(Self { demand, weights, counting, size: 1 })
    }

    /// λ(c): mean annual frequency of exceeding `threshold_m`, 1/yr.
    ///
    /// # Errors
    /// A threshold that is negative or not finite.
    pub fn mean_annual_frequency(&self, threshold_m: f64) -> Result<f64, RiskError> {
        check_threshold(threshold_m)?;
        Ok(self.rate(self.sum(0, self.demand.exceeding(threshold_m))))
    }

    /// λ at every threshold of a grid, 1/yr, `[threshold]`: one row of the seismic risk surface (Fig. 4.4a).
    pub fn mean_annual_frequencies(&self, grid: &ThresholdGrid) -> Vec<f64> {
        let edp = self.demand.edp_m();
        let mut sweep = Sweep::default();
        let mut row: Vec<f64> = grid
            .thresholds_m()
            .iter()
            .rev()
            .map(|&threshold_m| {
                let more = edp[sweep.position..].iter().take_while(|&&edp| edp > threshold_m).count();
                sweep = self.advance(sweep, sweep.position + more);
                self.rate(sweep.sum)
            })
            .collect();
        row.reverse();
        row
    }

    /// The exact ordinate: the smallest displacement c ≥ 0 with λ(c) ≤ `target_per_year`.
    ///
    /// λ falls at demands only, so the ordinate is 0, one of the demands, or does not exist.
    ///
    /// # Errors
    /// A target that is not positive and finite.
    pub fn exact_ordinate(&self, target_per_year: f64) -> Result<Ordinate, RiskError> {
        let limit = self.limit(target_per_year)?;
        Ok(self.ordinate_at(self.crossing(Sweep::default(), limit)))
    }

    /// Exact ordinates for several targets, 1/yr, in one sweep, `[target]`.
    ///
    /// # Errors
    /// A target that is not positive and finite.
    pub fn exact_ordinates(&self, targets_per_year: &[f64]) -> Result<Vec<Ordinate>, RiskError> {
        let mut limits = targets_per_year
            .iter()
            .enumerate()
            .map(|(position, &target)| Ok((self.limit(target)?, position)))
            .collect::<Result<Vec<_>, RiskError>>()?;
        // Demands fall during the sweep and rates rise: the rarest target is met first.
        limits.sort_unstable();
        let mut ordinates = vec![NO_RISK; limits.len()];
        let mut sweep = Sweep::default();
        for (limit, position) in limits {
            sweep = self.crossing(sweep, limit);
            ordinates[position] = self.ordinate_at(sweep);
        }
        Ok(ordinates)
    }

    /// The ordinate as read off a grid: ln λ is linear between the two thresholds whose rates enclose the target.
    ///
    /// Grid and exact ordinate lie in the same step of the grid, and so differ by at most its width, in either
    /// direction. Where λ is 0 at the upper threshold, that threshold is taken. Beyond the last threshold the ordinate
    /// is censored: +∞, also where the exact one exists.
    ///
    /// # Errors
    /// A target that is not positive and finite.
    pub fn grid_ordinate(&self, grid: &ThresholdGrid, target_per_year: f64) -> Result<Ordinate, RiskError> {
        let exact = self.exact_ordinate(target_per_year)?;
        if exact.flag != OrdinateFlag::Regular {
            return Ok(exact);
        }
        // λ > target below the exact ordinate, λ ≤ target from it on: it tells which thresholds enclose the target.
        let thresholds = grid.thresholds_m();
        let upper = thresholds.partition_point(|&threshold| threshold < exact.displacement_m);
        let left_m = thresholds[upper - 1]; // the exact ordinate is positive, the first threshold is 0
        let Some(&right_m) = thresholds.get(upper) else {
            let left = self.advance(Sweep::default(), self.demand.exceeding(left_m));
            return Ok(self.ordinate(f64::INFINITY, OrdinateFlag::Censored, left));
        };
        let right = self.advance(Sweep::default(), self.demand.exceeding(right_m));
        let left = self.advance(right, self.demand.exceeding(left_m));
        let (left_rate, right_rate) = (self.rate(left.sum), self.rate(right.sum));
        let displacement_m = interpolate_log_rate((left_m, left_rate), (right_m, right_rate), target_per_year);
        Ok(self.ordinate(displacement_m, OrdinateFlag::Regular, left))
    }

    /// Empirical fragility of the sample at `threshold_m` (Eq. 4.7), `[level]`.
    ///
    /// # Errors
    /// A threshold that is negative or not finite.
    pub fn exceedance_probabilities(&self, threshold_m: f64) -> Result<Vec<f64>, RiskError> {
        check_threshold(threshold_m)?;
        let mut counts = vec![0.0; self.demand.level_count()];
        for run in &self.demand.runs()[..self.demand.exceeding(threshold_m)] {
            counts[usize::from(run.level)] += self.count(run.level, run.record);
        }
        // shares that were rounded may add up to a hair more than 1
        Ok(counts.into_iter().map(|count: f64| (count / f64::from(self.size)).min(1.0)).collect())
    }

    /// Where λ(`threshold_m`) comes from: interval by interval, and the tails.
    ///
    /// # Errors
    /// A threshold that is negative or not finite.
    pub fn disaggregation(&self, threshold_m: f64) -> Result<Disaggregation, RiskError> {
        self.weights.disaggregate(&self.exceedance_probabilities(threshold_m)?)
    }

    fn rate(&self, sum: u128) -> f64 {
        rate_per_year(sum, self.size)
    }

    /// How much a record counts at a level: a whole number but for shares, so that counts are added exactly.
    fn count(&self, level: u16, record: u16) -> f64 {
        let record = usize::from(record);
        match &self.counting {
            Counting::Once => 1.0,
            Counting::Drawn(sample) => f64::from(sample.multiplicities()[record]),
            Counting::Shared(weights) => weights.shares()[usize::from(level) * weights.record_count() + record],
        }
    }

    /// A target rate as the largest sum that meets it.
    fn limit(&self, target_per_year: f64) -> Result<u128, RiskError> {
        check_target(target_per_year)?;
        // No risk exceeds the largest hazard rate, so a larger target is met all the same.
        Ok(quanta(target_per_year.min(MAX_RATE_PER_YEAR)) * u128::from(self.size))
    }

    /// Exact sum of the weights of the runs `from..to`.
    fn sum(&self, from: usize, to: usize) -> u128 {
        let weights = self.weights.quanta();
        let runs = &self.demand.runs()[from..to];
        match &self.counting {
            Counting::Once => runs.iter().map(|run| weights[usize::from(run.level)]).sum(),
            Counting::Shared(shared) => {
                let (units, records) = (shared.units(), shared.record_count());
                // all units together fit 62 bits
                let sum =
                    runs.iter().map(|run| units[usize::from(run.level) * records + usize::from(run.record)]).sum();
                shared.quanta(sum)
            }
            Counting::Drawn(sample) => {
                let multiplicities = sample.multiplicities();
                let term =
                    |record, level| weights[usize::from(level)] * u128::from(multiplicities[usize::from(record)]);
                runs.iter().map(|run| term(run.record, run.level)).sum()
            }
        }
    }

    /// Goes on with a sweep, in the order of falling demand, to the first run whose inclusion lifts
    /// the sum above `limit`.
    fn crossing(&self, mut sweep: Sweep, limit: u128) -> Sweep {
        /// Sums are exact, so whole blocks may be added before looking.
        const BLOCK: usize = 64;
        let end = self.demand.runs().len();
        for stride in [BLOCK, 1] {
            while sweep.position < end {
                let next = self.advance(sweep, (sweep.position + stride).min(end));
                if next.sum > limit {
                    break;
                }
                sweep = next;
            }
        }
        sweep
    }

    /// Goes on with a sweep to the run at `position`.
    fn advance(&self, sweep: Sweep, position: usize) -> Sweep {
        Sweep { position, sum: sweep.sum + self.sum(sweep.position, position) }
    }

    /// The exact ordinate, given where the sum first exceeds the target.
    fn ordinate_at(&self, crossing: Sweep) -> Ordinate {
        let edp = self.demand.edp_m();
        let Some(&displacement_m) = edp.get(crossing.position) else {
            return self.ordinate(0.0, OrdinateFlag::NoExceedance, crossing);
        };
        let flag = if displacement_m.is_finite() { OrdinateFlag::Regular } else { OrdinateFlag::Censored };
        let ties = edp[crossing.position..].iter().take_while(|&&edp| edp == displacement_m).count();
        self.ordinate(displacement_m, flag, self.advance(crossing, crossing.position + ties))
    }

    /// An ordinate with the tail shares of the risk of the runs swept.
    fn ordinate(&self, displacement_m: f64, flag: OrdinateFlag, swept: Sweep) -> Ordinate {
        let counts = |level: usize, records: &mut dyn Iterator<Item = u16>| -> f64 {
            // At most 65 535 levels.
            let level = u16::try_from(level).unwrap_or(u16::MAX);
            // the sum of none is -0
            0.0 + records.map(|record| self.count(level, record)).sum::<f64>()
        };
        let total = self.rate(swept.sum) * f64::from(self.size);
        let share = |tail: f64| {
            if total > 0.0 { (tail / total).min(1.0) } else { 0.0 }
        };
        let first = counts(0, &mut self.demand.records_at_first_level(swept.position));
        let last = counts(self.demand.level_count() - 1, &mut self.demand.records_at_last_level(swept.position));
        Ordinate {
            displacement_m,
            flag,
            lower_tail_share: share(first * self.weights.lower_tail_per_year()),
            upper_tail_share: share(last * self.weights.upper_tail_per_year()),
        }
    }
}

/// A place for an ordinate that is about to be written.
const NO_RISK: Ordinate =
    Ordinate { displacement_m: 0.0, flag: OrdinateFlag::NoExceedance, lower_tail_share: 0.0, upper_tail_share: 0.0 };

/// How far a sweep over the runs has come: `sum` is that of the runs before `position`.
#[derive(Debug, Clone, Copy, Default)]
struct Sweep {
    position: usize,
    sum: u128,
}
