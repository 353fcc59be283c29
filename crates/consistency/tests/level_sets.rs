//! Sets of their own at each stripe: the plain set where they are all alike, and a world whose truth is known.

use uplift_consistency::{
    ConsistencyError, Fit, KNOTS, LevelSets, RecordSet, RepairOptions, Repaired, ScaledAnalysis, Scratch, Seismology,
    SetRecord, Solver,
};
use uplift_fragility::{Stripes, normal_cdf, normal_quantile};
use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_risk::{PooledDemand, RiskCurve, RiskError, StripeWeights};

use crate::common::targets;

const LEVELS: usize = 40;

fn levels() -> Vec<f64> {
    (0..LEVELS).map(|i| 0.3 * 1.19_f64.powi(i32::try_from(i).unwrap())).collect()
}

/// λ = 0.3/(1 + x^1.8 + x³/1000), and so the hazard of x.
fn hazard_of_x() -> HazardCurve {
    let im: Vec<f64> = (0..70).map(|i| 0.1 * 1.13_f64.powi(i)).collect();
    let rates = im.iter().map(|x| 0.3 / (1.0 + x.powf(1.8) + 1e-3 * x.powi(3))).collect();
    HazardCurve::new("PGV", "cm/s", "", im, rates).unwrap()
}

/// Uniform numbers, 0 to 1, the same ones in every run (Steele, Lea and Flood's `SplitMix64`).
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A standard normal number.
    fn normal(&mut self) -> f64 {
        normal_quantile(self.next().max(1e-12))
    }
}

fn record(pair: usize, scaled_to: f64, other: f64) -> SetRecord {
    let seismology = Seismology { magnitude: Some(5.0 + pair as f64 / 20.0), ..Seismology::default() };
    SetRecord { scaled_to, other, pair, event: Some(pair / 3), seismology }
}

fn repaired(analysis: &ScaledAnalysis<'_>) -> Repaired {
    analysis.repair(&RepairOptions::default()).unwrap()
}

fn solved(analysis: &ScaledAnalysis<'_>, multiplicities: &[u32]) -> (Fit, Vec<f64>) {
    let (solver, mut scratch) = (Solver::new(analysis, 0.05).unwrap(), Scratch::default());
    let fit = solver.solve(multiplicities, &[0.0; KNOTS], &mut scratch).unwrap();
    let mut shares = analysis.own_shares();
    solver.shares(multiplicities, &fit.exponents, &mut scratch, &mut shares).unwrap();
    (fit, shares)
}

// Diagnosis, repair and the weights of a resample: all of it compares equal, so that no bit but the sign of a zero
// could differ.
#[test]
fn the_same_records_at_every_level_are_the_plain_set() {
    let mut uniform = Uniform(3);
    let rows: Vec<SetRecord> = (0..60)
        .map(|pair| {
            let x = 0.5 + 20.0 * uniform.next();
            record(pair, x, x * (0.6 * uniform.normal()).exp())
        })
        .collect();
    let plain = RecordSet::new(rows).unwrap();
    let x = hazard_of_x();
    let y = HazardCurve::new("other", "1", "", (0..70).map(|i| 0.12 * 1.13_f64.powi(i)).collect(), x.maf().to_vec())
        .unwrap();
    let own = plain.clone().at_level(LevelSets::new(60, vec![1.0; 60 * LEVELS], None).unwrap()).unwrap();
    let [plain, own] = [&plain, &own]
        .map(|set| ScaledAnalysis::new(set, &levels(), &x, &y, &targets(), Extrapolation::Refuse).unwrap());
    assert_eq!(plain.diagnose(None, [0.2, 5.0]).unwrap(), own.diagnose(None, [0.2, 5.0]).unwrap());
    assert_eq!(repaired(&plain), repaired(&own));
    let multiplicities: Vec<u32> = (0..60).map(|record| (record * 7 % 5) % 3).collect();
    assert_eq!(solved(&plain, &multiplicities), solved(&own, &multiplicities));
    let reach = |analysis: &ScaledAnalysis<'_>| Solver::new(analysis, 0.05).unwrap().reach(&multiplicities).unwrap();
    assert_eq!(reach(&plain), reach(&own));
}

/// What the population has: ln(y/x) at a level is normal with this mean and standard deviation, before the site's own
/// motions are picked from it; these are the tilted ones, p ∝ (y/x)^[`TILT`].
fn mean_of(level: f64) -> f64 {
    0.2 - 0.1 * level.ln()
}
const DEVIATION: f64 = 0.5;
const TILT: f64 = 1.5;
/// The selection reaches further than the population, and its weights make that good.
const REACH: f64 = 1.4;
const RECORDS_A_LEVEL: usize = 150;

/// ln of the displacement, m, of a motion x, y: its mean, and what it scatters besides.
fn mean_ln_demand(level: f64, ln_ratio: f64) -> f64 {
    -7.0 + 1.2 * level.ln() + 0.7 * ln_ratio
}
const SCATTER: f64 = 0.3;

/// Mean annual frequencies of what is lognormal at each level, Σ w P.
fn rate_of(weights: &[f64], value: f64, mean_ln: impl Fn(f64) -> f64, deviation: f64) -> f64 {
    let beyond = |level: f64| normal_cdf((mean_ln(level) - value.ln()) / deviation);
    weights.iter().zip(levels()).map(|(weight, level)| weight * beyond(level)).sum()
}

/// The stripes, each selected at random from the population, and the demands of its runs `[record, level]`, m.
struct World {
    set: RecordSet,
    demands_m: Vec<f64>,
}

impl World {
    fn new() -> Self {
        let mut uniform = Uniform(11);
        let (levels, records) = (levels(), LEVELS * RECORDS_A_LEVEL);
        let mut rows = Vec::new();
        let (mut factors, mut shares) = (vec![f64::NAN; records * LEVELS], vec![0.0; records * LEVELS]);
        let mut demands_m = vec![f64::NAN; records * LEVELS];
        for (stripe, &level) in levels.iter().enumerate() {
            let own = stripe * RECORDS_A_LEVEL..(stripe + 1) * RECORDS_A_LEVEL;
            for pair in own.clone() {
                let z = uniform.normal() * REACH;
                let ln_ratio = mean_of(level) + DEVIATION * z;
                // the table's factor is half as large again as level/intensity, which is of another definition
                let (x, factor) = (0.5 + uniform.next(), 1.5);
                rows.push(record(pair, x, x * ln_ratio.exp() / factor));
                let cell = stripe * records + pair;
                factors[cell] = factor;
                shares[cell] = (0.5 * (z / REACH).powi(2) - 0.5 * z * z).exp();
                let demand = mean_ln_demand(level, ln_ratio) + SCATTER * uniform.normal();
                demands_m[pair * LEVELS + stripe] = demand.exp();
            }
            let of_level = &mut shares[stripe * records..][own];
            let sum: f64 = of_level.iter().sum();
            for share in of_level {
                *share /= sum;
            }
        }
        let sets = LevelSets::new(records, factors, Some(shares)).unwrap();
        Self { set: RecordSet::new(rows).unwrap().at_level(sets).unwrap(), demands_m }
    }
}

// The population is sampled with weights at each stripe, and the site's motions are those of it tilted by a power of
// y/x, as the repair has it: exponents, hazard of y and spectrum are known in closed form. What is found misses them by
// the sampling of 150 records a stripe, of which 70 or so count: some per cent.
#[test]
fn stripes_selected_at_random_honour_both_margins_once_repaired() {
    let (world, x) = (World::new(), hazard_of_x());
    let stripes = StripeWeights::from_hazard(&x, &levels(), Extrapolation::Refuse).unwrap();
    let weights = stripes.per_year();
    let site_mean = |level: f64| mean_of(level) + TILT * DEVIATION * DEVIATION;
    // from where not everything exceeds y on
    let other = (0..70).map(|i| 0.2 * 1.12_f64.powi(i));
    let rate = |y: f64| (y, rate_of(&weights, y, |level| level.ln() + site_mean(level), DEVIATION));
    let (im, rates) = other.map(rate).unzip();
    let y = HazardCurve::new("other", "1", "", im, rates).unwrap();
    let analysis = ScaledAnalysis::new(&world.set, &levels(), &x, &y, &targets(), Extrapolation::Refuse).unwrap();

    let before = analysis.diagnose(None, [0.2, 5.0]).unwrap();
    assert!(before.deviation.as_ref().unwrap().bias < 0.8, "{:?}", before.deviation);
    let repaired = repaired(&analysis);
    for exponent in repaired.fit.exponents {
        assert!((exponent - TILT).abs() < 0.35, "{:?}", repaired.fit);
    }
    let deviation = repaired.diagnosis.deviation.as_ref().unwrap();
    assert!(deviation.max < 0.04 && (deviation.bias - 1.0).abs() < 0.01, "{deviation:?}");
    // the margin of x: at every level whole, and of its own records alone
    let records = world.set.len();
    for (stripe, row) in repaired.weights.shares().chunks_exact(records).enumerate() {
        assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let own = stripe * RECORDS_A_LEVEL..(stripe + 1) * RECORDS_A_LEVEL;
        assert!(row.iter().enumerate().all(|(record, share)| (*share > 0.0) == own.contains(&record)));
    }
    // what is said of a stripe is said of its own records
    let nearest = &repaired.diagnosis.targets[0];
    let own = &repaired.diagnosis.stripes[nearest.stripe];
    assert!(own.effective_records > 40.0 && own.effective_records < RECORDS_A_LEVEL as f64);
    assert!((own.mean_ln_ratio - site_mean(levels()[nearest.stripe])).abs() < 0.15, "{own:?}");
    assert!((own.sd_ln_ratio - DEVIATION).abs() < 0.1, "{own:?}");
    assert_eq!(own.largest_record / RECORDS_A_LEVEL, nearest.stripe);
    // 1.5 over x, from 0.5 to 1.5, times the level
    let level = analysis.targets()[0].level;
    for factor in nearest.scale_factors.percentiles {
        assert!((1.0..=3.0).contains(&(factor / level)), "{:?} {level}", nearest.scale_factors);
    }

    let runs = Stripes::with_shares(
        analysis.levels(),
        &world.demands_m,
        (records, LEVELS),
        world.set.level_sets().unwrap().shares(),
    )
    .unwrap();
    let demand = PooledDemand::new(&runs).unwrap();
    let (plain, weighted) =
        (RiskCurve::new(&demand, &stripes).unwrap(), RiskCurve::weighted(&demand, &repaired.weights).unwrap());
    let deviation = (0.7_f64.powi(2) * DEVIATION.powi(2) + SCATTER.powi(2)).sqrt();
    let rate = |demand_m: f64| rate_of(&weights, demand_m, |level| mean_ln_demand(level, site_mean(level)), deviation);
    for target in targets() {
        let over_truth = |curve: &RiskCurve<'_>| {
            let (mut low, mut high) = (1e-6, 1e3);
            for _ in 0..200 {
                let middle = f64::sqrt(low * high);
                if rate(middle) > target { low = middle } else { high = middle }
            }
            curve.exact_ordinate(target).unwrap().displacement_m / low
        };
        let (before, after) = (over_truth(&plain), over_truth(&weighted));
        assert!(before < 0.85 && (after - 1.0).abs() < 0.05, "{target}: {before} {after}");
    }
}

#[test]
fn a_record_left_out_is_the_sets_without_it() {
    let mut uniform = Uniform(5);
    let pairs = 90;
    let rows: Vec<SetRecord> = (0..pairs)
        .map(|pair| {
            let x = 0.5 + uniform.next();
            record(pair, x, x * (0.6 * uniform.normal()).exp())
        })
        .collect();
    let at_level = |rows: Vec<SetRecord>| {
        let count = rows.len();
        let belongs = |level: usize, row: &SetRecord| !(level + row.pair).is_multiple_of(3);
        let weight =
            |level: usize, row: &SetRecord| if belongs(level, row) { 1.0 + (row.pair % 4) as f64 } else { 0.0 };
        let mut shares = Vec::new();
        for level in 0..LEVELS {
            let sum: f64 = rows.iter().map(|row| weight(level, row)).sum();
            shares.extend(rows.iter().map(|row| weight(level, row) / sum));
        }
        let factor = |level: usize, row: &SetRecord| if (level + row.pair).is_multiple_of(2) { 1.0 } else { 1.01 };
        let factors = (0..LEVELS).flat_map(|level| rows.iter().map(move |row| factor(level, row))).collect();
        RecordSet::new(rows).unwrap().at_level(LevelSets::new(count, factors, Some(shares)).unwrap()).unwrap()
    };
    let whole = at_level(rows.clone());
    let rest = at_level(rows.into_iter().filter(|row| row.pair != 17).collect());
    let (x, y) = (hazard_of_x(), hazard_of_x());
    let [whole, rest] = [&whole, &rest]
        .map(|set| ScaledAnalysis::new(set, &levels(), &x, &y, &targets(), Extrapolation::Refuse).unwrap());
    let mut multiplicities = whole.set().once();
    multiplicities[17] = 0;
    let (left_out, shares) = solved(&whole, &multiplicities);
    let (without, _) = solved(&rest, &rest.set().once());
    for (found, expected) in left_out.exponents.iter().zip(without.exponents) {
        assert!((found - expected).abs() < 1e-9, "{left_out:?} {without:?}");
    }
    assert!(shares.chunks_exact(pairs).all(|row| row[17] == 0.0));
    // none of the records of the first level: 0, 3, 6, … are not of it
    let none: Vec<u32> = (0..pairs).map(|record| u32::from(record % 3 == 0)).collect();
    let empty = Solver::new(&whole, 0.05).unwrap().reach(&none).unwrap_err();
    assert_eq!(empty, ConsistencyError::Risk(RiskError::EmptyLevel { level: 0 }));
}

#[test]
fn sets_of_other_levels_are_refused() {
    let rows: Vec<SetRecord> = (0..30).map(|pair| record(pair, 1.0, 1.0 + pair as f64)).collect();
    let sets = LevelSets::new(30, vec![1.0; 60], None).unwrap();
    let set = RecordSet::new(rows).unwrap().at_level(sets).unwrap();
    let x = hazard_of_x();
    let error = ScaledAnalysis::new(&set, &levels(), &x, &x, &targets(), Extrapolation::Refuse).unwrap_err();
    assert!(matches!(error, ConsistencyError::Count { found: 2, expected: LEVELS, .. }), "{error}");
}
