//! What must not change the response, or must change it in a known way.

use proptest::prelude::*;
use uplift_frame::{ColumnShape, GroundMotion, Model, Options, PulseShape, RockingFrame, Until, respond};
use uplift_motion::Accelerogram;
use uplift_statics::{Parts, Restrainer, TendonPath};
use uplift_structure::Geometry;

use crate::{held_frame, pulse, two_pulses};

fn records(samples: &[(f64, f64)]) -> [Vec<f64>; 2] {
    [samples.iter().map(|pair| pair.0).collect(), samples.iter().map(|pair| pair.1).collect()]
}

fn peak(frame: &RockingFrame, dt_s: f64, [x, y]: [Vec<f64>; 2], options: &Options) -> [f64; 3] {
    let (x, y) = (Accelerogram::new(dt_s, x).unwrap(), Accelerogram::new(dt_s, y).unwrap());
    let found = respond(frame, &GroundMotion::pair(&x, &y), Model::Wobbling, options).unwrap();
    [found.displacement.value, found.displacement_x.value, found.displacement_y.value]
}

/// A smooth pair of records: a pulse in each component that begins at rest and ends.
fn smooth(amplitudes: (f64, f64), periods: (f64, f64)) -> Vec<(f64, f64)> {
    let at = |t: f64, amplitude: f64, period: f64| {
        if t > period { 0.0 } else { amplitude * (std::f64::consts::TAU * t / period).sin() }
    };
    (0..=150)
        .map(|i| 0.01 * f64::from(i))
        .map(|t| (at(t, amplitudes.0, periods.0), at(t, amplitudes.1, periods.1)))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// A turned pair turns the path: the largest travel stays. Swapped components swap the travels. How much less than
    /// exactly depends on the tilt at uplift, from which the direction is reported.
    #[test]
    fn turned_and_swapped_components(
        x in 2.0..3.5_f64, y in 0.6..2.5_f64, tx in 0.4..0.9_f64, ty in 0.4..0.9_f64, angle in 0.1..6.2_f64,
    ) {
        let frame = held_frame(ColumnShape::Cylinder, 1720e3);
        let options = Options { until: Until::Time(1.5), ..Options::default() };
        let pair = smooth((x, y), (tx, ty));
        let (sin, cos) = angle.sin_cos();
        let turned: Vec<(f64, f64)> = pair.iter().map(|(x, y)| (cos * x - sin * y, sin * x + cos * y)).collect();
        let swapped: Vec<(f64, f64)> = pair.iter().map(|(x, y)| (*y, *x)).collect();
        let found = peak(&frame, 0.01, records(&pair), &options);
        prop_assume!(found[0].is_finite() && found[0] > 1e-3);
        let by_turning = peak(&frame, 0.01, records(&turned), &options);
        let by_swapping = peak(&frame, 0.01, records(&swapped), &options);
        prop_assert!((by_turning[0] / found[0] - 1.0).abs() < 1e-6, "{found:?} {by_turning:?}");
        prop_assert!((by_swapping[1] / found[2] - 1.0).abs() < 1e-6, "{found:?} {by_swapping:?}");
        prop_assert!((by_swapping[2] / found[1] - 1.0).abs() < 1e-6, "{found:?} {by_swapping:?}");
    }

    /// Lengths times λ, times times √λ, accelerations the same, k/m_c over λ: travels times λ (Section 6.4).
    #[test]
    fn similar_frames(scale in 0.1..8.0_f64, x in 2.0..3.5_f64, y in 0.6..2.5_f64) {
        let frame = |scale: f64| {
            let column = Geometry::from_width_and_height(0.197 * scale, 1.45 * scale).unwrap();
            let stiffness = Restrainer::new(Parts::linear(1720e3 / scale)).unwrap();
            RockingFrame::new(column, 4, 124.363, 9435.0, ColumnShape::Cylinder, 9.81).unwrap()
                .with_restrainer(stiffness, TendonPath::Column).unwrap()
        };
        let pair = smooth((x, y), (0.6, 0.8));
        let options = Options { until: Until::Time(1.5), ..Options::default() };
        let scaled = Options { until: Until::Time(1.5 * scale.sqrt()), ..Options::default() };
        let found = peak(&frame(1.0), 0.01, records(&pair), &options);
        prop_assume!(found[0].is_finite() && found[0] > 1e-3);
        let similar = peak(&frame(scale), 0.01 * scale.sqrt(), records(&pair), &scaled);
        prop_assert!((similar[0] / (scale * found[0]) - 1.0).abs() < 1e-6, "{found:?} {similar:?}");
    }

    /// A constant vertical acceleration is gravity.
    #[test]
    fn constant_vertical_shaking_is_gravity(a in -3.0..3.0_f64, x in 2.0..4.0_f64) {
        let column = Geometry::from_width_and_height(0.197, 1.45).unwrap();
        let of = |gravity: f64| {
            RockingFrame::new(column, 4, 124.363, 9435.0, ColumnShape::Rectangle, gravity).unwrap()
        };
        let level = Accelerogram::new(0.5, vec![a; 5]).unwrap();
        let shaken = pulse(PulseShape::Sine, x, 0.6, 0.1);
        let options = Options { until: Until::Time(2.0), ..Options::default() };
        let with = GroundMotion { x: shaken, y: None, z: Some(uplift_frame::Shaking::Record(&level)) };
        let without = GroundMotion { x: shaken, ..GroundMotion::default() };
        let found = respond(&of(9.81), &with, Model::Planar, &options).unwrap();
        let expected = respond(&of(9.81 + a), &without, Model::Planar, &options).unwrap();
        prop_assert_eq!(found.overturned, expected.overturned);
        if !found.overturned && expected.rotation.value > 0.0 {
            prop_assert!((found.rotation.value / expected.rotation.value - 1.0).abs() < 1e-10);
        }
    }
}

/// Shaking along one line is planar motion in that direction: with the cylinder's inertia, no restitution.
#[test]
fn one_direction_is_planar_motion() {
    let frame = held_frame(ColumnShape::Cylinder, 1720e3);
    let options = Options { restitution: Some(0.95), until: Until::Time(4.0), ..Options::default() };
    let alone = GroundMotion { x: pulse(PulseShape::Sine, 3.0, 0.55, 0.1), ..GroundMotion::default() };
    let planar = respond(&frame, &alone, Model::Planar, &options).unwrap();
    assert!(planar.impacts > 2);
    let oblique = GroundMotion {
        x: pulse(PulseShape::Sine, 1.8, 0.55, 0.1),
        y: pulse(PulseShape::Sine, -2.4, 0.55, 0.1),
        z: None,
    };
    let options = Options { rest_amplitude_rad: Some(0.0), ..options };
    let wobbling = respond(&frame, &oblique, Model::Wobbling, &options).unwrap();
    assert!((wobbling.displacement.value / planar.displacement.value - 1.0).abs() < 1e-11);
    assert!((wobbling.displacement_x.value / planar.displacement.value - 0.6).abs() < 1e-11);
    assert!((wobbling.displacement_y.value / planar.displacement.value - 0.8).abs() < 1e-11);
}

/// The tilt at uplift goes out of the result as it goes to zero: tenfold smaller, tenfold closer.
#[test]
fn the_tilt_at_uplift_does_not_matter_in_the_end() {
    let frame = held_frame(ColumnShape::Cylinder, 1720e3);
    let at = |start_rotation_rad: f64| {
        let options = Options { start_rotation_rad, until: Until::Time(3.0), ..Options::default() };
        respond(&frame, &two_pulses(), Model::Wobbling, &options).unwrap().displacement.value
    };
    let exact = at(1e-14);
    let (coarse, fine) = ((at(1e-7) / exact - 1.0).abs(), (at(1e-10) / exact - 1.0).abs());
    assert!(coarse < 1e-4 && fine < 1e-7 && fine < 0.1 * coarse, "{coarse:e} {fine:e}");
}
