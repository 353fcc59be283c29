//! `uplift response --block`: one record through one rigid block, beside what can be computed by hand.

use std::path::Path;

use crate::common::{Finished, uplift};

/// Half-diagonal of a block of 0.8 m by 4 m, m, and its tan α.
const SIZE_M: f64 = 2.039_607_805_437_114;
const TANGENT: f64 = 0.2;
const G_M_S2: f64 = 9.806_65;

/// A record that is `g` for `samples` intervals of 0.01 s, then zero for as many.
fn step(folder: &Path, g: f64, samples: usize) {
    let column: Vec<String> =
        (0..=2 * samples).map(|sample| if sample <= samples { g.to_string() } else { "0".to_owned() }).collect();
    std::fs::write(folder.join("step.txt"), column.join("\n")).unwrap();
}

fn block(folder: &Path, more: &[&str]) -> Finished {
    let arguments = ["response", "step.txt", "--unit", "g", "--dt-s", "0.01", "--block"];
    uplift(folder, &[&arguments[..], more].concat())
}

/// The rows of the history: time, rotation, velocity, displacement of the top, ground acceleration; the event.
fn history(folder: &Path) -> Vec<([f64; 5], String)> {
    let text = std::fs::read_to_string(folder.join("h.csv")).unwrap();
    let mut lines = text.lines();
    insta::assert_snapshot!(
        lines.next().unwrap(),
        @"time_s,rotation_rad,angular_velocity_rad_s,top_displacement_m,ground_acceleration_m_s2,event"
    );
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers: Vec<f64> = cells[..5].iter().map(|cell| cell.parse().unwrap()).collect();
        (<[f64; 5]>::try_from(numbers).unwrap(), cells[5].to_owned())
    };
    lines.map(row).collect()
}

#[test]
fn a_block_stays_below_g_tan_alpha_and_uplifts_above() {
    let folder = tempfile::tempdir().unwrap();
    step(folder.path(), -0.1, 50);
    let sides = ["--width-m", "0.8", "--height-m", "4"];
    let run = block(folder.path(), &[&sides[..], &["--scale", "1.99"]].concat()).ok();
    assert!(run.stdout.contains("never uplifts: the ground does not exceed 0.2000 g"), "{}", run.stdout);
    let below = block(folder.path(), &[&sides[..], &["--scale", "1.99", "--json"]].concat()).json();
    assert_eq!(below["peak_rotation_rad"], 0.0);
    assert!(below["time_of_uplift_s"].is_null() && below["time_of_peak_s"].is_null());
    let above = block(folder.path(), &[&sides[..], &["--scale", "2.01", "--json"]].concat()).json();
    assert_eq!(above["time_of_uplift_s"], 0.0);
    assert!(above["peak_rotation_rad"].as_f64().unwrap() > 0.0);
    // the same block by its other numbers
    let angle = TANGENT.atan().to_string();
    for numbers in [["--size-m", "2.039607805437114"], ["--height-m", "4"], ["--width-m", "0.8"]] {
        let more = ["--slenderness", &angle, "--scale", "2.01", "--json"];
        let same = block(folder.path(), &[&numbers[..], &more].concat()).json();
        for key in ["size_m", "peak_rotation_rad", "peak_displacement_m", "restitution"] {
            let [one, other] = [&same, &above].map(|response| response[key].as_f64().unwrap());
            assert!((one / other - 1.0).abs() < 1e-9, "{key}: {one} {other}");
        }
    }
}

/// While the ground accelerates by a constant −a, Eq. 2.1 integrates to
/// θ̇²/2 = p² [a/g (sin α − sin(α − θ)) + cos α − cos(α − θ)].
#[test]
fn the_motion_under_constant_acceleration_is_that_of_its_energy() {
    let folder = tempfile::tempdir().unwrap();
    step(folder.path(), -0.3, 20);
    let sides = ["--width-m", "0.8", "--height-m", "4", "--free-vibration-s", "4", "--history", "h.csv", "--json"];
    let response = block(folder.path(), &sides).json();
    let (alpha, p_squared) = (TANGENT.atan(), 0.75 * G_M_S2 / SIZE_M);
    assert!((response["frequency_parameter_rad_s"].as_f64().unwrap() / p_squared.sqrt() - 1.0).abs() < 1e-12);
    let rows = history(folder.path());
    let mut compared = 0;
    for ([time_s, rotation, velocity, top_m, ground], _) in &rows {
        let printed = 2.0 * SIZE_M * (alpha.sin() - (alpha - rotation).sin());
        if *rotation >= 0.0 {
            assert!((top_m - printed).abs() < 1e-12, "{top_m} {printed}");
        }
        if *time_s <= 0.2 {
            let energy = 0.3 * (alpha.sin() - (alpha - rotation).sin()) + alpha.cos() - (alpha - rotation).cos();
            assert!((velocity * velocity / 2.0 - p_squared * energy).abs() < 1e-12, "{time_s} s");
            assert!((ground + 0.3 * G_M_S2).abs() < 1e-12);
            compared += 1;
        }
    }
    assert!(compared > 20);
    // every impact takes Housner's share of the velocity (Eq. 2.3)
    let of = |word: &str| rows.iter().filter(|row| row.1 == word).map(|row| row.0[2]).collect::<Vec<f64>>();
    let (before, after) = (of("before impact"), of("after impact"));
    let housner = 1.0 - 1.5 * alpha.sin().powi(2);
    assert!(before.len() > 2 && before.len() == after.len());
    assert_eq!(response["impacts"], before.len());
    assert!(before.iter().zip(&after).all(|(before, after)| (after / before - housner).abs() < 1e-12));
    // another restitution is taken instead
    let elastic = block(folder.path(), &[&sides[..], &["--restitution", "0.5", "--force"]].concat()).json();
    assert_eq!((&elastic["restitution"], &elastic["restitution_is_housners"]), (&0.5.into(), &false.into()));
    assert!(elastic["impacts"] != response["impacts"]);
}

#[test]
fn an_overturned_block_is_said_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    step(folder.path(), -0.3, 300);
    let sides = ["--width-m", "0.8", "--height-m", "4", "--plot", "h.svg"];
    let run = block(folder.path(), &sides).ok();
    assert!(run.stdout.contains("overturned, after") && run.stdout.contains("(Housner)"), "{}", run.stdout);
    let response = block(folder.path(), &[&sides[..], &["--json"]].concat()).json();
    assert!(response["peak_rotation_rad"].is_null() && response["overturned"] == true);
    let svg = std::fs::read_to_string(folder.path().join("h.svg")).unwrap();
    assert!(svg.contains("rotation, rad") && svg.contains("slenderness"));
}

#[test]
fn mistakes_are_said() {
    let folder = tempfile::tempdir().unwrap();
    step(folder.path(), -0.3, 10);
    let fails = |more: &[&str], words: &[&str]| drop(block(folder.path(), more).fails(2, words));
    fails(&["--width-m", "0.8"], &["a block needs two numbers"]);
    fails(&["--width-m", "0.8", "--height-m", "4", "--size-m", "2"], &["a block needs two numbers"]);
    fails(&["--width-m", "800000000", "--height-m", "-1"], &["2 problems", "width_m is 8e8 m", "not in mm"]);
    fails(&["--size-m", "2", "--slenderness", "1.2"], &["slenderness alpha is 1.2 rad", "does not rock"]);
    fails(&["--width-m", "5", "--height-m", "2"], &["slenderness alpha is 1.19029 rad"]);
    fails(&["--size-m", "2", "--slenderness", "0.2", "--strength", "0.2"], &["--strength", "--block"]);
    fails(&["--size-m", "2", "--slenderness", "0.2", "--capacity-m", "0.2"], &["--capacity-m", "--block"]);
    uplift(folder.path(), &["response", "step.txt", "--width-m", "0.8"]).fails(2, &["--block"]);
}
