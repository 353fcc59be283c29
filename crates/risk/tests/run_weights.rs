//! Runs that count differently: a case solved by hand, against records that count alike, and many at once.

use proptest::prelude::*;
use uplift_fragility::Stripes;
use uplift_risk::{
    OrdinateFlag, PooledDemand, REPLICATES_AT_ONCE, RecordSample, ReplicateWeights, ResamplingTable, RiskCurve,
    RiskError, RunWeights, StripeWeights,
};

const LEVELS: [f64; 3] = [1.0, 2.0, 4.0];

fn pool(edp: &[f64]) -> PooledDemand {
    PooledDemand::new(&Stripes::new(&LEVELS, edp).unwrap()).unwrap()
}

/// Weights 0.375, 0.1875, 0.1875, of which the lower tail has 0.25 and the upper 0.125.
fn stripes() -> StripeWeights {
    StripeWeights::new(&[0.5, 0.25, 0.125], Some(1.0)).unwrap()
}

#[test]
fn the_hand_solved_case() {
    // record 0 counts ¼, 1, ½ at the three levels, record 1 the rest
    let (pool, stripes) = (pool(&[0.0, 0.1, 0.3, 0.2, 0.2, 0.8]), stripes());
    let weights = RunWeights::new(&stripes, &[0.25, 0.75, 1.0, 0.0, 0.5, 0.5]).unwrap();
    let curve = RiskCurve::weighted(&pool, &weights).unwrap();
    // 0.8: ½ · 0.1875; 0.3: ½ · 0.1875; 0.2: ¾ · 0.375 and nothing; 0.1: 0.1875
    for (threshold, rate) in [(0.8, 0.0), (0.3, 0.09375), (0.2, 0.1875), (0.1, 0.46875), (0.0, 0.65625)] {
        assert_eq!(curve.mean_annual_frequency(threshold).unwrap(), rate, "at {threshold}");
    }
    assert_eq!(curve.exceedance_probabilities(0.1).unwrap(), [0.75, 0.0, 1.0]);
    let ordinate = curve.exact_ordinate(0.2).unwrap();
    assert_eq!((ordinate.displacement_m, ordinate.flag), (0.2, OrdinateFlag::Regular));
    // at or above 0.2: ¾ of the first level and all of the last
    assert_eq!(ordinate.lower_tail_share, 0.75 * 0.25 / 0.46875);
    assert_eq!(ordinate.upper_tail_share, 0.125 / 0.46875);
    assert_eq!(curve.exact_ordinate(0.66).unwrap().flag, OrdinateFlag::NoExceedance);
}

#[test]
fn refuses_weights_of_other_records_or_levels() {
    let (pool, stripes) = (pool(&[0.1; 6]), stripes());
    let weights = RunWeights::new(&stripes, &[1.0; 3]).unwrap();
    assert!(matches!(RiskCurve::weighted(&pool, &weights), Err(RiskError::Count { found: 1, expected: 2, .. })));
    let other = StripeWeights::new(&[0.5, 0.25], None).unwrap();
    let weights = RunWeights::new(&other, &[0.5; 4]).unwrap();
    assert!(matches!(RiskCurve::weighted(&pool, &weights), Err(RiskError::Count { found: 2, expected: 3, .. })));
    for (stripes, records) in [(&stripes, 1), (&other, 2)] {
        let error = ReplicateWeights::new(stripes, records).ordinates(&pool, &[0.1], &mut []).unwrap_err();
        assert!(matches!(error, RiskError::Count { .. }), "{error}");
    }
    let mut weights = ReplicateWeights::new(&stripes, 2);
    assert!(matches!(weights.weigh(&[&[0.5; 5]]), Err(RiskError::Count { found: 5, expected: 6, .. })));
    weights.weigh(&[&[0.5; 6]]).unwrap();
    assert!(matches!(weights.ordinates(&pool, &[0.0], &mut [0.0]), Err(RiskError::Target { .. })));
}

/// Demands of a few records at many levels, with zeros, ties and overturned runs, and shares of the records.
#[derive(Debug, Clone)]
struct Case {
    levels: Vec<f64>,
    edp_m: Vec<f64>,
    records: usize,
    /// One `[level, record]` a replicate.
    shares: Vec<Vec<f64>>,
}

fn case() -> impl Strategy<Value = Case> {
    (1..9_usize, 1..20_usize).prop_flat_map(|(records, levels)| {
        let edp = prop_oneof![1 => Just(0.0), 1 => Just(f64::INFINITY), 2 => Just(0.5), 8 => 0.0..2.0_f64];
        let shares = prop::collection::vec(prop_oneof![1 => Just(0.0), 3 => 0.001..1.0_f64], records * levels);
        let replicates = prop::collection::vec(shares, 1..=REPLICATES_AT_ONCE);
        (prop::collection::vec(edp, records * levels), replicates).prop_map(move |(edp_m, mut shares)| {
            for row in shares.iter_mut().flat_map(|of_one| of_one.chunks_exact_mut(records)) {
                row[0] += 0.01;
                let sum: f64 = row.iter().sum();
                for share in row {
                    *share /= sum;
                }
            }
            Case { levels: (0..levels).map(|i| 1.0 + i as f64).collect(), edp_m, records, shares }
        })
    })
}

impl Case {
    fn pool(&self) -> PooledDemand {
        PooledDemand::new(&Stripes::new(&self.levels, &self.edp_m).unwrap()).unwrap()
    }

    fn stripes(&self) -> StripeWeights {
        let rates: Vec<f64> = self.levels.iter().map(|level| 0.4 / (level * level)).collect();
        StripeWeights::new(&rates, Some(0.7)).unwrap()
    }
}

proptest! {
    #[test]
    fn sums_are_the_plain_ones(case in case(), threshold in 0.0..2.5_f64) {
        let (pool, stripes) = (case.pool(), case.stripes());
        let weights = RunWeights::new(&stripes, &case.shares[0]).unwrap();
        let mut plain = 0.0;
        for (level, weight) in stripes.per_year().into_iter().enumerate() {
            for record in 0..case.records {
                if case.edp_m[record * case.levels.len() + level] > threshold {
                    plain += weight * case.shares[0][level * case.records + record];
                }
            }
        }
        let found = RiskCurve::weighted(&pool, &weights).unwrap().mean_annual_frequency(threshold).unwrap();
        prop_assert!((found - plain).abs() <= 1e-12 * plain, "{found} {plain}");
    }

    /// Shares of 1/N, or of m/n, are records that count alike, or as often as they were drawn.
    #[test]
    fn shares_of_a_sample_are_the_sample(
        case in case(), draws in prop::collection::vec(0..4_u32, 9), target in 1e-5..1.0_f64,
    ) {
        let (pool, stripes) = (case.pool(), case.stripes());
        let mut draws = draws[..case.records].to_vec();
        draws[0] += 1;
        let sample = RecordSample::new(draws.clone()).unwrap();
        let row: Vec<f64> = draws.iter().map(|&count| f64::from(count) / f64::from(sample.size())).collect();
        let weights = RunWeights::new(&stripes, &row.repeat(case.levels.len())).unwrap();
        let shared = RiskCurve::weighted(&pool, &weights).unwrap().exact_ordinate(target).unwrap();
        let drawn = RiskCurve::resampled(&pool, &stripes, &sample).unwrap().exact_ordinate(target).unwrap();
        prop_assert_eq!((shared.displacement_m, shared.flag), (drawn.displacement_m, drawn.flag));
        prop_assert!((shared.lower_tail_share - drawn.lower_tail_share).abs() < 1e-12);
        prop_assert!((shared.upper_tail_share - drawn.upper_tail_share).abs() < 1e-12);
    }

    #[test]
    fn many_at_once_are_each_alone(case in case(), targets in prop::collection::vec(1e-4..1.0_f64, 0..4)) {
        let (pool, stripes) = (case.pool(), case.stripes());
        let mut together = ReplicateWeights::new(&stripes, case.records);
        together.weigh(&case.shares.iter().map(Vec::as_slice).collect::<Vec<_>>()).unwrap();
        // a target that is met exactly, too
        let first = RunWeights::new(&stripes, &case.shares[0]).unwrap();
        let exact = RiskCurve::weighted(&pool, &first).unwrap().mean_annual_frequency(0.5).unwrap();
        let targets: Vec<f64> = targets.into_iter().chain((exact > 0.0).then_some(exact)).collect();
        let mut found = vec![f64::NAN; case.shares.len() * targets.len()];
        together.ordinates(&pool, &targets, &mut found).unwrap();
        for (replicate, shares) in case.shares.iter().enumerate() {
            let weights = RunWeights::new(&stripes, shares).unwrap();
            let alone = RiskCurve::weighted(&pool, &weights).unwrap().exact_ordinates(&targets).unwrap();
            let alone: Vec<f64> = alone.iter().map(|ordinate| ordinate.displacement_m).collect();
            prop_assert_eq!(&found[replicate * targets.len()..][..targets.len()], &alone[..]);
        }
    }
}

const NONE: f64 = f64::NAN;

/// Record 1 belongs to the first two levels only, record 2 to the last alone.
fn a_set_a_level() -> (PooledDemand, Vec<f64>) {
    let edp = [0.1, 0.2, 0.3, 0.2, 0.4, NONE, NONE, NONE, 0.8];
    let shares = vec![0.5, 0.5, 0.0, 0.25, 0.75, 0.0, 0.5, 0.0, 0.5];
    let demand = PooledDemand::new(&Stripes::with_shares(&LEVELS, &edp, (3, 3), Some(&shares)).unwrap()).unwrap();
    (demand, shares)
}

#[test]
fn levels_with_records_of_their_own_by_hand() {
    let (demand, shares) = a_set_a_level();
    let stripes = stripes();
    let curve = RiskCurve::new(&demand, &stripes).unwrap();
    // weights 0.375, 0.1875, 0.1875: above 0.3 ¾ of the second level and ½ of the third
    for (threshold, rate) in [(0.3, 0.75 * 0.1875 + 0.5 * 0.1875), (0.15, 0.5 * 0.375 + 0.1875 + 0.1875), (0.8, 0.0)] {
        assert_eq!(curve.mean_annual_frequency(threshold).unwrap(), rate, "at {threshold}");
    }
    assert_eq!(curve.exceedance_probabilities(0.3).unwrap(), [0.0, 0.75, 0.5]);
    assert!((demand.effective_records(1) - 1.6).abs() < 1e-12);
    // without record 0: record 1 alone counts at the first two levels, record 2 at the last
    let without = RecordSample::new(vec![0, 1, 1]).unwrap();
    let curve = RiskCurve::resampled(&demand, &stripes, &without).unwrap();
    assert_eq!(curve.exceedance_probabilities(0.3).unwrap(), [0.0, 1.0, 1.0]);
    let table = ResamplingTable::new(&demand, &stripes).unwrap();
    let mut found = [NONE; 2];
    table.ordinates(&[without], &[0.2, 0.5], &mut found).unwrap();
    assert_eq!(found, [0.4, 0.2]);
    // record 1 drawn thrice: its share grows where it counts, and nowhere else
    let thrice = RecordSample::new(vec![1, 3, 1]).unwrap();
    let curve = RiskCurve::resampled(&demand, &stripes, &thrice).unwrap();
    assert_eq!(curve.exceedance_probabilities(0.15).unwrap(), [0.75, 1.0, 1.0]);
    assert_eq!(curve.exceedance_probabilities(0.3).unwrap(), [0.0, 0.9, 0.5]);
    // nobody is left at the last level
    let empty = RecordSample::new(vec![0, 2, 0]).unwrap();
    assert_eq!(RiskCurve::resampled(&demand, &stripes, &empty).unwrap_err(), RiskError::EmptyLevel { level: 2 });
    assert_eq!(table.ordinates(&[empty], &[0.2, 0.5], &mut found).unwrap_err(), RiskError::EmptyLevel { level: 2 });
    // weights of a run that is none
    let even = RunWeights::new(&stripes, &[1.0 / 3.0; 9]).unwrap();
    assert_eq!(RiskCurve::weighted(&demand, &even).unwrap_err(), RiskError::NoRun { level: 0, record: 2 });
    let own = RunWeights::new(&stripes, &shares).unwrap();
    let weighted = RiskCurve::weighted(&demand, &own).unwrap().exact_ordinate(0.2).unwrap();
    assert_eq!(weighted, RiskCurve::new(&demand, &stripes).unwrap().exact_ordinate(0.2).unwrap());
}

proptest! {
    /// A set that has every record at every level, and all alike, is the plain one; drawn samples of it too.
    #[test]
    fn even_shares_are_none(
        case in case(), draws in prop::collection::vec(0..4_u32, 9), target in 1e-5..1.0_f64,
    ) {
        let (plain, stripes) = (case.pool(), case.stripes());
        let even = vec![1.0 / case.records as f64; case.records * case.levels.len()];
        let shape = (case.records, case.levels.len());
        let with = Stripes::with_shares(&case.levels, &case.edp_m, shape, Some(&even)).unwrap();
        let with = PooledDemand::new(&with).unwrap();
        let mut draws = draws[..case.records].to_vec();
        draws[0] += 1;
        let sample = RecordSample::new(draws).unwrap();
        let all =
            [&plain, &with].map(|demand| RiskCurve::new(demand, &stripes).unwrap().exact_ordinate(target).unwrap());
        let drawn = [&plain, &with]
            .map(|demand| RiskCurve::resampled(demand, &stripes, &sample).unwrap().exact_ordinate(target).unwrap());
        for [plain, with] in [all, drawn] {
            prop_assert_eq!((plain.displacement_m, plain.flag), (with.displacement_m, with.flag));
            prop_assert!((plain.lower_tail_share - with.lower_tail_share).abs() < 1e-12);
            prop_assert!((plain.upper_tail_share - with.upper_tail_share).abs() < 1e-12);
        }
    }
}
