//! An outside golden case: the risk-targeted ground motion of the U.S. Geological Survey, public test "Fox Plaza".
//!
//! The hazard points, the uniform-hazard value, the iterates of the risk-targeted ground motion and their risk ratios
//! are those of the public test of the USGS risk-targeted ground motion calculator
//! (github.com/usgs/earthquake-rtgm-calculator).

use uplift_fragility::LognormalFragility;
use uplift_hazard::{HazardCurve, rate_from_probability};
use uplift_risk::{lognormal_risk, risk_targeted_level};

/// SA(1 s), g, and annual frequency of exceedance.
const HAZARD: [(f64, f64); 20] = [
    (0.0025, 0.4782),
    (0.00375, 0.3901),
    (0.00563, 0.3055),
    (0.00844, 0.2322),
    (0.0127, 0.1716),
    (0.019, 0.1241),
    (0.0285, 0.08621),
    (0.0427, 0.05687),
    (0.0641, 0.03492),
    (0.0961, 0.01985),
    (0.144, 0.01045),
    (0.216, 0.005_095),
    (0.324, 0.002_302),
    (0.487, 0.000_937_1),
    (0.73, 0.000_330_8),
    (1.09, 9.488e-5),
    (1.64, 1.952e-5),
    (2.46, 2.174e-6),
    (3.69, 8.553e-8),
    (5.54, 1.315e-10),
];

const DISPERSION: f64 = 0.8;

/// Φ⁻¹(0.1) = −1.2815515655446004: collapse has probability 0.1 at the risk-targeted ground motion.
const QUANTILE_10_PERCENT: f64 = -1.281_551_565_544_600_4;

fn hazard() -> HazardCurve {
    let (im, maf) = HAZARD.into_iter().unzip();
    HazardCurve::new("SA(1.0)", "g", "USGS, Fox Plaza", im, maf).unwrap()
}

#[test]
fn uniform_hazard_value() {
    let value = hazard().im_at_rate(rate_from_probability(0.02, 50.0).unwrap()).unwrap();
    assert!((value / 0.675_385_717_276_94 - 1.0).abs() < 1e-12, "{value}");
}

/// Ground motions and the reference's ratios of risk to target.
const ITERATES: [(f64, f64); 3] = [
    (0.675_385_717_276_94, 0.899_371_394_753_18),
    (0.607_422_594_543_74, 1.154_465_023_832_8),
    (0.645_635_436_438_57, 1.000_773_923_928_9),
];

fn fragility(ground_motion: f64) -> LognormalFragility {
    LognormalFragility::new(ground_motion * (-QUANTILE_10_PERCENT * DISPERSION).exp(), DISPERSION).unwrap()
}

fn target() -> f64 {
    rate_from_probability(0.01, 50.0).unwrap()
}

/// The reference's own scheme: the curve resampled at a constant ratio, ∫ λ p dx by trapezoids, p
/// the lognormal density.
fn trapezoid_ratio(ratio: f64, fragility: &LognormalFragility) -> f64 {
    let hazard = hazard();
    let (first, last) = (hazard.first().im, hazard.last().im);
    let integrand = |x: f64| {
        let z = (x / fragility.median()).ln() / DISPERSION;
        let density = (-0.5 * z * z).exp() / (x * DISPERSION * std::f64::consts::TAU.sqrt());
        density * hazard.rate_at(x).unwrap()
    };
    let points: Vec<f64> =
        std::iter::successors(Some(first), |&x| (x < last).then_some((x * ratio).min(last))).collect();
    let risk: f64 = points.windows(2).map(|x| 0.5 * (integrand(x[0]) + integrand(x[1])) * (x[1] - x[0])).sum();
    risk / target()
}

#[test]
fn risk_ratios_of_the_iterates() {
    for (ground_motion, expected) in ITERATES {
        let risk = lognormal_risk(&hazard(), &fragility(ground_motion));
        let ratio = risk.per_year / target();
        // The reference sums by trapezoids on steps of 5 %: it is the coarser of the two, by 0.0396 %.
        assert!((ratio / expected - 1.0).abs() < 4e-4, "{ratio} against {expected}");
        assert!(risk.upper_tail_per_year < 1e-6 * risk.per_year);
    }
}

#[test]
fn the_difference_is_the_trapezoid_rule_of_the_reference() {
    for (ground_motion, expected) in ITERATES {
        let fragility = fragility(ground_motion);
        // Its scheme on its steps gives its ratios; on steps a hundred times finer it gives ours.
        assert!((trapezoid_ratio(1.05, &fragility) / expected - 1.0).abs() < 2e-8);
        let exact = lognormal_risk(&hazard(), &fragility).per_year / target();
        assert!((trapezoid_ratio(1.0005, &fragility) / exact - 1.0).abs() < 1e-7);
    }
}

/// The reference's risk coefficient: risk-targeted over uniform-hazard value of 2 % in 50 years.
const RISK_COEFFICIENT: f64 = 0.955_950_681_103_65;

#[test]
fn risk_coefficient() {
    let found = risk_targeted_level(&hazard(), target(), 0.1, DISPERSION).unwrap();
    assert!((found.risk.per_year / target() - 1.0).abs() < 1e-12);
    let uniform_hazard = hazard().im_at_rate(rate_from_probability(0.02, 50.0).unwrap()).unwrap();
    // The reference stops 0.077 % above its target, by sums that are 0.04 % too large; as the risk falls about with the
    // power -2.4 of the ground motion, that is 0.016 % of it.
    let coefficient = found.level / uniform_hazard;
    assert!((coefficient / RISK_COEFFICIENT - 1.0).abs() < 2e-4, "{coefficient}");
}

/// The reference's iteration, with the exact integral: the first step by the ratio of risk to target, the others
/// between the last two in logarithms, until the ratio is within 1 %.
#[test]
fn the_iteration_of_the_reference_stops_at_its_coefficient() {
    let ratio = |ground_motion: f64| lognormal_risk(&hazard(), &fragility(ground_motion)).per_year / target();
    let first = ITERATES[0].0;
    let second = first * ratio(first);
    let slope = (second / first).ln() / (ratio(second) / ratio(first)).ln();
    let third = second * (-ratio(second).ln() * slope).exp();
    assert!((ratio(third) - 1.0).abs() < 0.01);
    for (found, (expected, _)) in [first, second, third].into_iter().zip(ITERATES) {
        assert!((found / expected - 1.0).abs() < 5e-4, "{found} {expected}");
    }
    assert!((third / first / RISK_COEFFICIENT - 1.0).abs() < 5e-4);
}
