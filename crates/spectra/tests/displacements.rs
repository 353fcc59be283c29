//! Displacements, percentiles and designs against the solvers called one by one, and against cases solved by hand.

use std::sync::atomic::{AtomicU64, Ordering};

use proptest::prelude::*;
use uplift_block::{FreeRocking, RockingBlock};
use uplift_ida::{IdaError, Peaks, System, Unwatched, Watch, analyse};
use uplift_motion::IntensityMeasure::{Pga, Pgv};
use uplift_motion::{Accelerogram, STANDARD_GRAVITY_M_S2 as G};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, PostUplift};
use uplift_spectra::{
    Case, MotionSet, NUDGES, NoiseSweep, ROUNDING, RecordOfSet, RestrainedDesign, ScaledBy, Scaling, SolitaryDesign,
    SpectraError, critical, percentile,
};
use uplift_structure::Rule;

/// A few seconds of two waves under an envelope, different for every `seed`.
fn shaking(seed: u32) -> Accelerogram {
    let (slow, fast) = (2.0 + 0.7 * f64::from(seed), 7.0 + 1.3 * f64::from(seed));
    let at = |i: u32| {
        let t = 0.01 * f64::from(i);
        (2.0 * (slow * t).sin() + 1.5 * (fast * t).cos()) * (std::f64::consts::PI * t / 6.0).sin()
    };
    Accelerogram::new(0.01, (0..=600).map(at).collect()).unwrap()
}

fn records() -> Vec<(String, [Accelerogram; 2])> {
    (0..3).map(|i| (format!("record {i}"), [shaking(2 * i), shaking(2 * i + 1)])).collect()
}

fn set(records: &[(String, [Accelerogram; 2])]) -> MotionSet<'_> {
    let records = records.iter().map(|(id, [h1, h2])| RecordOfSet { id, components: [h1, h2] });
    MotionSet::new("waves", records, G).unwrap()
}

/// Peak displacements over `[motion, system, scaling]`.
fn displacements(
    set: &MotionSet<'_>,
    scalings: &[Scaling],
    systems: &[System],
    watch: &dyn Watch,
) -> Result<Peaks, IdaError> {
    analyse(&set.plan(scalings, systems, true)?, watch)
}

fn case<'a>(set: &'a MotionSet<'a>, scaling: Scaling) -> Case<'a> {
    Case { set, scaling, nudge: 1.0, carry_out: &|plan| analyse(plan, &Unwatched) }
}

fn to(measure: uplift_motion::IntensityMeasure, multiple: f64, by: ScaledBy) -> Scaling {
    Scaling::To { measure, multiple, by }
}

#[test]
fn peaks_medians_and_factors_by_hand() {
    // two samples a component: PGA is the larger, PGV half a second times their mean
    let component = |a: f64| Accelerogram::new(0.5, vec![a, a]).unwrap();
    let pairs = [[1.0, 4.0], [9.0, 1.0], [2.0, 8.0]].map(|pair| pair.map(component));
    let set =
        MotionSet::new("by hand", pairs.iter().map(|[h1, h2]| RecordOfSet { id: "r", components: [h1, h2] }), 10.0)
            .unwrap();
    // geometric means of PGA: 2, 3, 4 m/s²; of PGV: 1, 1.5, 2 m/s
    assert!((set.median_pga_g() - 0.3).abs() < 1e-15 && (set.median_pgv_cm_s() - 150.0).abs() < 1e-12);
    assert_eq!(set.motions()[1].id, "r h2");
    assert_eq!(set.factors(Scaling::Unscaled), [1.0; 6]);
    let close = |found: Vec<f64>, expected: [f64; 6]| {
        assert!(found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-14), "{found:?} {expected:?}");
    };
    close(set.factors(to(Pga, 2.0, ScaledBy::Component)), [6.0, 1.5, 6.0 / 9.0, 6.0, 3.0, 0.75]);
    close(set.factors(to(Pgv, 2.0, ScaledBy::Record)), [3.0, 3.0, 2.0, 2.0, 1.5, 1.5]);
    assert_eq!(to(Pga, 0.5, ScaledBy::Record).to_string(), "0.5 PGA");
}

#[test]
fn what_cannot_be_scaled_is_named() {
    let (silent, loud) = (Accelerogram::new(0.1, vec![0.0; 3]).unwrap(), shaking(0));
    let silent = MotionSet::new("s", [RecordOfSet { id: "RSN1", components: [&loud, &silent] }], G).unwrap_err();
    assert!(silent.to_string().starts_with("RSN1 h2: its PGA is 0"), "{silent}");
    assert!(matches!(MotionSet::new("empty", [], G), Err(SpectraError::EmptySet { .. })));
}

#[test]
fn displacements_are_those_of_the_solvers_called_one_by_one() {
    let records = records();
    let set = set(&records);
    let scalings = [Scaling::Unscaled, to(Pga, 2.0, ScaledBy::Component), to(Pgv, 0.5, ScaledBy::Record)];
    let negative = PostUplift::Negative { capacity_m: 0.4 };
    let oscillator = |post_uplift| Oscillator::new(0.1, G, 0.0005, 0.95, post_uplift).unwrap();
    let block = RockingBlock::from_height(4.0, 0.1).unwrap();
    let systems = [
        System::Oscillator(oscillator(PostUplift::Zero)),
        System::Oscillator(oscillator(negative)),
        System::Block(block),
    ];
    let all = displacements(&set, &scalings, &systems, &Unwatched).unwrap();
    let (mut overturned, mut moved) = (0, 0);
    for (at, scaling) in scalings.iter().enumerate() {
        for (motion, factor) in set.factors(*scaling).into_iter().enumerate() {
            let scaled = set.motions()[motion].accelerogram.scaled(factor).unwrap();
            let excitation = Excitation::new(scaled.dt_s(), scaled.acceleration_m_s2()).unwrap();
            for (system, post_uplift) in [PostUplift::Zero, negative].into_iter().enumerate() {
                let one = uplift_oscillator::respond(&oscillator(post_uplift), &excitation, FreeVibration::FirstPeak);
                let (expected, found) = (one.peak_displacement_m, all.at_m([motion, system, at]));
                assert!(
                    found == expected || (found / expected - 1.0).abs() < 1e-8,
                    "{scaling} {motion}: {found} {expected}"
                );
            }
            let one = uplift_block::respond(&block, &scaled, FreeRocking::FirstPeak).unwrap();
            assert_eq!(all.at_m([motion, 2, at]).to_bits(), one.displacement_m.to_bits());
            moved += usize::from(one.displacement_m > 0.0);
            overturned += usize::from(one.displacement_m.is_infinite());
        }
    }
    assert!(moved > 10 && overturned > 0 && overturned < moved, "{moved} {overturned}");
    assert_eq!(all.displacement_m().len(), 3 * 3 * 6);
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let records = records();
    let set = set(&records);
    let systems: Vec<_> = (1..20).map(|i| System::Oscillator(Oscillator::zsbe(0.02 * f64::from(i)).unwrap())).collect();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| displacements(&set, &[Scaling::Unscaled], &systems, &Unwatched).unwrap())
    };
    assert_eq!(on(1), on(3));
}

#[derive(Default)]
struct StopAfter(AtomicU64, u64);

impl Watch for StopAfter {
    fn finished(&self, analyses: u64) {
        self.0.fetch_add(analyses, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) >= self.1
    }
}

#[test]
fn every_analysis_is_counted_and_work_can_be_stopped() {
    let records = records();
    let set = set(&records);
    let systems: Vec<_> = (1..5).map(|i| System::Oscillator(Oscillator::zsbe(0.1 * f64::from(i)).unwrap())).collect();
    let scalings = [Scaling::Unscaled, to(Pga, 1.0, ScaledBy::Record)];
    let count = StopAfter(AtomicU64::new(0), u64::MAX);
    displacements(&set, &scalings, &systems, &count).unwrap();
    assert_eq!(count.0.into_inner(), 2 * 4 * 6);
    let stopped = displacements(&set, &scalings, &systems, &StopAfter(AtomicU64::new(0), 10));
    assert!(matches!(stopped, Err(IdaError::Cancelled)));
}

#[test]
fn percentiles_and_where_a_line_begins() {
    let infinite = f64::INFINITY;
    // numpy.percentile([4, 1, inf, 2], [0, 50, 60, 100]): positions 0, 1.5, 1.8, 3
    let sample = [4.0, 1.0, infinite, 2.0];
    assert_eq!([0.0, 50.0, 100.0].map(|percent| percentile(&sample, percent)), [1.0, 3.0, infinite]);
    assert!((percentile(&sample, 60.0) - 3.6).abs() < 1e-14);
    assert_eq!(percentile(&sample, 84.0), infinite);
    assert_eq!(critical(&[0.1, 0.2, 0.3, 0.4], &[infinite, 1.0, infinite, 0.5]), Some(0.3));
    assert_eq!(critical(&[0.1, 0.2], &[1.0, 0.5]), None);
}

#[test]
fn a_restrained_design_is_its_procedure_step_by_step() {
    let records = records();
    let set = set(&records);
    let design = RestrainedDesign {
        strength: 0.08,
        uplift_displacement_m: 0.0005,
        restitution: 0.95,
        gravity_m_s2: G,
        least_capacity_m: 0.1,
        safety_factor: 2.5,
        percent: 50.0,
        with_free_vibration: true,
    };
    let scaling = to(Pga, 1.0, ScaledBy::Record);
    let noise = NoiseSweep::new(0.01, 3).unwrap();
    let median = |strength, post_uplift| {
        let system = System::Oscillator(Oscillator::new(strength, G, 0.0005, 0.95, post_uplift).unwrap());
        percentile(&displacements(&set, &[scaling], &[system], &Unwatched).unwrap().over_motions_m(0, 0), 50.0)
    };
    let zero_m = median(0.08, PostUplift::Zero);
    for (rule, factor) in [(Rule::EqualDisplacement, 2.5), (Rule::EqualEnergy, 3.125)] {
        let example = design.example(case(&set, scaling), rule, noise).unwrap();
        assert_eq!(example.zero_stiffness_m.value, zero_m);
        // Eq. 3.15, whose equal energy is 3.125 times but for the uplift displacement
        let capacity_m = example.capacity_m.value;
        assert!(zero_m > 0.04 && (capacity_m / zero_m - factor).abs() < 0.02, "{capacity_m} {zero_m}");
        assert_eq!(example.time_history_m.value, median(0.08, PostUplift::Negative { capacity_m }));
        assert!((example.rule_m.value * 2.5 / capacity_m - 1.0).abs() < 1e-12);
        assert!((example.error.value - (example.rule_m.value / example.time_history_m.value - 1.0)).abs() < 1e-14);
        let beside = [0.99, 1.01].map(|factor| median(factor * 0.08, PostUplift::Zero));
        assert!(beside.iter().all(|value| example.zero_stiffness_m.holds(*value)));
        assert!(example.zero_stiffness_m.lowest < example.zero_stiffness_m.highest);
    }
    // a structure with a large capacity of its own needs no restraint
    let wide = RestrainedDesign { least_capacity_m: 50.0, ..design };
    let example = wide.example(case(&set, scaling), Rule::EqualEnergy, noise).unwrap();
    assert_eq!(example.capacity_m.value, 50.0);
}

#[test]
fn a_solitary_design_lies_on_the_capacity_line() {
    let records = records();
    let set = set(&records);
    let design = SolitaryDesign {
        height_m: 10.0,
        endless_height_m: 1000.0,
        gravity_m_s2: G,
        restitution: None,
        safety_factor: 2.5,
        percent: 50.0,
        search: [0.001, 1.0],
        search_ratio: 1.05,
    };
    let noise = NoiseSweep::new(0.01, 3).unwrap();
    let example = design.example(case(&set, Scaling::Unscaled), noise).unwrap();
    let median = |height_m, tangent: f64| {
        let block = System::Block(RockingBlock::from_height(height_m, tangent.atan()).unwrap());
        percentile(&displacements(&set, &[Scaling::Unscaled], &[block], &Unwatched).unwrap().over_motions_m(0, 0), 50.0)
    };
    let tangent = example.design_tangent.value;
    // the endless block stands at the intersection and not a little below it
    let critical = tangent / 2.5;
    assert!(median(1000.0, critical) <= 10.0 * critical);
    assert!(median(1000.0, critical * (1.0 - 1.01e-4)) > 10.0 * critical * (1.0 - 1.01e-4));
    assert_eq!(example.endless_m.value, median(1000.0, tangent));
    assert_eq!(example.block_m.value, median(10.0, tangent));
    assert!(example.block_m.value > 0.0 && (example.capacity_m - 10.0 * tangent).abs() < 1e-12);
    let low = SolitaryDesign { search: [0.5, 1.0], ..design }.example(case(&set, Scaling::Unscaled), noise);
    assert!(low.unwrap_err().to_string().contains("nowhere between tan(alpha) = 0.5 and 1"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// As the capacity grows the negative-stiffness system becomes the zero-stiffness one.
    #[test]
    fn large_capacities_do_not_matter(strength in 0.02..0.3_f64, multiple in 0.5..2.0_f64) {
        let records = records();
        let set = set(&records);
        let oscillator = |post_uplift| {
            System::Oscillator(Oscillator::new(strength, G, 0.0005, 0.0, post_uplift).unwrap())
        };
        let systems = [PostUplift::Zero, PostUplift::Negative { capacity_m: 1e7 }].map(oscillator);
        let scaling = to(Pgv, multiple, ScaledBy::Component);
        let all = displacements(&set, &[scaling], &systems, &Unwatched).unwrap();
        for (zero, negative) in all.over_motions_m(0, 0).iter().zip(all.over_motions_m(1, 0)) {
            // every impact ends the motion, so nothing here is chaotic
            prop_assert!((zero - negative).abs() <= 1e-4 * zero.max(1e-3), "{zero} {negative}");
        }
    }
}

/// A design is repeated with scale factors a rounding away, and its well-conditioned values hardly move.
#[test]
fn rounding_repeats_a_design_a_rounding_away() {
    let records = records();
    let set = set(&records);
    let scaling = to(Pga, 1.0, ScaledBy::Record);
    let own = set.factors(scaling);
    let seen = std::sync::Mutex::new(Vec::new());
    let carry_out = |plan: &uplift_ida::Plan<'_>| {
        let relative: Vec<f64> =
            plan.motions().iter().zip(&own).map(|(motion, own)| motion.scales[0] / own - 1.0).collect();
        seen.lock().unwrap().push(relative);
        analyse(plan, &Unwatched)
    };
    let case = Case { set: &set, scaling, nudge: 1.0, carry_out: &carry_out };
    let design = RestrainedDesign {
        strength: 0.1,
        uplift_displacement_m: 0.0005,
        restitution: 0.95,
        gravity_m_s2: G,
        least_capacity_m: 1.0,
        safety_factor: 2.5,
        percent: 50.0,
        with_free_vibration: true,
    };
    let example = design.example(case, Rule::EqualEnergy, NoiseSweep::new(0.01, 3).unwrap()).unwrap();
    assert!(seen.lock().unwrap().drain(..).flatten().all(|relative| relative == 0.0));
    let rounding = design.rounding(case, Rule::EqualEnergy, &example).unwrap();
    let seen = seen.into_inner().unwrap();
    // zero and negative stiffness, smaller and larger
    let signs: Vec<f64> = seen.iter().map(|relative| relative[0].signum()).collect();
    assert_eq!(signs, [-1.0, -1.0, 1.0, 1.0].repeat(NUDGES / 2));
    let steps: Vec<f64> = (1..=NUDGES / 2).flat_map(|step| [step as f64 * ROUNDING; 4]).collect();
    for (relative, step) in seen.iter().zip(steps) {
        assert!(relative.iter().all(|relative| (relative.abs() - step).abs() < 5e-16), "{step}: {relative:?}");
    }
    for (rounding, value) in [
        (rounding.zero_stiffness_m, example.zero_stiffness_m.value),
        (rounding.capacity_m, example.capacity_m.value),
        (rounding.time_history_m, example.time_history_m.value),
        (rounding.rule_m, example.rule_m.value),
    ] {
        assert_eq!(rounding.value.to_bits(), value.to_bits());
        assert!(rounding.holds(value) && rounding.highest - rounding.lowest < 1e-6 * value, "{rounding:?}");
    }
}
