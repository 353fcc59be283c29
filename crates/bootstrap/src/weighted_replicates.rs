//! The ordinates of all strengths for replicates whose records are weighed anew.

use uplift_risk::{
    PooledDemand, REPLICATES_AT_ONCE, RecordSample, ReplicateWeights, RiskCurve, RiskError, StripeWeights,
};

/// Samples that are weighed before the first ordinate: those among them that are alike are sought together.
pub const SORTED_AT_ONCE: usize = 8 * REPLICATES_AT_ONCE;

/// Exact ordinates of some samples, each with weights of its own, at one site, m, `[strength, target, sample]`.
///
/// Each sample is weighed once for all strengths. A sample depends on nothing but itself: samples may be given in any
/// portions, to any number of threads.
///
/// - `demands`: all runs of the oscillators, `[strength]`.
/// - `stripes`: the hazard of the site, as weights of the stripes.
/// - `targets_per_year`: target rates, 1/yr.
/// - `samples`: replicates, or the records less one ([`left_out`]).
/// - `weigh`: fills in the shares of the records for a sample, `[level, record]`, which come as any sample before left
///   them.
///
/// # Errors
/// Those of `weigh`; shares that do not add up to 1 at a level; parts with different numbers of levels or records; a
/// target that is not positive and finite.
pub fn weighted_replicates<E: From<RiskError>>(
    demands: &[PooledDemand],
    stripes: &StripeWeights,
    targets_per_year: &[f64],
    samples: &[RecordSample],
    mut weigh: impl FnMut(&RecordSample, &mut [f64]) -> Result<(), E>,
) -> Result<Vec<f64>, E> {
    let (targets, count) = (targets_per_year.len(), samples.len());
    let records = samples.first().map_or(0, |sample| sample.multiplicities().len());
    let mut ordinates_m = vec![0.0; demands.len() * targets * count];
    let runs = (stripes.level_count() * records).max(1);
    let mut shares = vec![0.0; runs * count.min(SORTED_AT_ONCE)];
    let mut weights = ReplicateWeights::new(stripes, records);
    let mut found_m = vec![0.0; targets * REPLICATES_AT_ONCE];
    let middle = Middle::new(demands, stripes, targets_per_year)?;
    for (portion, samples) in samples.chunks(SORTED_AT_ONCE).enumerate() {
        for (sample, shares) in samples.iter().zip(shares.chunks_exact_mut(runs)) {
            weigh(sample, shares)?;
        }
        // where each sample is, and its shares
        let mut sorted: Vec<(usize, &[f64])> = shares.chunks_exact(runs).take(samples.len()).enumerate().collect();
        sorted.sort_by_cached_key(|(_, shares)| middle.rate(shares).to_bits());
        for alike in sorted.chunks(REPLICATES_AT_ONCE) {
            weights.weigh(&alike.iter().map(|(_, shares)| *shares).collect::<Vec<_>>())?;
            let found_m = &mut found_m[..targets * alike.len()];
            for (strength, demand) in demands.iter().enumerate() {
                weights.ordinates(demand, targets_per_year, found_m)?;
                for ((place, _), found_m) in alike.iter().zip(found_m.chunks_exact(targets.max(1))) {
                    for (target, &ordinate_m) in found_m.iter().enumerate() {
                        ordinates_m[(strength * targets + target) * count + portion * SORTED_AT_ONCE + place] =
                            ordinate_m;
                    }
                }
            }
        }
    }
    Ok(ordinates_m)
}

/// The runs that exceed an ordinate of the middle strength and target. Samples in which they weigh alike have ordinates
/// near each other: sought together, these take fewer steps.
struct Middle {
    /// Place in the shares, `[level, record]`, and what the stripe weighs, 1/yr.
    runs: Vec<(usize, f64)>,
}

impl Middle {
    fn new(demands: &[PooledDemand], stripes: &StripeWeights, targets_per_year: &[f64]) -> Result<Self, RiskError> {
        let (Some(demand), Some(&target)) =
            (demands.get(demands.len() / 2), targets_per_year.get(targets_per_year.len() / 2))
        else {
            return Ok(Self { runs: Vec::new() });
        };
        let ordinate_m = RiskCurve::new(demand, stripes)?.exact_ordinate(target)?.displacement_m;
        let per_year = stripes.per_year();
        let exceeding = demand.falling_runs().take_while(|(edp_m, ..)| *edp_m > ordinate_m);
        let run_per_year =
            |(_, record, level): (f64, usize, usize)| (level * demand.record_count() + record, per_year[level]);
        Ok(Self { runs: exceeding.map(run_per_year).collect() })
    }

    /// How often a sample exceeds that ordinate, 1/yr.
    fn rate(&self, shares: &[f64]) -> f64 {
        self.runs.iter().map(|&(place, per_year)| shares.get(place).map_or(0.0, |share| share * per_year)).sum()
    }
}

/// The records without each of them in turn, `[record]`; none where there is but one record.
///
/// # Errors
/// More than 2²⁴ records.
pub fn left_out(records: usize) -> Result<Vec<RecordSample>, RiskError> {
    let each: Vec<Vec<usize>> = (0..records).map(|record| vec![record]).collect();
    left_out_together(records, &each)
}

/// So many `records` without each of the `units` in turn, `[unit]`; none where there is but one.
///
/// - `units`: the positions of the records of each.
///
/// # Errors
/// As [`left_out`].
///
/// # Panics
/// If a unit has a record that there is not.
pub fn left_out_together(records: usize, units: &[Vec<usize>]) -> Result<Vec<RecordSample>, RiskError> {
    if units.len() < 2 { Ok(Vec::new()) } else { units.iter().map(|unit| without(records, unit)).collect() }
}

/// So many `records` once, but for those `left_out`.
///
/// # Errors
/// None left; more than 2²⁴ records.
fn without(records: usize, left_out: &[usize]) -> Result<RecordSample, RiskError> {
    let mut multiplicities = vec![1; records];
    for &record in left_out {
        multiplicities[record] = 0;
    }
    RecordSample::new(multiplicities)
}
