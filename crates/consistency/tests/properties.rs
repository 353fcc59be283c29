//! What holds of any set.

use proptest::prelude::*;
use uplift_consistency::{
    ConsistencyError, Fit, KNOTS, NoRepair, RecordSet, RepairOptions, ScaledAnalysis, Scratch, Seismology, SetRecord,
    Solver,
};
use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_risk::{RunWeights, StripeWeights};

use crate::common::targets;

/// Levels from `first`, 60 at equal ratios.
fn rising(first: f64) -> Vec<f64> {
    (0..60).map(|i| first * 1.14_f64.powi(i)).collect()
}

/// λ = (level/unit)^−2 · 0.3, bent down at the ends as a site's is.
fn hazard(measure: &str, unit: &str, of_one: f64, factor: f64) -> HazardCurve {
    let levels: Vec<f64> = rising(0.15).into_iter().map(|level| level * of_one).collect();
    let rate = |level: &f64| factor * 0.3 / (1.0 + (level / of_one).powf(1.8) + 1e-3 * (level / of_one).powi(3));
    let rates = levels.iter().map(rate).collect();
    HazardCurve::new(measure, unit, "", levels, rates).unwrap()
}

/// Records of x = `scales` with q = e^`ln_ratios`.
fn set(scales: &[f64], ln_ratios: &[f64]) -> RecordSet {
    let record = |(index, (&scaled_to, ln_ratio)): (usize, (&f64, &f64))| SetRecord {
        scaled_to,
        other: scaled_to * ln_ratio.exp(),
        pair: index,
        event: None,
        seismology: Seismology::default(),
    };
    RecordSet::new(scales.iter().zip(ln_ratios).enumerate().map(record).collect()).unwrap()
}

fn levels() -> Vec<f64> {
    (0..55).map(|i| 0.3 * 1.13_f64.powi(i)).collect()
}

fn analysis<'a>(set: &'a RecordSet, x: &HazardCurve, y: &'a HazardCurve) -> ScaledAnalysis<'a> {
    ScaledAnalysis::new(set, &levels(), x, y, &targets(), Extrapolation::Refuse).unwrap()
}

/// Sets wide enough for any curve of these tests.
fn sets() -> impl Strategy<Value = (Vec<f64>, Vec<f64>)> {
    (25..60_usize).prop_flat_map(|count| {
        let spread = (0..count).map(|index| {
            let middle = 2.6 * (index as f64 + 0.5) / count as f64 - 1.3;
            middle - 0.15..middle + 0.15
        });
        (prop::collection::vec(0.5..20.0_f64, count), spread.collect::<Vec<_>>())
    })
}

fn solved(solver: &Solver<'_>, multiplicities: &[u32]) -> ([f64; KNOTS], Vec<f64>) {
    let mut scratch = Scratch::default();
    let fit = solver.solve(multiplicities, &[0.0; KNOTS], &mut scratch).unwrap();
    let mut shares = solver.analysis().own_shares();
    solver.shares(multiplicities, &fit.exponents, &mut scratch, &mut shares).unwrap();
    (fit.exponents, shares)
}

fn assert_close(found: &[f64], expected: &[f64], tolerance: f64) -> Result<(), TestCaseError> {
    prop_assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        prop_assert!((found - expected).abs() <= tolerance, "{found} {expected}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn alike_ratios_leave_records_alike(
        count in 1..30_usize, ln_ratio in -1.0..1.0_f64, exponents in prop::array::uniform4(-20.0..20.0_f64),
    ) {
        let set = set(&vec![2.0; count], &vec![ln_ratio; count]);
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.0));
        let analysis = analysis(&set, &x, &y);
        let solver = Solver::new(&analysis, 0.05).unwrap();
        let mut shares = analysis.own_shares();
        solver.shares(&set.once(), &exponents, &mut Scratch::default(), &mut shares).unwrap();
        assert_close(&shares, &analysis.own_shares(), 1e-15)?;
    }

    #[test]
    fn shares_add_up_and_the_hazard_is_met((scales, ln_ratios) in sets(), factor in 0.6..1.6_f64) {
        let set = set(&scales, &ln_ratios);
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, factor));
        let analysis = analysis(&set, &x, &y);
        let solver = Solver::new(&analysis, 0.05).unwrap();
        prop_assert!(solver.reach(&set.once()).unwrap().is_whole());
        let repaired = analysis.repair(&RepairOptions::default()).unwrap();
        for row in repaired.weights.shares().chunks_exact(set.len()) {
            prop_assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
        let (before, after) = (analysis.diagnose(None, [0.2, 5.0]).unwrap(), &repaired.diagnosis);
        let deviation = after.deviation.as_ref().unwrap();
        prop_assert!(deviation.rms <= before.deviation.unwrap().rms + 1e-9);
        prop_assert!(deviation.max < 0.12, "{deviation:?}");
    }

    /// Nothing more can be had of the sum of squares than the method leaves open.
    #[test]
    fn a_sample_is_solved_as_well_as_the_set(
        (scales, ln_ratios) in sets(), factor in 0.6..1.6_f64, draws in prop::collection::vec(0..60_usize, 60),
    ) {
        let set = set(&scales, &ln_ratios);
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, factor));
        let analysis = analysis(&set, &x, &y);
        let solver = Solver::new(&analysis, 0.05).unwrap();
        let mut scratch = Scratch::default();
        let of_set = solver.solve(&set.once(), &[0.0; KNOTS], &mut scratch).unwrap();
        let mut multiplicities = vec![0; set.len()];
        for draw in draws {
            multiplicities[draw % set.len()] += 1;
        }
        let [sample, care] = [Solver::solve_sample, Solver::solve]
            .map(|solve| solve(&solver, &multiplicities, &of_set.exponents, &mut scratch).unwrap());
        let squares = |fit: &Fit| {
            let curvatures = fit.exponents.windows(3).map(|b| 0.05 * (b[0] - 2.0 * b[1] + b[2]));
            fit.residuals.iter().copied().chain(curvatures).map(|value| value * value).sum::<f64>()
        };
        assert_close(&sample.residuals, &care.residuals, 1e-6)?;
        prop_assert_eq!(sample.is_reached(), care.is_reached());
        // what stands there, computed with care, and the best that is found from there on
        let best = solver.solve(&multiplicities, &sample.exponents, &mut scratch).unwrap();
        prop_assert!((squares(&sample) - squares(&best)).abs() <= 1e-10 * squares(&best), "{sample:?} {best:?}");
        let shares = |fit: &Fit, scratch: &mut Scratch| {
            let mut shares = analysis.own_shares();
            solver.shares(&multiplicities, &fit.exponents, scratch, &mut shares).unwrap();
            shares
        };
        assert_close(&shares(&sample, &mut scratch), &shares(&care, &mut scratch), 1e-6)?;
    }

    #[test]
    fn the_unit_of_y_changes_nothing(
        (scales, ln_ratios) in sets(), unit in prop::sample::select(vec![9.80665, 980.665]),
    ) {
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.3));
        let in_other = hazard("other", "1", unit, 1.3);
        let shifted: Vec<f64> = ln_ratios.iter().map(|ln_ratio| ln_ratio + f64::ln(unit)).collect();
        let (plain, shifted) = (set(&scales, &ln_ratios), set(&scales, &shifted));
        let (plain, shifted) = (analysis(&plain, &x, &y), analysis(&shifted, &x, &in_other));
        let options = RepairOptions::default();
        let (plain, shifted) = (plain.repair(&options).unwrap(), shifted.repair(&options).unwrap());
        assert_close(&shifted.fit.exponents, &plain.fit.exponents, 1e-6)?;
        assert_close(shifted.weights.shares(), plain.weights.shares(), 1e-7)?;
    }

    #[test]
    fn a_record_given_twice_is_one_that_counts_twice((scales, ln_ratios) in sets(), record in 0..25_usize) {
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.3));
        let one = set(&scales, &ln_ratios);
        let mut multiplicities = one.once();
        multiplicities[record] = 2;
        let more = |values: &[f64]| [values, &[values[record]]].concat();
        let two = set(&more(&scales), &more(&ln_ratios));
        let (one, two) = (analysis(&one, &x, &y), analysis(&two, &x, &y));
        let (counted, shares) = solved(&Solver::new(&one, 0.05).unwrap(), &multiplicities);
        let (written, more_shares) = solved(&Solver::new(&two, 0.05).unwrap(), &two.set().once());
        assert_close(&counted, &written, 1e-6)?;
        let weights = RunWeights::new(one.stripes(), &shares).unwrap();
        let more_weights = RunWeights::new(two.stripes(), &more_shares).unwrap();
        // the demand depends on the number of a record: compare the hazard of y itself
        let (implied, written) = (one.implied(Some(&weights)).unwrap(), two.implied(Some(&more_weights)).unwrap());
        for target in targets() {
            let (found, expected) = (implied.exact_ordinate(target).unwrap(), written.exact_ordinate(target).unwrap());
            prop_assert!((found.displacement_m / expected.displacement_m - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_calibration_is_what_a_record_drawn_once_more_moves((scales, ln_ratios) in sets(), record in 0..25_usize) {
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.3));
        let set = set(&scales, &ln_ratios);
        let analysis = analysis(&set, &x, &y);
        let (solver, mut scratch) = (Solver::new(&analysis, 0.05).unwrap(), Scratch::default());
        let all = vec![1000; set.len()];
        let (exponents, shares) = solved(&solver, &all);
        // ln of the implied rate of the site's level at each rate of the fit
        let mut ln_implied = |multiplicities: &[u32], exponents: &[f64; KNOTS]| {
            let mut shares = analysis.own_shares();
            solver.shares(multiplicities, exponents, &mut scratch, &mut shares).unwrap();
            let weights = RunWeights::new(analysis.stripes(), &shares).unwrap();
            let implied = analysis.implied(Some(&weights)).unwrap();
            let ln_rate = |rate: &f64| implied.mean_annual_frequency(y.im_at_rate(*rate).unwrap()).unwrap().ln();
            solver.rates_per_year().iter().map(ln_rate).collect::<Vec<f64>>()
        };
        let mut once_more = all.clone();
        once_more[record] += 1;
        let (before, after) = (ln_implied(&all, &exponents), ln_implied(&once_more, &exponents));
        let mut expected = [0.0; KNOTS];
        for (k, expected) in expected.iter_mut().enumerate() {
            let [less, more] = [-1e-4, 1e-4].map(|step| {
                let mut moved = exponents;
                moved[k] += step;
                ln_implied(&all, &moved)
            });
            let slopes = more.iter().zip(&less).map(|(more, less)| (more - less) / 2e-4);
            let moved = before.iter().zip(&after).map(|(before, after)| after - before);
            *expected = slopes.zip(moved).map(|(slope, moved)| slope * moved).sum();
        }
        let calibration = solver.calibration(&all, &exponents, &mut Scratch::default(), &shares).unwrap();
        for (combination, expected) in calibration.iter().zip(expected) {
            let largest = combination.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
            // a record more of a thousand, and its second order
            prop_assert!((combination[record] - expected).abs() < 5e-3 * largest, "{} {expected}", combination[record]);
            prop_assert!(combination.iter().sum::<f64>().abs() < 1e-9 * largest);
        }
    }

    #[test]
    fn a_record_left_out_is_a_set_without_it((scales, ln_ratios) in sets(), record in 0..25_usize) {
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.3));
        let whole = set(&scales, &ln_ratios);
        let mut multiplicities = whole.once();
        multiplicities[record] = 0;
        let (mut scales, mut ln_ratios) = (scales, ln_ratios);
        scales.remove(record);
        ln_ratios.remove(record);
        let rest = set(&scales, &ln_ratios);
        let (whole, rest) = (analysis(&whole, &x, &y), analysis(&rest, &x, &y));
        let (left_out, shares) = solved(&Solver::new(&whole, 0.05).unwrap(), &multiplicities);
        let (without, _) = solved(&Solver::new(&rest, 0.05).unwrap(), &rest.set().once());
        assert_close(&left_out, &without, 0.0)?;
        prop_assert!(shares.chunks_exact(whole.set().len()).all(|row| row[record] == 0.0));
    }

    #[test]
    fn the_order_of_the_records_changes_nothing_but_rounding((scales, ln_ratios) in sets()) {
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 0.8));
        let reverse = |values: &[f64]| values.iter().rev().copied().collect::<Vec<_>>();
        let (forth, back) = (set(&scales, &ln_ratios), set(&reverse(&scales), &reverse(&ln_ratios)));
        let (forth, back) = (analysis(&forth, &x, &y), analysis(&back, &x, &y));
        let options = RepairOptions::default();
        let (forth, back) = (forth.repair(&options).unwrap(), back.repair(&options).unwrap());
        assert_close(&back.fit.exponents, &forth.fit.exponents, 1e-9)?;
    }

    /// There is one solution, and the derivatives lead to it from anywhere near.
    #[test]
    fn any_start_ends_in_the_same_exponents(
        (scales, ln_ratios) in sets(), step in prop::array::uniform4(-1.0..1.0_f64),
    ) {
        let set = set(&scales, &ln_ratios);
        let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.3));
        let analysis = analysis(&set, &x, &y);
        let solver = Solver::new(&analysis, 0.05).unwrap();
        let mut scratch = Scratch::default();
        let best = solver.solve(&set.once(), &[0.0; KNOTS], &mut scratch).unwrap();
        let start = std::array::from_fn(|k| best.exponents[k] + 3.0 * step[k]);
        let again = solver.solve(&set.once(), &start, &mut scratch).unwrap();
        assert_close(&again.exponents, &best.exponents, 1e-4)?;
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.3));
    let scales = [1.0; 30];
    let ln_ratios: Vec<f64> = (0..30).map(|i| f64::from(i) / 12.0 - 1.2).collect();
    let set = set(&scales, &ln_ratios);
    let of = |set, levels: &[f64], targets: &[f64]| {
        ScaledAnalysis::new(set, levels, &x, &y, targets, Extrapolation::Refuse).map(|_| ())
    };
    let targets = targets();
    assert!(matches!(of(&set, &levels(), &[]), Err(ConsistencyError::NoTargets)));
    assert!(matches!(of(&set, &[2.0, 1.0], &targets), Err(ConsistencyError::Risk(_))));
    assert!(matches!(of(&set, &[1e-3, 1.0], &targets), Err(ConsistencyError::Risk(_))));
    let small = RecordSet::new(vec![SetRecord { scaled_to: 1e160, other: 1e-160, ..set.records()[0] }]).unwrap();
    assert!(matches!(of(&small, &levels(), &targets), Err(ConsistencyError::Intensity { record: 0, .. })));

    let analysis = analysis(&set, &x, &y);
    for value in [-0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(Solver::new(&analysis, value), Err(ConsistencyError::Smoothness { .. })));
    }
    let solver = Solver::new(&analysis, 0.05).unwrap();
    let (mut scratch, start) = (Scratch::default(), [0.0; KNOTS]);
    let error = solver.solve(&[1; 29], &start, &mut scratch).unwrap_err();
    assert!(matches!(error, ConsistencyError::Count { found: 29, expected: 30, .. }), "{error}");
    assert_eq!(solver.solve(&[0; 30], &start, &mut scratch).unwrap_err(), ConsistencyError::NothingDrawn);
    assert_eq!(solver.reach(&[0; 30]).unwrap_err(), ConsistencyError::NothingDrawn);
    let error = solver.shares(&[1; 30], &start, &mut scratch, &mut [0.0; 7]).unwrap_err();
    assert!(matches!(error, ConsistencyError::Count { found: 7, .. }), "{error}");
    let stripes = StripeWeights::new(&[0.1], None).unwrap();
    let other = RunWeights::new(&stripes, &[1.0]).unwrap();
    assert!(analysis.diagnose(Some(&other), [0.2, 5.0]).is_err());

    // two stripes close together leave no range of rates
    let narrow = ScaledAnalysis::new(&set, &[8.0, 9.0], &x, &y, &targets, Extrapolation::Refuse).unwrap();
    assert_eq!(narrow.diagnose(None, [0.2, 5.0]).unwrap().verdict(), None);
    let error = narrow.repair(&RepairOptions::default()).unwrap_err();
    assert!(matches!(error, ConsistencyError::NoRepair(NoRepair::NarrowRange(_))), "{error}");
}

/// Both components of a pair are two records of one pair: they share its weight, and count as one.
#[test]
fn both_components_are_one_pair() {
    let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.3));
    let ln_ratios: Vec<f64> = (0..30).map(|i| f64::from(i) / 12.0 - 1.2).collect();
    let one = set(&[1.0; 30], &ln_ratios);
    let both = RecordSet::new(one.records().iter().flat_map(|record| [*record; 2]).collect()).unwrap();
    let options = RepairOptions::default();
    let [one, both] = [&one, &both].map(|set| analysis(set, &x, &y).repair(&options).unwrap());
    for (one, both) in one.diagnosis.stripes.iter().zip(&both.diagnosis.stripes) {
        assert!((one.effective_records / both.effective_records - 1.0).abs() < 1e-6);
        assert!((one.largest_record_share / both.largest_record_share - 1.0).abs() < 1e-6);
        assert!(2 * one.largest_record == both.largest_record && both.effective_events.is_none());
    }
}

/// By hand: hazards `c x⁻²` and `c y⁻²`, so that y = x at every rate, and records of q from 1.3 to 2 at every level.
/// The least that weights can give is all weight on q = 1.3: `λ̂(y) = λ_x(y/1.3) = 1.69 λ(y)`. What would cure it has y
/// below the site's level when scaled to the same level of x.
#[test]
fn a_set_out_of_reach_comes_so_near() {
    let powers = |levels: Vec<f64>, measure: &str| {
        let rates = levels.iter().map(|level| 0.5 * level.powi(-2)).collect();
        HazardCurve::new(measure, "cm/s", "", levels, rates).unwrap()
    };
    let fine: Vec<f64> = (0..700).map(|i| 1.01_f64.powi(i)).collect();
    let (x, y) = (powers(vec![0.5, 2000.0], "PGV"), powers(vec![0.5, 2000.0], "other"));
    let ln_ratios: Vec<f64> = (0..25).map(|i| f64::ln(1.3) + f64::from(i) / 24.0 * f64::ln(2.0 / 1.3)).collect();
    let of = |ln_ratios: &[f64]| {
        let set = set(&[1.0; 25], ln_ratios);
        let analysis = ScaledAnalysis::new(&set, &fine, &x, &y, &targets(), Extrapolation::Refuse).unwrap();
        match analysis.repair(&RepairOptions::default()).unwrap_err() {
            ConsistencyError::NoRepair(NoRepair::OutOfReach { reach, nearest }) => (reach, nearest),
            other => panic!("{other}"),
        }
    };
    let near = |found: f64, expected: f64, tolerance: f64| {
        assert!((found / expected - 1.0).abs() < tolerance, "{found} {expected}");
    };
    let (reach, nearest) = of(&ln_ratios);
    assert_eq!((reach.set_above, reach.set_below, nearest.too_rarely), (12, 0, None));
    let miss = nearest.too_often.unwrap();
    near(miss.times, 1.69, 0.02);
    near(miss.rate_per_year, 0.5 * miss.level.powi(-2), 1e-9);
    near(miss.scaled_to, miss.level, 1e-9);
    // and from the other side: all weight on q = 1/1.3
    let (reach, nearest) = of(&ln_ratios.iter().map(|ln_ratio| -ln_ratio).collect::<Vec<_>>());
    assert_eq!((reach.set_above, reach.set_below, nearest.too_often), (0, 12, None));
    near(nearest.too_rarely.unwrap().times, 1.0 / 1.69, 0.02);
    near(nearest.too_rarely.unwrap().scaled_to, nearest.too_rarely.unwrap().level, 1e-9);
}

/// Records on both sides of the site's, and none between: weights reach each rate by itself, and no smooth ones all of
/// them. What is told is what the weights of the best exponents give.
#[test]
fn the_nearest_hazard_is_that_of_the_best_weights() {
    let (x, y) = (hazard("PGV", "cm/s", 1.0, 1.0), hazard("other", "1", 1.0, 1.0));
    let ln_ratios: Vec<f64> = (0..30).map(|i| if i % 2 == 0 { 3.0 } else { -3.0 }).collect();
    let set = set(&[1.0; 30], &ln_ratios);
    let analysis = analysis(&set, &x, &y);
    let solver = Solver::new(&analysis, 0.05).unwrap();
    let error = analysis.repair(&RepairOptions::default()).unwrap_err();
    let ConsistencyError::NoRepair(reason) = error else { panic!("{error}") };
    assert!(matches!(reason, NoRepair::NotReached { .. } | NoRepair::Runaway { .. }), "{reason:?}");
    let nearest = reason.nearest().unwrap();
    let (_, shares) = solved(&solver, &set.once());
    let weights = RunWeights::new(analysis.stripes(), &shares).unwrap();
    let implied = analysis.implied(Some(&weights)).unwrap();
    for miss in [nearest.too_often, nearest.too_rarely].into_iter().flatten() {
        let times = implied.mean_annual_frequency(miss.level).unwrap() / miss.rate_per_year;
        assert!((times / miss.times - 1.0).abs() < 1e-9 && (times.ln()).abs() > 0.1, "{times} {miss:?}");
    }
    assert!(solver.nearest_reach(&set.once()).unwrap().is_met());
}
