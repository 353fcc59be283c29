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
