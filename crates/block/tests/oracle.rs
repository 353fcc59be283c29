//! The block against reference cases computed independently with many digits (Eq. 2.1, 2.3 and 2.10).

use std::collections::BTreeMap;

use serde::Deserialize;
use uplift_block::{BlockResponse, FreeRocking, RockingBlock, respond};
use uplift_motion::Accelerogram;

#[derive(Deserialize)]
struct Reference {
    records: BTreeMap<String, Vec<f64>>,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    id: String,
    record: String,
    dt: f64,
    alpha: f64,
    #[serde(rename = "R")]
    size: f64,
    g: f64,
    t_free: f64,
    expected: Expected,
}

#[derive(Deserialize)]
struct Expected {
    overturned: bool,
    theta_max: Option<f64>,
    t_theta_max: Option<f64>,
    u_max: Option<f64>,
    t_uplift: f64,
}

/// Largest relative deviation accepted: the reference itself is known to 6e-15.
const TOLERANCE: f64 = 2e-14;

fn check(case: &Case, found: &BlockResponse) -> f64 {
    let deviation = |found: f64, expected: Option<f64>| expected.map_or(0.0, |expected| (found / expected - 1.0).abs());
    assert_eq!(found.is_overturned(), case.expected.overturned, "{}", case.id);
    let uplift = deviation(found.uplift_s.unwrap(), Some(case.expected.t_uplift));
    if case.expected.overturned {
        assert_eq!(found.rotation_rad, f64::INFINITY);
        return uplift;
    }
    let rotation = deviation(found.rotation_rad, case.expected.theta_max);
    let displacement = deviation(found.displacement_m, case.expected.u_max);
    // a time of a maximum is a double root in the rotation, but a simple one in the velocity
    let time = deviation(found.time_s, case.expected.t_theta_max);
    println!("{}: rotation {rotation:.1e}, displacement {displacement:.1e}, time {time:.1e}", case.id);
    uplift.max(rotation).max(displacement).max(time)
}

#[test]
fn every_reference_case() {
    let reference: Reference = serde_json::from_str(include_str!("data/block_cases.json")).unwrap();
    let mut largest = 0.0_f64;
    for case in &reference.cases {
        let record = Accelerogram::new(case.dt, reference.records[&case.record].clone()).unwrap();
        let block = RockingBlock::new(case.size, case.alpha).unwrap().with_gravity(case.g).unwrap();
        for free in [FreeRocking::FirstPeak, FreeRocking::Lasting { duration_s: case.t_free }] {
            let deviation = check(case, &respond(&block, &record, free).unwrap());
            assert!(deviation < TOLERANCE, "{}: {deviation:e}", case.id);
            largest = largest.max(deviation);
        }
    }
    assert!(reference.cases.len() >= 11);
    println!("largest deviation {largest:.1e}");
}
