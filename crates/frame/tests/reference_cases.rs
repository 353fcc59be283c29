//! Independently computed cases, and whatever file of such cases `UPLIFT_FRAMES_CASES` names.

use cases::verdicts;

#[path = "../examples/frames_cases/cases.rs"]
mod cases;

fn check(text: &str, least: usize) {
    let verdicts = verdicts(text).unwrap();
    let mut compared = 0;
    for verdict in &verdicts {
        assert!(verdict.differences.is_empty(), "{}: {:#?}", verdict.id, verdict.differences);
        compared += verdict.compared;
    }
    println!("{} cases, {compared} numbers", verdicts.len());
    assert!(compared >= least, "only {compared} numbers were compared");
}

/// 12 columns and frames, 3 discs.
#[test]
fn every_case_of_the_project() {
    check(include_str!("data/statics_cases.json"), 800);
}

/// 12 planar and 12 wobbling frames, free and under pulses, computed with 113 bits.
#[test]
fn every_motion_without_records() {
    check(include_str!("data/motion_cases.json"), 300);
}

/// One frame that wobbles and one that falls, by another method (Radau).
#[test]
fn every_free_frame_of_another_source() {
    check(include_str!("data/free_wobbling_cases.json"), 8);
}

/// Four pairs of samples, with ties and collapses, by scipy 1.17.
#[test]
fn every_pair_of_samples() {
    check(include_str!("data/validation_cases.json"), 80);
}

#[test]
fn every_case_of_a_file_from_outside() {
    match std::env::var_os("UPLIFT_FRAMES_CASES") {
        Some(file) => check(&std::fs::read_to_string(file).unwrap(), 1),
        None => println!("skipped: no file of cases (set UPLIFT_FRAMES_CASES)"),
    }
}

/// The harness can fail: one number off by 1e-8, an unknown quantity, a restrainer that cannot be.
#[test]
fn a_wrong_number_is_found() {
    let text = include_str!("data/statics_cases.json");
    let mut file: serde_json::Value = serde_json::from_str(text).unwrap();
    let point = &mut file["statics"][2]["points"][3];
    point["tendon_n"] = (point["tendon_n"].as_f64().unwrap() * (1.0 + 1e-8)).into();
    file["statics"][3]["scalars"]["period_s"] = 1.0.into();
    file["statics"][4]["restrainer"] = serde_json::json!({"kind": "linear"});
    file["discs"][0]["points"][0]["force_n"] = 8373.6.into();
    let verdicts = verdicts(&file.to_string()).unwrap();
    let found: Vec<String> = verdicts.iter().flat_map(|verdict| &verdict.differences).cloned().collect();
    assert_eq!(found.len(), 4, "{found:#?}");
    assert!(found[0].starts_with("point 3 tendon_n: "), "{found:#?}");
    assert!(found[1].starts_with("period_s: not a quantity"), "{found:#?}");
    assert!(found[2].contains("`stiffness_n_m` is missing"), "{found:#?}");
    assert!(found[3].starts_with("point 0 force_n: 8373.58"), "{found:#?}");
}

/// Where the force crosses zero the tolerance is a share of the largest force of the case, 1e-9 of 1375 N.
#[test]
fn a_force_near_zero() {
    let differences = |at_neutral_n: f64| {
        let case = serde_json::json!({
            "id": "s", "half_width_m": 0.1, "half_height_m": 0.8, "top_load_n": 10e3, "column_weight_n": 2e3,
            "columns": 1, "restrainer": {"kind": "none"},
            "points": [{"u_m": 0.0, "force_n": 1375.0}, {"u_m": 0.2, "force_n": at_neutral_n}],
        });
        verdicts(&serde_json::json!({ "statics": [case] }).to_string()).unwrap()[0].differences.clone()
    };
    assert!(differences(1e-7).is_empty(), "{:?}", differences(1e-7));
    assert_eq!(differences(1e-5).len(), 1);
}

/// `contact_flats` says what the reduced thickness beside it says, and nothing else.
#[test]
fn contact_flats_of_a_case() {
    let differences = |more: serde_json::Value| {
        let mut restrainer = serde_json::json!({
            "kind": "disc-springs", "outer_diameter_m": 0.2, "inner_diameter_m": 0.092, "thickness_m": 0.01,
            "cone_height_m": 0.0056, "springs": 11, "tendon_stiffness_n_m": 12_117e3,
        });
        restrainer.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        let case = serde_json::json!({
            "id": "s", "half_width_m": 0.1289, "half_height_m": 0.725, "top_load_n": 52.2e3, "column_weight_n": 1890.0,
            "columns": 1, "restrainer": restrainer, "points": [{"u_m": 0.0, "drift": 0.0}],
        });
        verdicts(&serde_json::json!({ "statics": [case] }).to_string()).unwrap()[0].differences.join("; ")
    };
    let given = differences(serde_json::json!({"contact_flats": true, "reduced_thickness_m": 0.0095}));
    assert_eq!(given, "");
    assert_eq!(differences(serde_json::json!({"contact_flats": false})), "");
    assert!(differences(serde_json::json!({"contact_flats": true})).contains("give reduced_thickness_m"));
    let both = differences(serde_json::json!({"contact_flats": false, "reduced_thickness_m": 0.0095}));
    assert!(both.contains("contact_flats is false"), "{both}");
}
