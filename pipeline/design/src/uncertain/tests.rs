#![allow(clippy::needless_pass_by_value)]
//! Structures whose answers are known: peaks that are written down instead of computed.

use uplift_fragility::LognormalFragility;
use uplift_ida::{AnalysisRow, Cells, Plan, ScaledMotion};
use uplift_motion::{Accelerogram, IntensityMeasure};
use uplift_risk::{RiskCurve, StripeWeights};
use uplift_uncertainty::{Distribution, Family};
use uplift_uniform_risk::pooled_demand;

use super::*;
use crate::hazard::Hazard;

const RECORDS: usize = 40;
const LEVELS: [f64; 8] = [0.05, 0.1, 0.2, 0.4, 0.8, 1.2, 1.6, 2.0];
const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 7.0\nmass_kg = 9000\nrestitution = 0.95\n";

fn structure(uncertainty: &str) -> Structure {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("uncertain.toml");
    std::fs::write(&file, format!("{BLOCK}{uncertainty}")).unwrap();
    Structure::load(&file).unwrap()
}

/// A record's displacement at a level of 1 and a strength of 0.1, m: a lognormal sample.
fn own_m(record: usize) -> f64 {
    quantile(0.17, 0.5, (record as f64 + 0.5) / RECORDS as f64)
}

/// Displacement of a strength under a record, m: known by heart, and of no other quantity.
fn peak_m(record: usize, strength: f64, level: f64) -> f64 {
    own_m(record) * level * 0.1 / strength
}

fn strength(system: &System) -> f64 {
    let System::Oscillator(oscillator) = system else { panic!("{system}") };
    oscillator.strength()
}

/// The stripes of `uncertain` with [`peak_m`] in the place of the solver; what exceeds `lost_m` has overturned.
fn stripes(uncertain: &Uncertain<'_>, lost_m: f64) -> Stripes {
    let accelerogram = Accelerogram::new(0.01, vec![0.0, 1.0, 0.0]).unwrap();
    let motion = |_| ScaledMotion { id: "record", accelerogram: &accelerogram, scales: LEVELS.to_vec() };
    let plan = Plan::scaled((0..RECORDS).map(motion).collect(), &uncertain.systems, true).unwrap();
    let plan = if uncertain.branches.is_none() { plan.with_own_systems().unwrap() } else { plan };
    let mut cells = Cells::unknown(&plan);
    for (motion, system) in (0..RECORDS).flat_map(|motion| (0..plan.axes().systems).map(move |of| (motion, of))) {
        let strength = strength(plan.system(motion, system));
        let known_m = LEVELS.map(|level| match peak_m(motion, strength, level) {
            peak_m if peak_m > lost_m => f64::INFINITY,
            peak_m => peak_m,
        });
        let row = AnalysisRow { motion, system, displacement_m: &known_m, impacts: &[0; LEVELS.len()] };
        assert!(cells.set_row(&row));
    }
    Stripes {
        measure: IntensityMeasure::Pga,
        levels: LEVELS.to_vec(),
        peaks: cells.complete().unwrap(),
        at_level: None,
        analyses: plan.analyses(),
        computed: 0,
        seconds: 0.0,
    }
}

fn weights(factor: f64) -> StripeWeights {
    StripeWeights::new(&LEVELS.map(|level: f64| factor * 1e-4 * level.powf(-2.2)), None).unwrap()
}

/// Every record by itself; or all of them in one, so that nothing can be drawn.
fn scatter(is_one: bool) -> Scatter {
    let records = if is_one { vec![(0..RECORDS).collect()] } else { (0..RECORDS).map(|record| vec![record]).collect() };
    Scatter { pairs: records, earthquakes: None }
}

fn found(
    structure: &Structure,
    lost_m: f64,
    (event, branches): (Event, Vec<(f64, StripeWeights)>),
    scatter: &Scatter,
) -> UncertainFinding {
    let uncertain = Uncertain::from_structure(structure, 0.95, RECORDS).unwrap().unwrap();
    let weights = weights(1.0);
    let hazard = Hazard { mean: &weights, branches };
    let site = SiteQuestions { name: "Here", hazard: &hazard, asked: vec![(event, f64::NAN)] };
    let mut results = uncertain.results(&stripes(&uncertain, lost_m), &[site], scatter).unwrap();
    assert_eq!(results.len(), 1);
    results.remove(0).found
}

fn epistemic(finding: UncertainFinding) -> EpistemicResult {
    let UncertainFinding::Epistemic(result) = finding else { panic!("{finding:?}") };
    result
}

fn aleatory(finding: UncertainFinding) -> AleatoryResult {
    let UncertainFinding::Aleatory(result) = finding else { panic!("{finding:?}") };
    result
}

/// A quantile of a lognormal quantity of that mean and coefficient of variation.
fn quantile(mean: f64, variation: f64, share: f64) -> f64 {
    let of = Distribution::from_mean(Family::Lognormal, (mean, variation), [0.0, f64::INFINITY]);
    of.unwrap().quantile(share)
}

/// The distribution function of a lognormal quantity of that mean and coefficient of variation.
fn lognormal(mean: f64, variation: f64) -> LognormalFragility {
    let variance = (variation * variation).ln_1p();
    LognormalFragility::new(mean * (-0.5 * variance).exp(), variance.sqrt()).unwrap()
}

/// Rate of what happens to a record at a level with a given probability, 1/yr.
fn rate(probability: impl Fn(usize, f64) -> f64) -> f64 {
    let of_level = |(weight, level): (f64, f64)| {
        (0..RECORDS).map(|record| weight * probability(record, level)).sum::<f64>() / RECORDS as f64
    };
    weights(1.0).per_year().into_iter().zip(LEVELS).map(of_level).sum()
}

/// Standard error of the rate of what happens to a record at a level for the structures of given percentiles, with 100
/// independent structures of each record, 1/yr.
fn standard_error(happens: impl Fn(usize, f64, f64) -> bool) -> f64 {
    let weights = weights(1.0).per_year();
    let count = 500;
    let of_record = |record: usize| {
        let of_structure = |index: i32| -> f64 {
            let share = (f64::from(index) + 0.5) / f64::from(count);
            weights
                .iter()
                .zip(LEVELS)
                .filter(|(_, level)| happens(record, *level, share))
                .map(|(weight, _)| weight)
                .sum()
        };
        let rates: Vec<f64> = (0..count).map(of_structure).collect();
        let mean = rates.iter().sum::<f64>() / f64::from(count);
        rates.iter().map(|rate| (rate - mean) * (rate - mean)).sum::<f64>() / f64::from(count)
    };
    ((0..RECORDS).map(of_record).sum::<f64>() / 100.0).sqrt() / RECORDS as f64
}

const NEVER_M: f64 = f64::INFINITY;
const KINDS: [&str; 2] = ["kind = \"epistemic\"\nsamples = 1024\n", "kind = \"aleatory\"\ndraws = 100\n"];

fn of_capacity(kind: &str, variation: f64) -> Structure {
    structure(&format!(
        "[uncertainty]\n{kind}[uncertainty.capacity_m]\ndistribution = \"lognormal\"\n\
         coefficient_of_variation = {variation}\n"
    ))
}

fn of_strength(kind: &str, variation: f64) -> Structure {
    structure(&format!(
        "[uncertainty]\n{kind}[uncertainty.strength]\ndistribution = \"lognormal\"\n\
         coefficient_of_variation = {variation}\n"
    ))
}

/// Capacity alone is uncertain: the risk is λ(u) convolved with the capacity's density, Σ w P(capacity < u) over the
/// runs. Both kinds have it, within the noise of their sampling.
#[test]
fn an_uncertain_capacity_convolves_the_risk_curve() {
    let capacity = lognormal(0.8, 0.3);
    // Γ = 3/2 between the oscillator and the block
    let at = |record: usize, level: f64| 1.5 * peak_m(record, strength_of_block(), level);
    let expected = rate(|record, level| capacity.probability(at(record, level)));
    let [branches, draws] = KINDS.map(|kind| of_capacity(kind, 0.3));
    let found_of =
        |structure: &Structure| found(structure, NEVER_M, (Event::BeyondCapacity, Vec::new()), &scatter(false));
    let band = epistemic(found_of(&branches));
    assert!((band.by_structure.mean / expected - 1.0).abs() < 0.003, "{band:?} {expected}");
    // the same percentiles of the capacity, the other way round: the risk falls with it
    let risk_at = |share: f64| {
        let capacity_m = quantile(0.8, 0.3, share);
        rate(|record, level| f64::from(u8::from(at(record, level) > capacity_m)))
    };
    for (found, share) in band.by_structure.percentiles.iter().zip([0.95, 0.84, 0.5, 0.16, 0.05]) {
        // added in another order
        let (least, most) = (risk_at(share + 0.01) * (1.0 - 1e-12), risk_at(share - 0.01) * (1.0 + 1e-12));
        assert!((least..=most).contains(found), "{share}: {found} {least} {most}");
    }
    let one = aleatory(found_of(&draws));
    let error = standard_error(|record, level, share| at(record, level) > quantile(0.8, 0.3, share));
    assert!((one.value - expected).abs() < 2.5 * error && error < 0.05 * expected, "{one:?} {expected} {error}");
    let [lower, upper] = one.by_record.unwrap();
    assert!(lower < expected && expected < upper);
}

/// Strength at which a spectrum is read (Table 3.1): the slenderness.
fn strength_of_block() -> f64 {
    (0.8_f64 / 7.0).atan()
}

/// Strength alone is uncertain: the risk of overturning is a mixture over the stripes of all strengths.
#[test]
fn an_uncertain_strength_mixes_the_stripes_of_all_strengths() {
    let lost_m = 0.4;
    // lost where 0.1 r level/η > 0.4: where η is below that
    let strength = lognormal(strength_of_block(), 0.2);
    let expected = rate(|record, level| strength.probability(own_m(record) * level * 0.1 / lost_m));
    let [branches, draws] = KINDS.map(|kind| of_strength(kind, 0.2));
    let found_of = |structure: &Structure| found(structure, lost_m, (Event::Overturning, Vec::new()), &scatter(false));
    let band = epistemic(found_of(&branches));
    assert!((band.by_structure.mean / expected - 1.0).abs() < 0.003, "{band:?} {expected}");
    let one = aleatory(found_of(&draws));
    let error = standard_error(|record, level, share| {
        own_m(record) * level * 0.1 / lost_m > quantile(strength_of_block(), 0.2, share)
    });
    assert!((one.value - expected).abs() < 2.5 * error && error < 0.05 * expected, "{one:?} {expected} {error}");
}

/// Without scatter the answers are those of the structure as described, to the bit; with next to none, to rounding.
#[test]
fn without_scatter_nothing_changes() {
    let described = structure("");
    let system = System::Oscillator(described.system.spectral_oscillator(0.95).unwrap());
    for (event, lost_m) in [(Event::Overturning, 0.4), (Event::BeyondCapacity, NEVER_M), (Event::Demand(2e-4), NEVER_M)]
    {
        for known in [of_capacity, of_strength] {
            for kind in KINDS {
                let of = known(kind, 0.0);
                let uncertain = Uncertain::from_structure(&of, 0.95, RECORDS).unwrap().unwrap();
                assert!(uncertain.systems.iter().all(|of| of.identity() == system.identity()), "{event:?} {kind}");
                let stripes = stripes(&uncertain, lost_m);
                let demand = pooled_demand(&stripes, 0).unwrap();
                let weights = weights(1.0);
                let curve = RiskCurve::new(&demand, &weights).unwrap();
                let expected = match event.threshold_m(&system) {
                    Some(threshold_m) => curve.mean_annual_frequency(threshold_m).unwrap(),
                    None => 1.5 * curve.exact_ordinate(2e-4).unwrap().displacement_m,
                };
                assert!(expected > 0.0);
                let answer = |of: &Structure| match found(of, lost_m, (event, Vec::new()), &scatter(false)) {
                    UncertainFinding::Epistemic(result) => result.by_structure.mean,
                    UncertainFinding::Aleatory(result) => result.value,
                };
                assert_eq!(answer(&of).to_bits(), expected.to_bits(), "{event:?} {kind}");
                let next_to_none = answer(&known(kind, 1e-12));
                assert!((next_to_none / expected - 1.0).abs() < 1e-9, "{event:?} {kind}: {next_to_none} {expected}");
            }
        }
    }
}

/// A result that is a product of independent factors, hazard of 1 or 3 and structure: with the squared coefficients of
/// variation h and g of both the shares alone are `h/V` and `g/V`, and in all `h (1 + g)/V` and `g (1 + h)/V`, where
/// `V = h + g + h g`.
#[test]
fn the_shares_are_those_of_a_product() {
    let count = 5_000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for index in 0..count {
        let capacity_m = quantile(0.8, 0.3, (f64::from(index) + 0.5) / f64::from(count));
        let of =
            rate(|record, level| f64::from(u8::from(1.5 * peak_m(record, strength_of_block(), level) > capacity_m)));
        sum += of / f64::from(count);
        squares += of * of / f64::from(count);
    }
    let of_structure = squares / (sum * sum) - 1.0;
    // half 1 and half 3: a mean of 2 and a deviation of 1
    let of_hazard = 0.25;
    let all = of_hazard + of_structure + of_hazard * of_structure;
    let branches = vec![(0.5, weights(1.0)), (0.5, weights(3.0))];
    let result =
        found(&of_capacity("samples = 4096\n", 0.3), NEVER_M, (Event::BeyondCapacity, branches), &scatter(true));
    let EpistemicResult { by_all, shares, .. } = epistemic(result);
    assert!((by_all.mean / (2.0 * sum) - 1.0).abs() < 0.01, "{by_all:?} {sum}");
    assert_eq!(shares.len(), 2, "a single unit cannot be drawn anew: {shares:?}");
    for (factor, alone, other) in [("capacity", of_structure, of_hazard), ("hazard", of_hazard, of_structure)] {
        let share = shares.iter().find(|share| share.factor == factor).unwrap();
        assert!((share.first_order - alone / all).abs() < 0.03, "{share:?} {}", alone / all);
        assert!((share.total - alone * (1.0 + other) / all).abs() < 0.03, "{share:?} {}", alone * (1.0 + other) / all);
    }
}

/// What is correlated is one factor; demands that do not exist have no variance; nothing depends on threads.
#[test]
fn factors_are_independent_groups() {
    let of = structure(
        "[uncertainty]\nsamples = 64\n[uncertainty.strength]\ndistribution = \"normal\"\n\
         coefficient_of_variation = 0.1\n[uncertainty.capacity_m]\ndistribution = \"normal\"\n\
         coefficient_of_variation = 0.1\n[uncertainty.restitution]\ndistribution = \"uniform\"\nlower = 0.9\n\
         upper = 0.98\n[[uncertainty.correlation]]\nbetween = [\"strength\", \"capacity_m\"]\ncoefficient = 0.8\n",
    );
    let ask = |event, lost_m| found(&of, lost_m, (event, Vec::new()), &scatter(false));
    let result = epistemic(ask(Event::BeyondCapacity, NEVER_M));
    let mut factors: Vec<&str> = result.shares.iter().map(|share| share.factor.as_str()).collect();
    factors.sort_unstable();
    assert_eq!(factors, ["records", "restitution", "strength and capacity"]);
    // the peaks that are written down know of no restitution
    let nothing = result.shares.iter().find(|share| share.factor == "restitution").unwrap();
    assert_eq!((nothing.first_order, nothing.total), (0.0, 0.0));
    let lost = epistemic(ask(Event::Demand(2e-4), 0.02));
    assert!(lost.by_structure.mean.is_infinite() && lost.shares.is_empty());
    // two samples of 64, and one mixed of both for each of three factors
    assert!(lost.no_shares.unwrap().contains("in 320 of 320 samples the structure overturns more often"));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one.install(|| epistemic(ask(Event::BeyondCapacity, NEVER_M))), result);
}
