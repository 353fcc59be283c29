//! What a wobbling frame with a restitution loses, and that it never gains.

use proptest::prelude::*;
use uplift_frame::{
    ColumnShape, FrameState, GroundMotion, Model, Options, Start, Until, respond, respond_with_history,
};
use uplift_motion::Accelerogram;

use crate::{held_frame, table_frame, two_pulses};

fn tilted(rotation_rad: f64, velocity_rad_s: f64, turning_rad_s: f64, until: Until, restitution: f64) -> Options {
    let state = FrameState { rotation_rad, direction_rad: 0.3, velocity_rad_s, turning_rad_s };
    Options { start: Start::Tilted(state), until, restitution: Some(restitution), ..Options::default() }
}

/// `κ` of the frame of the shaking table, `κ² = lim J/(θ² M)`.
fn kappa() -> f64 {
    let ratio = 9435.0 / (4.0 * 124.363);
    let (sin, cos) = table_frame(ColumnShape::Cylinder).geometry().slenderness_rad().sin_cos();
    let tilt = (48.0 * ratio + 15.0 + cos * cos) / 12.0;
    (((1.0 + 4.0 * ratio) * cos * cos + 0.25 * sin * sin + cos * cos / 3.0) / tilt).sqrt()
}

/// `2λ` of that frame with a restitution.
fn drag(restitution: f64) -> f64 {
    let decrement = -restitution.ln() / std::f64::consts::PI;
    2.0 * kappa() * decrement / (1.0 + decrement * decrement).sqrt()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Free motion loses energy at every moment, and its momentum falls by the same part with every radian.
    #[test]
    fn energy_never_grows_and_the_momentum_is_a_power_of_the_turn(
        rotation in 0.005..0.12_f64, velocity in -0.3..0.3_f64, turning in 0.01..2.0_f64, stiffness in 0.0..4e6_f64,
        restitution in 0.8..1.0_f64, side in prop::bool::ANY,
    ) {
        let frame = held_frame(ColumnShape::Cylinder, stiffness);
        let turning = if side { turning } else { -turning };
        let options = tilted(rotation, velocity, turning, Until::Time(1.5), restitution);
        let (found, history) =
            respond_with_history(&frame, &GroundMotion::default(), Model::Wobbling, &options).unwrap();
        let energies: Vec<f64> = (history.rows.iter())
            .map(|row| frame.energy_j(row.rotation_rad, row.velocity_rad_s, row.turning_rad_s))
            .collect();
        prop_assert!(energies.windows(2).all(|pair| pair[1] <= pair[0] * (1.0 + 1e-12)), "{energies:?}");
        prop_assume!(!found.overturned && found.rests == 0);
        let end = found.end;
        prop_assert!(frame.energy_j(end.rotation_rad, end.velocity_rad_s, end.turning_rad_s) < energies[0]);
        let momentum = |rotation: f64, turning: f64| frame.angular_momentum_kg_m2_s(rotation, turning);
        let left = momentum(end.rotation_rad, end.turning_rad_s) / momentum(rotation, turning);
        let expected = (-drag(restitution) * (end.direction_rad - 0.3).abs()).exp();
        prop_assert!((left / expected - 1.0).abs() < 1e-8, "{left} {expected}");
    }

    /// Whether the frame survives, and how far it goes, is what six seconds of integration say.
    #[test]
    fn the_first_free_peak_is_the_largest(
        rotation in 0.01..0.25_f64, velocity in -0.4..0.4_f64, turning in 0.0..1.5_f64, stiffness in 0.0..2.5e6_f64,
        restitution in 0.7..0.99_f64,
    ) {
        let frame = held_frame(ColumnShape::Cylinder, stiffness);
        let ground = GroundMotion::default();
        let [peak, time] = [Until::FirstFreePeak, Until::Time(6.0)].map(|until| {
            let options = tilted(rotation, velocity, turning, until, restitution);
            respond(&frame, &ground, Model::Wobbling, &options).unwrap()
        });
        prop_assert_eq!(peak.overturned, time.overturned);
        if !peak.overturned {
            prop_assert!((peak.rotation.value / time.rotation.value - 1.0).abs() < 1e-10);
        }
    }

    /// The motion does not depend on where its steps end: records of half the interval, on the same straight lines,
    /// give the same. The lean turns to one side and to the other, and what it loses bends where it stops turning.
    #[test]
    fn the_loss_does_not_depend_on_the_steps(
        amplitudes in (2.0..3.2_f64, 1.0..2.4_f64), periods in (0.4..0.9_f64, 0.3..0.7_f64),
        restitution in 0.5..0.99_f64,
    ) {
        let frame = held_frame(ColumnShape::Cylinder, 1720e3);
        let at = |t: f64, amplitude: f64, period: f64| amplitude * (std::f64::consts::TAU * t / period).sin();
        let coarse = |amplitude: f64, period: f64| -> Vec<f64> {
            (0..=60).map(|i| at(0.02 * f64::from(i), amplitude, period)).collect()
        };
        let halved = |coarse: &[f64]| -> Vec<f64> {
            let last = coarse[coarse.len() - 1];
            coarse.windows(2).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]).chain([last]).collect()
        };
        let [x, y] = [coarse(amplitudes.0, periods.0), coarse(amplitudes.1, periods.1)];
        let state = FrameState { rotation_rad: 0.02, direction_rad: 0.4, velocity_rad_s: 0.0, turning_rad_s: 0.3 };
        let (start, until) = (Start::Tilted(state), Until::Time(0.6));
        let options = Options { start, until, restitution: Some(restitution), ..Options::default() };
        let run = |dt_s: f64, x: Vec<f64>, y: Vec<f64>| {
            let [x, y] = [x, y].map(|samples| Accelerogram::new(dt_s, samples).unwrap());
            respond(&frame, &GroundMotion::pair(&x, &y), Model::Wobbling, &options).unwrap().end
        };
        let fine = run(0.01, halved(&x), halved(&y));
        let coarse = run(0.02, x, y);
        prop_assert!((fine.rotation_rad - coarse.rotation_rad).abs() < 1e-10, "{fine:?} {coarse:?}");
        prop_assert!((fine.turning_rad_s - coarse.turning_rad_s).abs() < 1e-7 * (1.0 + coarse.turning_rad_s.abs()));
    }
}

/// At uplift the lean begins to turn from zero, to a side that rounding decides at first.
#[test]
fn a_frame_that_leaves_the_ground_under_two_components_goes_on() {
    let frame = held_frame(ColumnShape::Cylinder, 1720e3);
    let wave = |period: f64, phase: f64| -> Vec<f64> {
        (0..300).map(|i| 2.3 * (std::f64::consts::TAU * (0.01 * f64::from(i) / period + phase)).sin()).collect()
    };
    for phase in 0..40 {
        let phase = 0.025 * f64::from(phase);
        let [x, y] = [wave(0.63, phase), wave(0.47, 1.7 * phase)].map(|wave| Accelerogram::new(0.01, wave).unwrap());
        let options = Options { restitution: Some(0.95), ..Options::default() };
        let found = respond(&frame, &GroundMotion::pair(&x, &y), Model::Wobbling, &options).unwrap();
        assert!(found.uplift_s.is_some() && found.rotation.value > 1e-3, "{phase}: {found:?}");
    }
}

/// A frame that all but falls upon its upright goes on as the planar one with the same restitution.
#[test]
fn beside_the_upright_it_is_the_impact_of_the_planar_model() {
    let frame = table_frame(ColumnShape::Cylinder);
    for restitution in [0.6, 0.95] {
        let end = |model: Model, turning: f64| {
            let mut options = tilted(1e-3, -0.5, turning, Until::Time(0.006), restitution);
            if let (Model::Planar, Start::Tilted(state)) = (model, &mut options.start) {
                state.direction_rad = 0.0;
            }
            respond(&frame, &GroundMotion::default(), model, &options).unwrap().end
        };
        let planar = end(Model::Planar, 0.0);
        assert!(planar.rotation_rad < 0.0 && planar.velocity_rad_s < -0.9 * restitution * 0.5);
        // it comes within 1e-9 and within 1e-13 rad of the upright: by series, and in closed form
        for (closest, tolerance) in [(1e-9, 1e-5), (1e-13, 1e-9)] {
            let found = end(Model::Wobbling, 0.5 * closest / 1e-6);
            let ratios = [found.rotation_rad / planar.rotation_rad, found.velocity_rad_s / planar.velocity_rad_s];
            assert!(ratios.iter().all(|ratio| (ratio + 1.0).abs() < tolerance), "{restitution} {closest}: {ratios:?}");
        }
    }
}

/// Without a restitution nothing is lost, to the bit; with one just below 1 the motion is nearly that.
#[test]
fn no_restitution_is_no_loss() {
    let frame = held_frame(ColumnShape::Cylinder, 1720e3);
    let run = |restitution: Option<f64>| {
        let options = Options { restitution, until: Until::Time(2.0), ..Options::default() };
        respond(&frame, &two_pulses(), Model::Wobbling, &options).unwrap()
    };
    let none = run(None);
    assert_eq!(none, run(Some(1.0)));
    let (slight, some) = (run(Some(1.0 - 1e-9)), run(Some(0.9)));
    assert!((slight.rotation.value / none.rotation.value - 1.0).abs() < 1e-7);
    assert!(some.rotation.value < 0.999 * none.rotation.value);
    for wrong in [0.05, 1.01, f64::NAN] {
        let options = Options { restitution: Some(wrong), ..Options::default() };
        let error = respond(&frame, &two_pulses(), Model::Wobbling, &options).unwrap_err().to_string();
        assert!(error.contains("restitution") && error.contains("between 0.1 and 1"), "{error}");
    }
}
