//! The solver against reference cases in 50-digit and binary128 arithmetic, each within its own tolerance.

use std::collections::HashMap;

use serde::Deserialize;
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, PostUplift, respond};

#[derive(Deserialize)]
struct Cases {
    records: HashMap<String, Vec<f64>>,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    id: String,
    record: String,
    dt: f64,
    eta: f64,
    scale: f64,
    u_up: f64,
    u_cap: Option<f64>,
    r_c: f64,
    g: f64,
    t_free: f64,
    expected: Expected,
    suggested_rel_tol: f64,
    n_impacts_comparable: bool,
}

#[derive(Deserialize)]
struct Expected {
    u_max: Option<f64>,
    t_umax: Option<f64>,
    n_impacts: u32,
    n_uplifts: u32,
    u_max_record_only: Option<f64>,
    u_end: Option<f64>,
    v_end: Option<f64>,
    collapsed: bool,
}

fn cases() -> Cases {
    serde_json::from_str(include_str!("data/nsbe_cases.json")).unwrap()
}

fn oscillator(case: &Case) -> Oscillator {
    let post_uplift = case.u_cap.map_or(PostUplift::Zero, |capacity_m| PostUplift::Negative { capacity_m });
    Oscillator::new(case.eta, case.g, case.u_up, case.r_c, post_uplift).unwrap()
}

#[test]
fn every_case_is_met_within_its_tolerance() {
    let cases = cases();
    assert_eq!(cases.cases.len(), 33);
    for case in &cases.cases {
        let excitation = Excitation::new(case.dt, &cases.records[&case.record]).unwrap().scaled(case.scale).unwrap();
        let oscillator = oscillator(case);
        let got = respond(&oscillator, &excitation, FreeVibration::Seconds(case.t_free));
        let expected = &case.expected;
        assert_eq!(got.overturned, expected.collapsed, "{}", case.id);
        if case.n_impacts_comparable {
            assert_eq!((got.impacts, got.uplifts), (expected.n_impacts, expected.n_uplifts), "{}", case.id);
        }
        let Some(u_max) = expected.u_max else {
            assert_eq!(got.peak_displacement_m, f64::INFINITY, "{}", case.id);
            continue;
        };
        let error = (got.peak_displacement_m - u_max).abs() / u_max.max(f64::MIN_POSITIVE);
        println!("{}: error {error:.1e} of {:.1e} allowed", case.id, case.suggested_rel_tol);
        assert!(error <= case.suggested_rel_tol, "{}: {} against {u_max}", case.id, got.peak_displacement_m);

        let record_only = respond(&oscillator, &excitation, FreeVibration::None);
        let expected_record = expected.u_max_record_only.unwrap();
        let allowed = case.suggested_rel_tol * expected_record;
        assert!((record_only.peak_displacement_m - expected_record).abs() <= allowed, "{}", case.id);

        // where the whole motion is well conditioned its end and the time of the peak agree too
        if case.suggested_rel_tol == 1e-10 && case.n_impacts_comparable {
            let size = u_max.max(case.u_up);
            assert!((got.end_displacement_m - expected.u_end.unwrap()).abs() < 1e-6 * size, "{}: end", case.id);
            assert!((got.end_velocity_m_s - expected.v_end.unwrap()).abs() < 1e-5, "{}: end velocity", case.id);
            assert!((got.time_of_peak_s - expected.t_umax.unwrap()).abs() < 1e-6, "{}: time", case.id);
        }
    }
}

// Free motion followed for a long time holds the closed-form first free peak, and nothing larger.
#[test]
fn first_free_peak_in_closed_form_is_the_largest_of_the_free_motion() {
    let cases = cases();
    let mut free_peaks = 0;
    for case in &cases.cases {
        let excitation = Excitation::new(case.dt, &cases.records[&case.record]).unwrap().scaled(case.scale).unwrap();
        let oscillator = oscillator(case);
        let closed = respond(&oscillator, &excitation, FreeVibration::FirstPeak);
        let followed = respond(&oscillator, &excitation, FreeVibration::Seconds(60.0));
        assert_eq!(closed.overturned, followed.overturned, "{}", case.id);
        if closed.overturned {
            continue;
        }
        let error = (closed.peak_displacement_m - followed.peak_displacement_m).abs();
        assert!(error <= 1e-12 * closed.peak_displacement_m, "{}: {closed:?} {followed:?}", case.id);
        // without loss every later peak is as large as the first, and rounding chooses among them
        let same_time = (closed.time_of_peak_s - followed.time_of_peak_s).abs() < 1e-6;
        assert!(same_time || case.r_c == 1.0, "{}: {closed:?} {followed:?}", case.id);
        if closed.time_of_peak_s > excitation.duration_s() {
            free_peaks += 1;
        }
    }
    assert!(free_peaks >= 2, "the cases hold peaks in free motion, or this test shows nothing");
}
