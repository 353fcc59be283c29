//! Without deck and restrainers the frame is the block of Chapter 2, and with a deck a larger block (Eq. 6.3, 6.5).

use proptest::prelude::*;
use uplift_block::{FreeRocking, RockingBlock};
use uplift_frame::{ColumnShape, GroundMotion, Model, Options, RockingFrame, respond};
use uplift_motion::Accelerogram;
use uplift_structure::Geometry;

fn frame(slenderness: f64, size_m: f64, deck_ratio: f64, gravity: f64) -> RockingFrame {
    let column = Geometry::from_slenderness_and_size(slenderness, size_m).unwrap();
    RockingFrame::new(column, 1, 1000.0, 1000.0 * deck_ratio, ColumnShape::Rectangle, gravity).unwrap()
}

/// The cases of the block, known to 6e-15.
#[test]
fn every_reference_case_of_the_block() {
    let file: serde_json::Value =
        serde_json::from_str(include_str!("../../block/tests/data/block_cases.json")).unwrap();
    let number = |of: &serde_json::Value, name: &str| of[name].as_f64().unwrap();
    let mut largest = 0.0_f64;
    let cases = file["cases"].as_array().unwrap();
    for case in cases {
        let samples = file["records"][case["record"].as_str().unwrap()].as_array().unwrap();
        let samples = samples.iter().map(|a| a.as_f64().unwrap()).collect();
        let record = Accelerogram::new(number(case, "dt"), samples).unwrap();
        let frame = RockingFrame::block(number(case, "R"), number(case, "alpha"), number(case, "g")).unwrap();
        let expected = &case["expected"];
        let found = respond(&frame, &GroundMotion::along_x(&record), Model::Planar, &Options::default()).unwrap();
        assert_eq!(found.overturned, expected["overturned"].as_bool().unwrap(), "{}", case["id"]);
        let deviation = |ours: f64, name: &str| (ours / number(expected, name) - 1.0).abs();
        largest = largest.max(deviation(found.uplift_s.unwrap(), "t_uplift"));
        if !found.overturned {
            largest = largest.max(deviation(found.rotation.value, "theta_max"));
            largest = largest.max(deviation(found.displacement.value, "u_max"));
            largest = largest.max(deviation(found.rotation.time_s, "t_theta_max"));
        }
    }
    println!("{} cases, largest deviation {largest:.1e}", cases.len());
    assert!(cases.len() >= 11 && largest < 1e-13, "{largest:e}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// With a deck the frame is the block of size R (1 + 3γ)/(1 + 2γ), which loses less at an impact.
    #[test]
    fn a_deck_makes_it_a_larger_block(
        slenderness in 0.1..0.3_f64, size in 1.0..6.0_f64, ratio in 0.0..20.0_f64,
        samples in prop::collection::vec(-6.0..6.0_f64, 40),
    ) {
        let record = Accelerogram::new(0.05, samples).unwrap();
        let frame = frame(slenderness, size, ratio, 9.81);
        let loss = 1.5 * slenderness.sin().powi(2) * (1.0 + 4.0 * ratio) / (1.0 + 3.0 * ratio);
        prop_assert!((frame.momentum_restitution() - (1.0 - loss)).abs() < 1e-14);
        let larger = size * (1.0 + 3.0 * ratio) / (1.0 + 2.0 * ratio);
        let block = RockingBlock::new(larger, slenderness).unwrap().with_gravity(9.81).unwrap();
        let block = block.with_restitution(1.0 - loss).unwrap();
        let expected = uplift_block::respond(&block, &record, FreeRocking::FirstPeak).unwrap();
        let found = respond(&frame, &GroundMotion::along_x(&record), Model::Planar, &Options::default()).unwrap();
        prop_assert_eq!(found.overturned, expected.is_overturned());
        if !found.overturned && expected.rotation_rad > 0.0 {
            let deviation = (found.rotation.value / expected.rotation_rad - 1.0).abs();
            prop_assert!(deviation < 1e-9, "{:e} after {} impacts", deviation, expected.impacts);
        }
    }
}
