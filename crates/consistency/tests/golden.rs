//! Rows of numbers of an independent prototype, and how closely they are to be met.

use uplift_consistency::{Agreement, RecordSet, RepairOptions, Repaired, ScaledAnalysis};
use uplift_hazard::HazardCurve;
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};

use crate::common::{ONE_BY_ONE, ScaledTo, Site, targets};

/// One site by one measure, at 2, 10 and 50 % in 50 years.
pub(crate) struct Row {
    pub(crate) implied: [f64; 3],
    pub(crate) over_site: [f64; 3],
    pub(crate) bias_rms_max: [f64; 3],
    pub(crate) exponents: [f64; 4],
    pub(crate) effective: [f64; 3],
    pub(crate) least_effective: f64,
    pub(crate) largest_share: f64,
}

/// Within an absolute tolerance.
fn close(what: &str, found: f64, expected: f64, tolerance: f64) {
    let difference = (found - expected).abs();
    assert!(difference <= tolerance, "{what}: {found}, expected {expected} within {tolerance}");
}

/// Within a relative one.
fn relative(what: &str, found: f64, expected: f64, tolerance: f64) {
    close(what, found, expected, tolerance * expected.abs());
}

/// Compares an analysis with its row; the tolerances are those of intensities in another rounding, which may move a
/// record over a level: 5e-4 of levels, 0.002 of deviations, 0.05 of exponents, 1 % of effective numbers.
pub(crate) fn compare(name: &str, analysis: &ScaledAnalysis<'_>, row: &Row) -> Repaired {
    let options = RepairOptions::default();
    let before = analysis.diagnose(None, options.scale_factor_limits).unwrap();
    let deviation = before.deviation.as_ref().unwrap();
    for (index, target) in before.targets.iter().enumerate() {
        relative(&format!("{name}, implied level {index}"), target.implied_level, row.implied[index], 5e-4);
        relative(&format!("{name}, ratio {index}"), target.ratio.unwrap(), row.over_site[index], 5e-4);
    }
    let found = [deviation.bias, deviation.rms, deviation.max];
    for (index, what) in ["bias", "rms", "max"].into_iter().enumerate() {
        close(&format!("{name}, {what}"), found[index], row.bias_rms_max[index], 0.002);
    }
    let repaired = analysis.repair(&options).unwrap();
    println!("{name}: b {:?}, {} steps", repaired.fit.exponents, repaired.fit.iterations);
    for (k, (&found, &expected)) in repaired.fit.exponents.iter().zip(&row.exponents).enumerate() {
        close(&format!("{name}, exponent {k}"), found, expected, 0.05);
    }
    let after = &repaired.diagnosis;
    for (index, target) in after.targets.iter().enumerate() {
        let found = after.stripes[target.stripe].effective_records;
        relative(&format!("{name}, effective records {index}"), found, row.effective[index], 0.01);
    }
    let least = after.least_effective.unwrap().records;
    relative(&format!("{name}, least effective"), least, row.least_effective, 0.01);
    let in_range = after.stripes.iter().enumerate().filter(|(level, _)| analysis.is_in_range(*level));
    let largest = in_range.map(|(_, stripe)| stripe.largest_record_share).fold(0.0, f64::max);
    relative(&format!("{name}, largest share"), largest, row.largest_share, 0.01);
    repaired
}

/// Compares repaired ordinates, m, `[strength]`, at one target: 3 %, below 1 mm 5 %.
pub(crate) fn compare_ordinates(
    name: &str,
    repaired: &Repaired,
    demands: &[PooledDemand],
    target_per_year: f64,
    expected_m: &[f64],
) {
    for (index, &expected) in ONE_BY_ONE.into_iter().zip(expected_m) {
        let curve = RiskCurve::weighted(&demands[index], &repaired.weights).unwrap();
        let found = curve.exact_ordinate(target_per_year).unwrap().displacement_m;
        let tolerance = if expected < 1e-3 { 0.05 } else { 0.03 };
        println!("{name}, strength {index}: {found:.6} {expected:.6} {:+.1e}", found / expected - 1.0);
        relative(&format!("{name}, ordinate {index}"), found, expected, tolerance);
    }
}

/// Ordinates by PGA and by PGV, m, at all strengths and targets: of records that count alike, and repaired.
pub(crate) fn both_ways(
    demands: &[Vec<PooledDemand>; 2],
    stripes: [&StripeWeights; 2],
    repaired: &[Repaired; 2],
    targets_per_year: &[f64],
) -> [Vec<(f64, f64)>; 2] {
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for (by_pgv, by_pga) in demands[0].iter().zip(&demands[1]) {
        for &target in targets_per_year {
            let by = |curve: Result<RiskCurve<'_>, _>| curve.unwrap().exact_ordinate(target).unwrap().displacement_m;
            before.push((by(RiskCurve::new(by_pga, stripes[1])), by(RiskCurve::new(by_pgv, stripes[0]))));
            let [pgv, pga] = repaired;
            let weighted = RiskCurve::weighted;
            after.push((by(weighted(by_pga, &pga.weights)), by(weighted(by_pgv, &pgv.weights))));
        }
    }
    [before, after]
}

/// Ratios of the ordinates of 10 mm and more.
pub(crate) fn from_10_mm(pairs_m: &[(f64, f64)]) -> Agreement {
    Agreement::from_pairs(pairs_m.iter().copied(), 0.01, f64::INFINITY).unwrap()
}

/// By PGA over by PGV stays within 20 % at 10 mm and more: the weights are the same whichever measure the set was
/// scaled to. Before the repair it does not.
pub(crate) fn agree([before, after]: &[Vec<(f64, f64)>; 2]) {
    let (before, after) = (from_10_mm(before), from_10_mm(after));
    println!("by PGA over by PGV: {before:?} before, {after:?} after");
    assert!(after.smallest > 1.0 / 1.2 && after.largest < 1.2, "{after:?}");
    assert!(before.geometric_mean > 1.2, "{before:?}");
}

/// A set that is consistent already needs no weights: with its own implied hazard, at 400 levels, for the site's, no
/// exponent is above 0.1 and no ordinate changes by more than 7 %.
pub(crate) fn needs_nothing(set: &RecordSet, site: &Site, scaled_to: ScaledTo, demands: &[PooledDemand]) {
    let first = site.analysis(set, scaled_to);
    let implied = first.implied(None).unwrap();
    let levels = first.levels();
    let (lowest, highest) = set.ratios().iter().fold((f64::INFINITY, 0.0_f64), |(lowest, highest), &ratio| {
        (lowest.min(levels[0] * ratio), highest.max(levels[levels.len() - 1] * ratio))
    });
    let (mut own_levels, mut own_rates) = (Vec::new(), Vec::new());
    for i in 0..400 {
        let level = lowest * (highest / lowest).powf(f64::from(i) / 400.0);
        let rate = implied.mean_annual_frequency(level).unwrap();
        // between two steps of the rate there is but one level
        if own_rates.last().is_none_or(|&last| rate < last) {
            own_levels.push(level);
            own_rates.push(rate);
        }
    }
    let own = HazardCurve::new("its own", "any", "", own_levels, own_rates).unwrap();
    let analysis = site.analysis_with(set, scaled_to, &own);
    let repaired = analysis.repair(&RepairOptions::default()).unwrap();
    println!("already consistent: {:?}", repaired.fit.exponents);
    assert!(repaired.fit.exponents.iter().all(|exponent| exponent.abs() < 0.1), "{:?}", repaired.fit);
    for demand in demands {
        for target in targets() {
            let of = |curve: RiskCurve<'_>| curve.exact_ordinate(target).unwrap().displacement_m;
            let after = of(RiskCurve::weighted(demand, &repaired.weights).unwrap());
            let before = of(RiskCurve::new(demand, analysis.stripes()).unwrap());
            assert!((after / before - 1.0).abs() < 0.07, "{after} {before}");
        }
    }
}

/// The standard deviation of ln q at the stripes of the targets.
pub(crate) fn scatter(repaired: &Repaired) -> Vec<f64> {
    let after = &repaired.diagnosis;
    after.targets.iter().map(|target| after.stripes[target.stripe].sd_ln_ratio).collect()
}

/// Multiplicities that keep `count` records: those of the smallest ratio, or of the largest.
pub(crate) fn keep(set: &RecordSet, count: usize, smallest: bool) -> Vec<u32> {
    let mut order: Vec<usize> = (0..set.len()).collect();
    order.sort_by(|&a, &b| set.ratios()[a].total_cmp(&set.ratios()[b]));
    if !smallest {
        order.reverse();
    }
    let mut multiplicities = vec![0; set.len()];
    for &record in &order[..count] {
        multiplicities[record] = 1;
    }
    multiplicities
}
