//! What cannot be is refused, in words that say what to do.

use uplift_frame::{
    ColumnShape, FrameState, GroundMotion, Model, Options, PulseShape, RockingFrame, Start, Until, respond,
};
use uplift_motion::Accelerogram;
use uplift_statics::{Parts, Restrainer, Spring, TendonPath, WhenFlat};
use uplift_structure::Geometry;

use crate::{pulse, stack, table_frame, two_pulses};

fn message(frame: &RockingFrame, ground: &GroundMotion<'_>, model: Model, options: &Options) -> String {
    respond(frame, ground, model, options).unwrap_err().to_string()
}

#[test]
fn rectangles_do_not_wobble() {
    let found = message(&table_frame(ColumnShape::Rectangle), &two_pulses(), Model::Wobbling, &Options::default());
    assert!(found.contains("planar model") && found.contains("cylinder"), "{found}");
}

#[test]
fn ground_that_falls_as_fast_as_gravity() {
    let frame = table_frame(ColumnShape::Rectangle);
    let drop = Accelerogram::new(0.1, vec![0.0, -5.0, -12.0, 0.0]).unwrap();
    let ground = GroundMotion { z: Some(uplift_frame::Shaking::Record(&drop)), ..two_pulses() };
    let found = message(&frame, &ground, Model::Planar, &Options::default());
    assert!(found.contains("at 0.1687 s") && found.contains("leave the ground"), "{found}");
}

#[test]
fn springs_that_stop_the_columns() {
    let parts = Parts { when_flat: WhenFlat::Stop, ..Parts::from_spring(Spring::Discs(stack(2))) };
    let frame = table_frame(ColumnShape::Rectangle)
        .with_restrainer(Restrainer::new(parts).unwrap(), TendonPath::Column)
        .unwrap();
    let ground = GroundMotion { x: pulse(PulseShape::Ricker, 8.6, 0.8, 0.0), ..GroundMotion::default() };
    let found = message(&frame, &ground, Model::Planar, &Options::default());
    assert!(found.contains("springs are flat"), "{found}");
}

#[test]
fn numbers_out_of_range() {
    let column = Geometry::from_width_and_height(0.197, 1.45).unwrap();
    for (columns, column_kg, deck_kg, gravity) in
        [(0, 1.0, 1.0, 9.81), (1, -1.0, 1.0, 9.81), (1, 0.0, 0.0, 9.81), (1, 1.0, f64::NAN, 9.81), (1, 1.0, 1.0, 0.0)]
    {
        assert!(RockingFrame::new(column, columns, column_kg, deck_kg, ColumnShape::Rectangle, gravity).is_err());
    }
    let refusal = |column, deck_kg| {
        RockingFrame::new(column, 1, 1.0, deck_kg, ColumnShape::Rectangle, 9.81).unwrap_err().to_string()
    };
    let stocky = Geometry::from_width_and_height(5.0, 2.0).unwrap();
    assert!(refusal(stocky, 1.0).contains("slenderness alpha is 1.19029 rad"), "{}", refusal(stocky, 1.0));
    let heavy = refusal(column, 1_000_000_100_000_000.0);
    assert!(heavy.contains("deck mass is 1000000100000000 kg"), "{heavy}");
    let frame = table_frame(ColumnShape::Cylinder);
    let state = |rotation_rad, turning_rad_s| {
        Start::Tilted(FrameState { rotation_rad, turning_rad_s, ..FrameState::default() })
    };
    for options in [
        Options { restitution: Some(1.1), ..Options::default() },
        Options { rest_amplitude_rad: Some(-1.0), ..Options::default() },
        Options { start_rotation_rad: 0.0, ..Options::default() },
        Options { until: Until::Time(f64::INFINITY), ..Options::default() },
        Options { until: Until::Time(1e12), ..Options::default() },
        Options { start: state(2.0, 0.0), ..Options::default() },
        Options { start: state(-0.1, 1.0), ..Options::default() },
        Options { start: state(0.1, f64::NAN), ..Options::default() },
    ] {
        assert!(respond(&frame, &two_pulses(), Model::Wobbling, &options).is_err(), "{options:?}");
    }
}

/// A frame that overturns has no largest displacement: +∞ in every component, never NaN.
#[test]
fn overturned_is_infinite() {
    let frame = table_frame(ColumnShape::Cylinder);
    let ground = GroundMotion {
        x: pulse(PulseShape::Sine, 3.5, 0.9, 0.1),
        y: pulse(PulseShape::Cosine, 2.4, 0.9, 0.1),
        z: None,
    };
    let found = respond(&frame, &ground, Model::Wobbling, &Options::default()).unwrap();
    assert!(found.overturned);
    for peak in [found.rotation, found.displacement, found.displacement_x, found.displacement_y] {
        assert_eq!(peak.value, f64::INFINITY);
    }
    // told when it is lost, before it lies
    assert!(found.rotation.time_s < 2.03, "{}", found.rotation.time_s);
}
