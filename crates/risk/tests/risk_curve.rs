//! λ(c) and its ordinates: small cases solved by hand, and invariants against plain definitions.

use proptest::prelude::*;
use uplift_fragility::Stripes;
use uplift_risk::{
    Ordinate, OrdinateFlag, PooledDemand, RecordSample, ResamplingTable, RiskCurve, RiskError, StripeWeights,
    ThresholdGrid, mean_annual_frequency,
};

const INF: f64 = f64::INFINITY;
const LEVELS: [f64; 3] = [1.0, 2.0, 4.0];

/// Rates 1 at the first abscissa, then 0.5, 0.25, 0.125: weights 0.375, 0.1875, 0.1875, of which the lower tail has
/// 0.25 and the upper 0.125. With two records a run counts 0.1875, 0.09375, 0.09375.
fn weights() -> StripeWeights {
    StripeWeights::new(&[0.5, 0.25, 0.125], Some(1.0)).unwrap()
}

fn pool(edp: &[f64]) -> PooledDemand {
    PooledDemand::new(&Stripes::new(&LEVELS, edp).unwrap()).unwrap()
}

/// Two records, three levels. Sorted with their weights, and λ just below each demand:
/// 0.8 (0.09375) → 0.09375; 0.3 (0.09375) → 0.1875; 0.2 twice (0.09375, 0.1875) → 0.46875; 0.1 (0.09375) → 0.5625.
/// The run of record 0 at level 0 does not move.
const EDP: [f64; 6] = [0.0, 0.1, 0.3, 0.2, 0.2, 0.8];

#[test]
fn rates_of_the_hand_solved_case() {
    // One term written out: at c = 0.2 only the last level is exceeded, by both records: P = 0, 0, 1, so
    // ½ (0 + 1)(0.25 − 0.125) + 1 · 0.125 = 0.1875.
    let (pool, weights) = (pool(&EDP), weights());
    let curve = RiskCurve::new(&pool, &weights).unwrap();
    for (threshold, rate) in [(0.8, 0.0), (0.5, 0.09375), (0.3, 0.09375), (0.2, 0.1875), (0.1, 0.46875), (0.0, 0.5625)]
    {
        assert_eq!(curve.mean_annual_frequency(threshold).unwrap(), rate, "at {threshold}");
    }
    let parts = curve.disaggregation(0.1).unwrap();
    // P = ½, ½, 1: ½ · ½ · 0.5 below, ½ · 1 · 0.25 and ½ · 1.5 · 0.125 between, 1 · 0.125 above.
    assert_eq!(parts.lower_tail_per_year, 0.125);
    assert_eq!(parts.intervals_per_year, [0.125, 0.09375]);
    assert_eq!(parts.upper_tail_per_year, 0.125);
    assert_eq!(parts.total_per_year(), 0.46875);
}

#[test]
fn ordinates_of_the_hand_solved_case() {
    let (pool, weights) = (pool(&EDP), weights());
    let curve = RiskCurve::new(&pool, &weights).unwrap();
    // A target met exactly takes the smaller displacement: λ(0.2) = 0.1875 ≤ 0.1875.
    for (target, displacement) in
        [(0.01, 0.8), (0.09375, 0.3), (0.1, 0.3), (0.1875, 0.2), (0.2, 0.2), (0.46, 0.2), (0.46875, 0.1), (0.5, 0.1)]
    {
        let ordinate = curve.exact_ordinate(target).unwrap();
        assert_eq!((ordinate.displacement_m, ordinate.flag), (displacement, OrdinateFlag::Regular), "at {target}");
    }
    for target in [0.5625, 0.6, 1e9] {
        let ordinate = curve.exact_ordinate(target).unwrap();
        assert_eq!((ordinate.displacement_m, ordinate.flag), (0.0, OrdinateFlag::NoExceedance));
    }
    // Runs at or above 0.2: both of the last level, ⅔ of whose weight is tail, and one each of the others.
    let ordinate = curve.exact_ordinate(0.2).unwrap();
    assert_eq!(ordinate.upper_tail_share, 0.125 / 0.46875);
    assert_eq!(ordinate.lower_tail_share, 0.125 / 0.46875);
    assert!(ordinate.has_significant_tail());
    // At or above 0.3 there is no run of the first level.
    let ordinate = curve.exact_ordinate(0.1).unwrap();
    assert_eq!((ordinate.lower_tail_share, ordinate.upper_tail_share), (0.0, 0.125 / 0.1875));
    assert!(ordinate.lower_tail_share.is_sign_positive(), "printed as -0");
}

#[test]
fn overturning_censors_the_ordinate_it_makes_too_frequent() {
    // One overturned run of the last level: 0.09375 per year at any displacement.
    let (pool, weights) = (pool(&[0.0, 0.1, INF, 0.2, 0.2, 0.8]), weights());
    let curve = RiskCurve::new(&pool, &weights).unwrap();
    let flag = |target| curve.exact_ordinate(target).map(|o| (o.displacement_m, o.flag)).unwrap();
    assert_eq!(flag(0.09), (INF, OrdinateFlag::Censored));
    assert_eq!(flag(0.09375), (0.8, OrdinateFlag::Regular));
    let censored = curve.exact_ordinate(0.09).unwrap();
    assert_eq!(censored.upper_tail_share, 0.0625 / 0.09375);
    assert_eq!(curve.grid_ordinate(&ThresholdGrid::default(), 0.09).unwrap(), censored);
    assert_eq!(curve.mean_annual_frequency(f64::MAX).unwrap(), 0.09375);
}

#[test]
fn a_structure_that_never_moves_has_no_risk() {
    let (pool, weights) = (pool(&[0.0; 6]), weights());
    let curve = RiskCurve::new(&pool, &weights).unwrap();
    let expected = Ordinate {
        displacement_m: 0.0,
        flag: OrdinateFlag::NoExceedance,
        lower_tail_share: 0.0,
        upper_tail_share: 0.0,
    };
    assert_eq!(curve.exact_ordinate(1e-9).unwrap(), expected);
    assert_eq!(curve.grid_ordinate(&ThresholdGrid::default(), 1e-9).unwrap(), expected);
    assert!(!expected.has_significant_tail());
}

#[test]
fn grid_ordinate_by_hand() {
    let (pool, weights) = (pool(&EDP), weights());
    let curve = RiskCurve::new(&pool, &weights).unwrap();
    let grid = ThresholdGrid::new(vec![0.0, 0.15, 0.25, 0.5]).unwrap();
    // λ = 0.5625, 0.46875, 0.1875, 0.09375 at the thresholds.
    assert_eq!(curve.mean_annual_frequencies(&grid), [0.5625, 0.46875, 0.1875, 0.09375]);
    let at = |target: f64| curve.grid_ordinate(&grid, target).unwrap();
    let expected = 0.15 + 0.1 * (0.46875_f64 / 0.3).ln() / (0.46875_f64 / 0.1875).ln();
    assert!((at(0.3).displacement_m - expected).abs() < 1e-15);
    // Between 0.25 and 0.5 the rate halves: √½ of it lies in the middle.
    assert!((at(0.1875 * 0.5_f64.sqrt()).displacement_m - 0.375).abs() < 1e-15);
    // λ meets the target exactly at a threshold.
    assert_eq!(at(0.1875).displacement_m, 0.25);
    // Beyond 0.5 m the exact ordinate exists, the grid's does not.
    assert_eq!((at(0.09).displacement_m, at(0.09).flag), (INF, OrdinateFlag::Censored));
    assert_eq!(curve.exact_ordinate(0.09).unwrap().displacement_m, 0.8);
    // λ falls to zero inside the last step: its upper threshold is the answer.
    let coarse = ThresholdGrid::new(vec![0.0, 0.5, 1.0]).unwrap();
    assert_eq!(curve.grid_ordinate(&coarse, 0.09).unwrap().displacement_m, 1.0);
    assert_eq!(at(0.6).flag, OrdinateFlag::NoExceedance);
}

#[test]
fn refuses_parts_that_do_not_belong_together() {
    let pool = pool(&EDP);
    let two_levels = StripeWeights::new(&[0.5, 0.25], None).unwrap();
    assert!(matches!(RiskCurve::new(&pool, &two_levels), Err(RiskError::Count { found: 2, expected: 3, .. })));
    let (weights, sample) = (weights(), RecordSample::new(vec![1, 1, 1]).unwrap());
    assert!(matches!(
        RiskCurve::resampled(&pool, &weights, &sample),
        Err(RiskError::Count { found: 3, expected: 2, .. })
    ));
    let curve = RiskCurve::new(&pool, &weights).unwrap();
    for bad in [0.0, -1.0, f64::NAN, INF] {
        assert!(matches!(curve.exact_ordinate(bad), Err(RiskError::Target { .. })));
        assert!(matches!(curve.exact_ordinates(&[0.1, bad]), Err(RiskError::Target { .. })));
    }
    for bad in [-1.0, f64::NAN, INF] {
        assert!(curve.mean_annual_frequency(bad).is_err());
        assert!(curve.disaggregation(bad).is_err());
    }
}

/// A random oscillator and site.
#[derive(Debug, Clone)]
struct Case {
    levels: Vec<f64>,
    edp: Vec<f64>,
    records: usize,
    weights: StripeWeights,
}

impl Case {
    fn pool(&self) -> PooledDemand {
        PooledDemand::new(&Stripes::new(&self.levels, &self.edp).unwrap()).unwrap()
    }

    /// λ(c) from the definition: the trapezoid rule over counted fragilities.
    fn naive(&self, threshold: f64) -> f64 {
        mean_annual_frequency(&Stripes::new(&self.levels, &self.edp).unwrap(), &self.weights, threshold).unwrap()
    }

    /// Every place where λ can fall, and 0.
    fn candidates(&self) -> Vec<f64> {
        let mut candidates: Vec<f64> = self.edp.iter().copied().filter(|edp| edp.is_finite()).collect();
        candidates.push(0.0);
        candidates.sort_by(f64::total_cmp);
        candidates
    }
}

/// One of eleven is 0, one overturning, three are of twenty values below 1, and six ordinary ones up to 2: of a number
/// alone, since a strategy of its own for each of a thousand demands would take longer than the tests.
fn demand(number: u16) -> f64 {
    match number % 11 {
        0 => 0.0,
        1 => INF,
        2..=4 => f64::from(number / 11 % 20) / 20.0,
        // a quotient that is rounded
        _ => f64::from(number) / 32_771.0,
    }
}

/// Demands with zeros, ties, overturning and ordinary values; up to 12 × 90 runs so that sweeps span several blocks.
fn case() -> impl Strategy<Value = Case> {
    (1_usize..12, 1_usize..90).prop_flat_map(|(levels, records)| {
        let falls = prop::collection::vec(0.05_f64..1.0, levels + 1);
        let demands = prop::collection::vec(any::<u16>(), records * levels);
        (demands, falls, any::<bool>()).prop_map(move |(demands, falls, tail)| {
            let edp = demands.into_iter().map(demand).collect();
            let rates: Vec<f64> = falls
                .iter()
                .scan(1.0, |rate, fall| {
                    *rate *= fall;
                    Some(*rate)
                })
                .collect();
            let weights = StripeWeights::new(&rates[1..], tail.then_some(rates[0])).unwrap();
            let levels = (0..levels).map(|i| 1.0 + i as f64).collect();
            Case { levels, edp, records, weights }
        })
    })
}

proptest! {
    #[test]
    fn pooled_sums_are_the_trapezoid(case in case(), thresholds in prop::collection::vec(0.0..2.5, 1..6)) {
        let pool = case.pool();
        let curve = RiskCurve::new(&pool, &case.weights).unwrap();
        for threshold in thresholds.into_iter().chain(case.candidates()) {
            let (naive, pooled) = (case.naive(threshold), curve.mean_annual_frequency(threshold).unwrap());
            prop_assert!((pooled - naive).abs() <= 1e-12 * naive, "{pooled} {naive}");
            let parts = curve.disaggregation(threshold).unwrap().total_per_year();
            prop_assert!((pooled - parts).abs() <= 1e-12 * pooled);
        }
    }

    #[test]
    fn a_surface_row_is_lambda_at_every_threshold(case in case()) {
        let pool = case.pool();
        let curve = RiskCurve::new(&pool, &case.weights).unwrap();
        let grid = ThresholdGrid::new((0..50).map(|i| f64::from(i) / 20.0).collect()).unwrap();
        let row = curve.mean_annual_frequencies(&grid);
        for (&threshold, &rate) in grid.thresholds_m().iter().zip(&row) {
            prop_assert_eq!(rate, curve.mean_annual_frequency(threshold).unwrap());
        }
        prop_assert!(row.is_sorted_by(|a, b| a >= b));
    }

    #[test]
    fn exact_ordinate_is_the_smallest_candidate_that_meets_the_target(case in case(), target in 1e-6_f64..1.0) {
        let pool = case.pool();
        let curve = RiskCurve::new(&pool, &case.weights).unwrap();
        let ordinate = curve.exact_ordinate(target).unwrap();
        let meets = |&c: &f64| case.naive(c) <= target;
        // A random target does not come within rounding of a step.
        prop_assume!(case.candidates().iter().all(|&c| (case.naive(c) / target - 1.0).abs() > 1e-9));
        if let Some(c) = case.candidates().into_iter().find(meets) {
                prop_assert_eq!(ordinate.displacement_m, c);
                prop_assert_eq!(ordinate.flag == OrdinateFlag::NoExceedance, c == 0.0);
                // Shares from the disaggregation just below the ordinate.
                let below = if c > 0.0 { c.next_down() } else { 0.0 };
                let parts = curve.disaggregation(below).unwrap();
                let total = parts.total_per_year();
                if total > 0.0 {
                    prop_assert!((ordinate.lower_tail_share - parts.lower_tail_per_year / total).abs() < 1e-12);
                    prop_assert!((ordinate.upper_tail_share - parts.upper_tail_per_year / total).abs() < 1e-12);
                }
        } else {
            prop_assert_eq!((ordinate.displacement_m, ordinate.flag), (INF, OrdinateFlag::Censored));
        }
    }

    #[test]
    fn a_target_equal_to_a_rate_is_met(
        edp in prop::collection::vec(prop_oneof![Just(0.0), Just(INF), (1_u8..20).prop_map(f64::from)], 24),
        falls in prop::collection::vec(1_u16..1000, 3),
    ) {
        // Rates of 16 bits and 8 records: every λ(c) is a double, and each, used as the target, must be met at the
        // demand where λ first takes it.
        let rate = |skip: usize| f64::from(falls[skip..].iter().sum::<u16>()) / 1024.0;
        let weights = StripeWeights::new(&[rate(0), rate(1), rate(2)], None).unwrap();
        let pool = pool(&edp);
        let curve = RiskCurve::new(&pool, &weights).unwrap();
        for c in edp.iter().copied().filter(|edp| edp.is_finite()) {
            let rate = curve.mean_annual_frequency(c).unwrap();
            if rate > 0.0 {
                let ordinate = curve.exact_ordinate(rate).unwrap().displacement_m;
                prop_assert!(ordinate <= c);
                prop_assert_eq!(curve.mean_annual_frequency(ordinate).unwrap(), rate);
            }
        }
    }

    #[test]
    fn grid_and_exact_ordinate_share_a_step(case in case(), target in 1e-6_f64..1.0) {
        let pool = case.pool();
        let curve = RiskCurve::new(&pool, &case.weights).unwrap();
        let grid = ThresholdGrid::new((0..=30).map(|i| f64::from(i) / 20.0).collect()).unwrap(); // to 1.5 m
        let exact = curve.exact_ordinate(target).unwrap();
        let on_grid = curve.grid_ordinate(&grid, target).unwrap();
        if exact.flag != OrdinateFlag::Regular {
            prop_assert_eq!(on_grid, exact);
        } else if exact.displacement_m > 1.5 {
            prop_assert_eq!((on_grid.displacement_m, on_grid.flag), (INF, OrdinateFlag::Censored));
        } else {
            // As a reader would: the first threshold that meets the target, and the one before it.
            let row = curve.mean_annual_frequencies(&grid);
            let upper = row.iter().position(|&rate| rate <= target).unwrap();
            let (left, right) = (grid.thresholds_m()[upper - 1], grid.thresholds_m()[upper]);
            prop_assert!(left < exact.displacement_m && exact.displacement_m <= right);
            prop_assert!(left <= on_grid.displacement_m && on_grid.displacement_m <= right);
            prop_assert!((on_grid.displacement_m - exact.displacement_m).abs() <= right - left);
        }
    }

    #[test]
    fn ordinates_fall_as_the_target_rises_and_come_alike_in_one_sweep(
        case in case(),
        targets in prop::collection::vec(1e-6_f64..1.0, 1..6),
    ) {
        let pool = case.pool();
        let curve = RiskCurve::new(&pool, &case.weights).unwrap();
        let grid = ThresholdGrid::default();
        let single: Vec<Ordinate> = targets.iter().map(|&target| curve.exact_ordinate(target).unwrap()).collect();
        prop_assert_eq!(&curve.exact_ordinates(&targets).unwrap(), &single);
        for (&rarer, a) in targets.iter().zip(&single) {
            for (&target, b) in targets.iter().zip(&single) {
                if rarer < target {
                    prop_assert!(a.displacement_m >= b.displacement_m);
                    let on_grid = |target| curve.grid_ordinate(&grid, target).unwrap().displacement_m;
                    prop_assert!(on_grid(rarer) >= on_grid(target));
                }
            }
        }
    }

    #[test]
    fn the_order_of_records_does_not_matter_to_the_last_bit(
        case in case(), turn in 0_usize..90, target in 1e-6_f64..1.0,
    ) {
        let mut turned = case.clone();
        turned.edp.rotate_left((turn % case.records) * case.levels.len());
        let (pool, other) = (case.pool(), turned.pool());
        let (a, b) = (RiskCurve::new(&pool, &case.weights).unwrap(), RiskCurve::new(&other, &case.weights).unwrap());
        prop_assert_eq!(a.exact_ordinate(target).unwrap(), b.exact_ordinate(target).unwrap());
        let grid = ThresholdGrid::default();
        prop_assert_eq!(a.mean_annual_frequencies(&grid), b.mean_annual_frequencies(&grid));
        prop_assert_eq!(a.grid_ordinate(&grid, target).unwrap(), b.grid_ordinate(&grid, target).unwrap());
    }

    #[test]
    fn a_record_drawn_twice_is_a_record_written_twice(
        case in case(),
        draws in prop::collection::vec(0_usize..1000, 1..40),
        target in 1e-6_f64..1.0,
    ) {
        let mut multiplicities = vec![0; case.records];
        let mut written = case.clone();
        written.edp.clear();
        for draw in draws {
            let record = draw % case.records;
            multiplicities[record] += 1;
            let row = record * case.levels.len();
            written.edp.extend_from_slice(&case.edp[row..row + case.levels.len()]);
        }
        let sample = RecordSample::new(multiplicities).unwrap();
        let (pool, other) = (case.pool(), written.pool());
        let a = RiskCurve::resampled(&pool, &case.weights, &sample).unwrap();
        let b = RiskCurve::new(&other, &case.weights).unwrap();
        prop_assert_eq!(a.exact_ordinate(target).unwrap(), b.exact_ordinate(target).unwrap());
        let grid = ThresholdGrid::default();
        prop_assert_eq!(a.mean_annual_frequencies(&grid), b.mean_annual_frequencies(&grid));
        prop_assert_eq!(a.grid_ordinate(&grid, target).unwrap(), b.grid_ordinate(&grid, target).unwrap());
        prop_assert_eq!(a.disaggregation(0.3).unwrap(), b.disaggregation(0.3).unwrap());
    }

    // Targets are random, or λ of the first sample at a demand, where rounding could go either way; as many samples as
    // are sought side by side, fewer and more.
    #[test]
    fn a_resampling_table_gives_the_exact_ordinates(
        case in case(),
        draws in prop::collection::vec(prop::collection::vec(0_usize..1000, 1..120), 1..10),
        random in 1e-6_f64..1.0,
        position in 0_usize..2000,
    ) {
        let sample = |draws: Vec<usize>| {
            let mut multiplicities = vec![0; case.records];
            for draw in draws {
                multiplicities[draw % case.records] += 1;
            }
            RecordSample::new(multiplicities).unwrap()
        };
        let samples: Vec<RecordSample> = draws.into_iter().map(sample).collect();
        let pool = case.pool();
        let curve = RiskCurve::resampled(&pool, &case.weights, &samples[0]).unwrap();
        let candidates = case.candidates();
        let at_demand = curve.mean_annual_frequency(candidates[position % candidates.len()]).unwrap();
        let targets = [random, if at_demand > 0.0 { at_demand } else { random }];
        let table = ResamplingTable::new(&pool, &case.weights).unwrap();
        let mut found = vec![f64::NAN; 2 * samples.len()];
        table.ordinates(&samples, &targets, &mut found).unwrap();
        for (place, sample) in samples.iter().enumerate() {
            let found = [found[place], found[samples.len() + place]];
            let exact = RiskCurve::resampled(&pool, &case.weights, sample).unwrap().exact_ordinates(&targets).unwrap();
            prop_assert_eq!(found.to_vec(), exact.iter().map(|ordinate| ordinate.displacement_m).collect::<Vec<_>>());
        }
    }
}
