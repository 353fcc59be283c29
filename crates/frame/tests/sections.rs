//! Forces on the ends of the columns: with them every column obeys Newton's laws, which the solver never asks.

use uplift_frame::{
    ColumnShape, GroundMotion, Model, Options, PulseShape, RockingFrame, Until, respond, respond_with_history,
};
use uplift_motion::Accelerogram;
use uplift_statics::{Parts, Restrainer, TendonPath};

use crate::{pulse, table_frame};

/// A sine in x and a triangle upwards, and what the latter is at a time, m/s².
fn ground(vertical: &Accelerogram) -> GroundMotion<'_> {
    let x = pulse(PulseShape::Sine, 2.4, 0.6, 0.1);
    GroundMotion { x, z: Some(uplift_frame::Shaking::Record(vertical)), ..GroundMotion::default() }
}

/// Moments about the middle of a free column: `I θ̈ = R cos(α − θ)(F₁ − H) − R sin(α − θ)(P + N)` with `F₁`, `P` on its
/// top, `H` and `N` under its base, and `H = m_c a − F₁`.
#[test]
fn a_column_turns_as_its_end_forces_say() {
    let vertical = Accelerogram::new(0.5, vec![0.0, 2.0, -1.0, 0.0]).unwrap();
    let z_m_s2 = |time_s: f64| {
        let [a, b] = if time_s < 0.5 {
            [0.0, 2.0]
        } else if time_s < 1.0 {
            [2.0, -1.0]
        } else {
            [-1.0, 0.0]
        };
        if time_s < 1.5 { a + (b - a) * (time_s / 0.5).fract() } else { 0.0 }
    };
    let frame = table_frame(ColumnShape::Rectangle);
    let options = Options { until: Until::Time(1.45), ..Options::default() };
    let (found, history) = respond_with_history(&frame, &ground(&vertical), Model::Planar, &options).unwrap();
    assert!(!found.overturned);
    let (alpha, size_m) = (frame.geometry().slenderness_rad(), frame.geometry().size_m());
    let (mass_kg, gravity) = (frame.column_mass_kg(), frame.gravity_m_s2());
    let sine = |time_s: f64| {
        let share = (time_s - 0.1) / 0.6;
        if (0.0..=1.0).contains(&share) { 2.4 * (std::f64::consts::TAU * share).sin() } else { 0.0 }
    };
    let mut compared = 0;
    for row in history.rows.iter().filter(|row| row.rotation_rad.abs() > 1e-4) {
        let sections = frame.sections(row, z_m_s2(row.time_s)).unwrap();
        let (tilt, side) = (row.rotation_rad.abs(), row.rotation_rad.signum());
        let (sin, cos) = (alpha - tilt).sin_cos();
        let (deck_m_s2, ground_m_s2) = (side * row.deck_acceleration_x_m_s2, side * sine(row.time_s));
        // U' = 2R cos(α − θ), U'' = 2R sin(α − θ)
        let own_m_s2 = deck_m_s2 - ground_m_s2;
        let turning = (own_m_s2 / (2.0 * size_m) - sin * row.velocity_rad_s.powi(2)) / cos;
        // N and V of the top section are P and F₁ in other directions
        let (sin_tilt, cos_tilt) = tilt.sin_cos();
        let load_n = sections.top_axial_n * cos_tilt + sections.top_shear_n * sin_tilt;
        let push_n = sections.top_shear_n * cos_tilt - sections.top_axial_n * sin_tilt;
        let base_shear_n = mass_kg * (0.5 * own_m_s2 + ground_m_s2) - push_n;
        let moment = size_m * cos * (push_n - base_shear_n) - size_m * sin * (load_n + sections.base_axial_n);
        let inertia = mass_kg * size_m * size_m / 3.0;
        let scale = size_m * sin.abs().max(0.1) * mass_kg * gravity;
        assert!((moment - inertia * turning).abs() < 1e-6 * scale, "{} s: {moment} {}", row.time_s, inertia * turning);
        compared += 1;
    }
    assert!(compared >= 3, "{compared}");
}

/// A tendon presses on the section that it crosses, and closed sections say nothing.
#[test]
fn a_tendon_presses_on_the_top() {
    let restrainer = || Restrainer::new(Parts::linear(1720e3)).unwrap();
    let held = |path| table_frame(ColumnShape::Cylinder).with_restrainer(restrainer(), path).unwrap();
    let ground = GroundMotion {
        x: pulse(PulseShape::Sine, 2.6, 0.55, 0.1),
        y: pulse(PulseShape::Cosine, 1.6, 0.7, 0.25),
        z: None,
    };
    for (path, through_base) in [(TendonPath::Column, 0.0), (TendonPath::Foundation, 1.0)] {
        let frame: RockingFrame = held(path);
        let peak_s = respond(&frame, &ground, Model::Wobbling, &Options::default()).unwrap().rotation.time_s;
        let options = Options { until: Until::Time(peak_s), ..Options::default() };
        let (_, history) = respond_with_history(&frame, &ground, Model::Wobbling, &options).unwrap();
        assert_eq!(frame.sections(&history.rows[0], 0.0), None);
        let row = history.rows.last().unwrap();
        let found = frame.sections(row, 0.0).unwrap();
        let bare = frame.sections(&uplift_frame::HistoryRow { tendon_n: 0.0, ..*row }, 0.0).unwrap();
        assert!(row.tendon_n > 1e3);
        assert!((found.top_axial_n - bare.top_axial_n - row.tendon_n).abs() < 1e-9 * found.top_axial_n);
        assert!(
            (found.base_axial_n - bare.base_axial_n - through_base * row.tendon_n).abs() < 1e-9 * found.base_axial_n
        );
        assert!((found.top_moment_n_m / found.top_axial_n / frame.geometry().half_width_m() - 1.0).abs() < 1e-15);
    }
}
