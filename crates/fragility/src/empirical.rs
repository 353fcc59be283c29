//! The empirical fragility, Eq. 4.7: the share of the records that exceed a threshold.

use crate::{FragilityError, Stripes};

/// Checks a displacement threshold: finite and zero or positive.
///
/// # Errors
/// [`FragilityError::Threshold`] otherwise; an infinite threshold would be exceeded by nothing, not
/// even by overturning.
pub fn check_threshold(threshold_m: f64) -> Result<(), FragilityError> {
    if threshold_m.is_finite() && threshold_m >= 0.0 {
        Ok(())
    } else {
        Err(FragilityError::Threshold { value: threshold_m })
    }
}

/// Number of records whose demand exceeds `threshold_m` (strictly), `[level]`. Overturned runs exceed every threshold.
///
/// # Errors
/// A threshold that is negative or not finite.
pub fn exceedance_counts(stripes: &Stripes, threshold_m: f64) -> Result<Vec<u32>, FragilityError> {
    check_threshold(threshold_m)?;
    let mut counts = vec![0; stripes.level_count()];
    for record in 0..stripes.record_count() {
        for (level, (count, &edp)) in counts.iter_mut().zip(stripes.record(record)).enumerate() {
            *count += u32::from(stripes.belongs(record, level) && edp > threshold_m);
        }
    }
    Ok(counts)
}

/// Empirical fragility for one threshold, `[level]`, Eq. 4.7: P(EDP > c | IM = level) = count(EDP > c) / N; the sum of
/// the [shares](Stripes::shares) of these records where they do not count alike.
///
/// # Errors
/// A threshold that is negative or not finite.
pub fn exceedance_probabilities(stripes: &Stripes, threshold_m: f64) -> Result<Vec<f64>, FragilityError> {
    let records = stripes.record_count() as f64;
    let counts = exceedance_counts(stripes, threshold_m)?;
    if let Some(shares) = stripes.shares() {
        let of_level = |(level, shares): (usize, &[f64])| -> f64 {
            let exceeds = |record: usize| stripes.record(record)[level] > threshold_m;
            // rounded shares may add up to a hair more than 1
            shares
                .iter()
                .enumerate()
                .filter(|(record, _)| exceeds(*record))
                .map(|(_, share)| share)
                .sum::<f64>()
                .min(1.0)
        };
        return Ok(shares.chunks_exact(stripes.record_count()).enumerate().map(of_level).collect());
    }
    Ok(counts.into_iter().map(|count| f64::from(count) / records).collect())
}

/// The empirical fragility prepared for many thresholds: each stripe is sorted once, each answer is a binary search.
#[derive(Debug, Clone)]
pub struct EmpiricalFragility {
    /// `[level, record]`, ascending within each level.
    sorted_m: Vec<f64>,
    /// The shares in the same order; none where all records count alike.
    shares: Option<Vec<f64>>,
    record_count: usize,
}

impl EmpiricalFragility {
    /// Sorts every stripe.
    pub fn new(stripes: &Stripes) -> Self {
        let record_count = stripes.record_count();
        let mut sorted_m = Vec::with_capacity(record_count * stripes.level_count());
        if let Some(shares) = stripes.shares() {
            let mut in_order = Vec::with_capacity(shares.len());
            for (level, shares) in shares.chunks_exact(record_count).enumerate() {
                // a demand that does not count stands among the smallest, without a share
                let demand = |record| if stripes.belongs(record, level) { stripes.record(record)[level] } else { 0.0 };
                let mut stripe: Vec<(f64, f64)> =
                    shares.iter().enumerate().map(|(record, &share)| (demand(record), share)).collect();
                stripe.sort_by(|a, b| a.0.total_cmp(&b.0));
                sorted_m.extend(stripe.iter().map(|run| run.0));
                in_order.extend(stripe.iter().map(|run| run.1));
            }
            return Self { sorted_m, shares: Some(in_order), record_count };
        }
        for level in 0..stripes.level_count() {
            sorted_m.extend(stripes.stripe(level));
        }
        for stripe in sorted_m.chunks_exact_mut(record_count) {
            stripe.sort_unstable_by(f64::total_cmp);
        }
        Self { sorted_m, shares: None, record_count }
    }

    /// Fragility for one threshold, `[level]` (Eq. 4.7).
    ///
    /// # Errors
    /// A threshold that is negative or not finite.
    pub fn probabilities(&self, threshold_m: f64) -> Result<Vec<f64>, FragilityError> {
        check_threshold(threshold_m)?;
        Ok(self.row(threshold_m).collect())
    }

    /// Fragilities for many thresholds, `[threshold, level]` row-major (Eq. 4.7).
    ///
    /// # Errors
    /// A threshold that is negative or not finite.
    pub fn surface(&self, thresholds_m: &[f64]) -> Result<Vec<f64>, FragilityError> {
        let levels = self.sorted_m.len() / self.record_count;
        let mut surface = Vec::with_capacity(thresholds_m.len() * levels);
        for &threshold_m in thresholds_m {
            check_threshold(threshold_m)?;
            surface.extend(self.row(threshold_m));
        }
        Ok(surface)
    }

    fn row(&self, threshold_m: f64) -> impl Iterator<Item = f64> {
        self.sorted_m.chunks_exact(self.record_count).enumerate().map(move |(level, stripe)| {
            let below = stripe.partition_point(|&edp| edp <= threshold_m);
            match &self.shares {
                Some(shares) => {
                    let of_level = &shares[level * self.record_count..][..self.record_count];
                    of_level[below..].iter().sum::<f64>().min(1.0)
                }
                None => (self.record_count - below) as f64 / self.record_count as f64,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn counts_strictly_and_overturning_exceeds_everything() {
        let inf = f64::INFINITY;
        let levels = [1.0, 2.0, 3.0];
        let edp = [0.0, 0.1, inf, 0.1, 0.1, 0.2, 0.1, 0.3, inf, 0.0, inf, 0.1];
        let stripes = Stripes::new(&levels, &edp).unwrap();
        // Columns: {0, .1, .1, 0}, {.1, .1, .3, inf}, {inf, .2, inf, .1}.
        assert_eq!(exceedance_probabilities(&stripes, 0.0).unwrap(), [0.5, 1.0, 1.0]);
        assert_eq!(exceedance_probabilities(&stripes, 0.1).unwrap(), [0.0, 0.5, 0.75]);
        assert_eq!(exceedance_probabilities(&stripes, f64::MAX).unwrap(), [0.0, 0.25, 0.5]);
        for bad in [-0.1, f64::NAN, inf] {
            assert!(exceedance_counts(&stripes, bad).is_err());
            assert!(EmpiricalFragility::new(&stripes).probabilities(bad).is_err());
        }
    }

    #[test]
    fn records_count_by_their_shares() {
        let edp = [0.1, f64::NAN, 0.2, 0.4, 9.0, 0.3];
        let shares = [0.25, 0.75, 0.0, 0.0, 0.5, 0.5];
        let stripes = Stripes::with_shares(&[1.0, 2.0], &edp, (3, 2), Some(&shares)).unwrap();
        let sorted = EmpiricalFragility::new(&stripes);
        for (threshold_m, counts, expected) in
            [(0.0, [2, 2], [1.0, 1.0]), (0.15, [1, 2], [0.75, 1.0]), (0.35, [0, 1], [0.0, 0.5])]
        {
            assert_eq!(exceedance_counts(&stripes, threshold_m).unwrap(), counts);
            assert_eq!(exceedance_probabilities(&stripes, threshold_m).unwrap(), expected);
            assert_eq!(sorted.probabilities(threshold_m).unwrap(), expected);
        }
    }

    proptest! {
        #[test]
        fn sorted_stripes_agree_with_counting(
            edp in prop::collection::vec(
                prop_oneof![Just(0.0), Just(f64::INFINITY), (0_u8..8).prop_map(f64::from), 0.0..9.0], 12..60
            ),
            thresholds in prop::collection::vec(prop_oneof![(0_u8..8).prop_map(f64::from), 0.0..10.0], 1..8),
        ) {
            let levels = [1.0, 2.0, 4.0];
            let edp = &edp[..edp.len() / 3 * 3];
            let stripes = Stripes::new(&levels, edp).unwrap();
            let expected: Vec<f64> = thresholds
                .iter()
                .flat_map(|&c| exceedance_probabilities(&stripes, c).unwrap())
                .collect();
            prop_assert_eq!(EmpiricalFragility::new(&stripes).surface(&thresholds).unwrap(), expected);
        }
    }
}
