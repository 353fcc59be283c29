//! The ordinates of all strengths for replicates whose records are weighed anew.

use uplift_risk::{PooledDemand, REPLICATES_AT_ONCE, RecordSample, ReplicateWeights, RiskError, StripeWeights};

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
    let runs = stripes.level_count() * records;
    let mut shares = vec![0.0; runs * REPLICATES_AT_ONCE];
    let mut weights = ReplicateWeights::new(stripes, records);
    let mut found_m = vec![0.0; targets * REPLICATES_AT_ONCE];
    for (portion, samples) in samples.chunks(REPLICATES_AT_ONCE).enumerate() {
        let shares = &mut shares[..runs * samples.len()];
        for (sample, shares) in samples.iter().zip(shares.chunks_exact_mut(runs.max(1))) {
            weigh(sample, shares)?;
        }
        weights.weigh(shares)?;
        let found_m = &mut found_m[..targets * samples.len()];
        for (strength, demand) in demands.iter().enumerate() {
            weights.ordinates(demand, targets_per_year, found_m)?;
            for (place, &ordinate_m) in found_m.iter().enumerate() {
                let (replicate, target) = (place / targets, place % targets);
                ordinates_m[(strength * targets + target) * count + portion * REPLICATES_AT_ONCE + replicate] =
                    ordinate_m;
            }
        }
    }
    Ok(ordinates_m)
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
