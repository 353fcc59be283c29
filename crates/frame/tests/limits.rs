//! Limits in which the frame is something known.

use std::f64::consts::PI;

use uplift_frame::{
    ColumnShape, FrameState, GroundMotion, Model, Options, PulseShape, RockingFrame, Start, Until, respond,
};
use uplift_statics::{Parts, Restrainer, TendonPath};
use uplift_structure::Geometry;

use crate::{held_frame, pulse, table_frame};

/// As the columns grow slender the frame is the linear oscillator of Eq. 6.4: let go from u₀, each column obeys
/// M θ̈ = −(g/R)(α − θ) − (k b²/μR²) θ. Halving the slenderness quarters what is left.
#[test]
fn slender_frames_are_the_oscillator_of_equation_6_4() {
    for ratio_to_critical in [0.5, 1.0, 2.0] {
        let error = |slenderness: f64| {
            let column = Geometry::from_slenderness_and_size(slenderness, 2.0).unwrap();
            let (column_kg, deck_kg) = (100.0, 1000.0);
            let mass_kg = column_kg + 2.0 * deck_kg;
            let gravity = 9.81;
            // k b² = ratio · μ g R: the stiffness at which gravity and spring cancel
            let stiffness = ratio_to_critical * mass_kg * gravity * 2.0 / column.half_width_m().powi(2);
            let frame = RockingFrame::new(column, 1, column_kg, deck_kg, ColumnShape::Rectangle, gravity).unwrap();
            let restrainer = Restrainer::new(Parts::linear(stiffness)).unwrap();
            let frame = frame.with_restrainer(restrainer, TendonPath::Column).unwrap();
            let fall = gravity / 2.0;
            let inertia = (4.0 / 3.0 * column_kg + 4.0 * deck_kg) / mass_kg;
            let start = 0.5 * slenderness;
            let time = 0.3 * (inertia / fall).sqrt();
            let options = Options {
                start: Start::Tilted(FrameState { rotation_rad: start, ..FrameState::default() }),
                until: Until::Time(time),
                ..Options::default()
            };
            let found = respond(&frame, &GroundMotion::default(), Model::Planar, &options).unwrap().end.rotation_rad;
            // θ̈ = −(fall/M) [α + (ratio − 1) θ]
            let (rate, excess) = (fall / inertia, ratio_to_critical - 1.0);
            let exact = if excess == 0.0 {
                start - 0.5 * rate * slenderness * time * time
            } else {
                let rest = -slenderness / excess;
                let square = rate * excess;
                let wave = if square > 0.0 { (square.sqrt() * time).cos() } else { ((-square).sqrt() * time).cosh() };
                rest + (start - rest) * wave
            };
            (found / exact - 1.0).abs()
        };
        let (coarse, fine) = (error(0.1), error(0.05));
        assert!(coarse < 1e-2, "{ratio_to_critical}: {coarse:e}");
        assert!((coarse / fine - 4.0).abs() < 0.2, "{ratio_to_critical}: {coarse:e} {fine:e}");
    }
}

/// A linear tendon anchored in the foundation is one of four times the stiffness at the column's foot: an identity.
#[test]
fn a_foundation_anchorage_is_four_times_as_stiff() {
    let column = held_frame(ColumnShape::Rectangle, 3200e3);
    let restrainer = Restrainer::new(Parts::linear(800e3)).unwrap();
    let foundation = table_frame(ColumnShape::Rectangle).with_restrainer(restrainer, TendonPath::Foundation).unwrap();
    let ground = GroundMotion { x: pulse(PulseShape::Sine, -3.2, 0.5, 0.1), ..GroundMotion::default() };
    let peak = |frame| respond(frame, &ground, Model::Planar, &Options::default()).unwrap();
    let (one, other) = (peak(&column), peak(&foundation));
    assert!((one.displacement.value / other.displacement.value - 1.0).abs() < 1e-12);
    assert!((one.tendon_n.unwrap() / (2.0 * other.tendon_n.unwrap()) - 1.0).abs() < 1e-12);
    assert!(one.displacement.value > 0.05);
}

/// A deck on columns without mass: M → 4γ, κ → cos α. A passage by the apex turns the lean by π/cos α.
#[test]
fn a_deck_alone() {
    let column = Geometry::from_width_and_height(0.4, 2.0).unwrap();
    let frame = RockingFrame::new(column, 2, 0.0, 5000.0, ColumnShape::Cylinder, 9.81).unwrap();
    let alpha = column.slenderness_rad();
    // Housner's number of a mass at the top alone: cos 2α
    assert!((frame.momentum_restitution() - (2.0 * alpha).cos()).abs() < 1e-14);
    // M = 4 m_b/N over μ = 2 m_b/N
    let expected = (9.81 / (2.0 * column.size_m())).sqrt();
    assert!((frame.frequency_parameter_rad_s() / expected - 1.0).abs() < 1e-14);
    let start = FrameState { rotation_rad: 1e-4, velocity_rad_s: -0.5, turning_rad_s: 0.05, direction_rad: 0.0 };
    let options = Options {
        start: Start::Tilted(start),
        until: Until::Time(0.02),
        rest_amplitude_rad: Some(0.0),
        ..Options::default()
    };
    let found = respond(&frame, &GroundMotion::default(), Model::Wobbling, &options).unwrap();
    assert!((found.end.direction_rad - PI / alpha.cos()).abs() < 2e-3, "{}", found.end.direction_rad);
}

/// Prestress raises the threshold by `T0 tan α/((1 + 2γ) m_c)`, vertical shaking lowers it with gravity.
#[test]
fn the_threshold_of_uplift() {
    let free = table_frame(ColumnShape::Cylinder);
    let tangent = 0.0985 / 0.725;
    assert!((free.uplift_acceleration_m_s2() / (9.81 * tangent) - 1.0).abs() < 1e-14);
    let mass_kg = 124.363 + 2.0 * 9435.0 / 4.0;
    for (path, openings) in [(TendonPath::Column, 1.0), (TendonPath::Foundation, 2.0)] {
        let parts = Parts { prestress_n: 2000.0, ..Parts::linear(1720e3) };
        let frame = free.clone().with_restrainer(Restrainer::new(parts).unwrap(), path).unwrap();
        let expected = tangent * (9.81 + openings * 2000.0 / mass_kg);
        assert!((frame.uplift_acceleration_m_s2() / expected - 1.0).abs() < 1e-14);
        for (factor, moves) in [(1.0 - 1e-9, false), (1.0 + 1e-9, true)] {
            let ground =
                GroundMotion { x: pulse(PulseShape::Cosine, factor * expected, 2.0, 0.1), ..GroundMotion::default() };
            for model in [Model::Planar, Model::Wobbling] {
                let found = respond(&frame, &ground, model, &Options::default()).unwrap();
                assert_eq!(found.uplift_s.is_some(), moves, "{path:?} {factor} {model:?}");
                if !moves {
                    assert_eq!(found.displacement.value, 0.0);
                    assert!((found.deck_acceleration.value / (factor * expected) - 1.0).abs() < 1e-12);
                }
            }
        }
    }
}
