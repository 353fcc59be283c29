//! `uplift pulse`: rocking spectra under wavelets, against the block asked directly and against what the dissertation
//! says of them.

use std::collections::HashMap;
use std::path::Path;

use serde_json::Value;
use uplift_block::{
    FreeRocking, Overturning, PulseSpectrumPlan, RickerPulse, RickerShape, RockingBlock, SizeMeasure, pulse_spectrum,
    respond,
};

use crate::common::{rows, uplift};

const SMALL: [&str; 12] = [
    "--frequencies",
    "2,4:2:8",
    "--accelerations",
    "0.5,1:3/2:7",
    "--half-widths",
    "1:1:5",
    "--frequency-lines",
    "3,6",
    "--acceleration-lines",
    "2,5",
    "--sizes-m",
    "1:2:9",
];
const FIGURES: [&str; 6] =
    ["rotation", "displacement", "over-acceleration", "over-frequency", "over-size", "by-half-width"];

fn small<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ["pulse", "-q"].into_iter().chain(SMALL).chain(more.iter().copied()).collect()
}

fn shape(row: &HashMap<String, String>) -> RickerShape {
    match row["wavelet"].as_str() {
        "symmetric" => RickerShape::Symmetric,
        "antisymmetric" => RickerShape::Antisymmetric,
        other => panic!("{other}"),
    }
}

fn number(row: &HashMap<String, String>, name: &str) -> f64 {
    row[name].parse().unwrap()
}

fn word(overturning: Overturning) -> &'static str {
    match overturning {
        Overturning::None => "none",
        Overturning::WithoutImpact => "without impact",
        Overturning::AfterImpact => "after impact",
    }
}

#[test]
fn tables_hold_what_the_block_does() {
    let folder = tempfile::tempdir().unwrap();
    uplift(folder.path(), &small(&["-o", "out", "--slenderness", "0.2", "--restitution", "0.9"])).ok();
    let tables = [
        ("rotation", "omega_p_over_p", "theta_max_over_alpha", 2 * 4 * 6),
        ("displacement", "omega_p_over_p", "u_max_omega_p2_over_a_p", 2 * 4 * 6),
        ("over-acceleration", "omega_p_over_p", "u_max_omega_p2_over_a_p", 2 * 2 * 6),
        ("over-frequency", "omega_p_over_p", "u_max_omega_p2_over_a_p", 2 * 4 * 2),
        ("by-half-width", "b_omega_p2_over_a_p", "u_max_omega_p2_over_a_p", 2 * 5 * 6),
    ];
    for (name, size_name, value_name, count) in tables {
        let rows = rows(&folder.path().join(format!("out/{name}.csv")));
        assert_eq!(rows.len(), count, "{name}");
        let (mut overturned, mut rocking) = (0, 0);
        for row in rows {
            let acceleration = number(&row, "a_p_over_g_tan_alpha");
            let plan = PulseSpectrumPlan {
                shape: shape(&row),
                slenderness_rad: 0.2,
                restitution: Some(0.9),
                size_measure: if name == "by-half-width" { SizeMeasure::HalfWidth } else { SizeMeasure::Frequency },
                sizes: vec![number(&row, size_name)],
                accelerations: vec![acceleration],
            };
            let point = pulse_spectrum(&plan).unwrap().points()[0];
            let expected = if name == "rotation" { point.rotation } else { point.displacement };
            assert_eq!(number(&row, value_name), expected, "{name} {row:?}");
            assert_eq!(
                (row["overturning"].as_str(), row["impacts"].parse()),
                (word(point.overturning), Ok(point.impacts))
            );
            // nothing moves before the ground is as strong as the block
            assert!(acceleration >= 1.0 || expected == 0.0, "{name} {row:?}");
            overturned += usize::from(expected == f64::INFINITY);
            rocking += usize::from(expected > 0.0 && expected.is_finite());
        }
        assert!(rocking > 0, "{name}");
        println!("{name}: {overturned} of {count} overturn");
    }
}

#[test]
fn blocks_with_a_size_take_their_own_wavelet() {
    let folder = tempfile::tempdir().unwrap();
    let run = |more: &[&str]| {
        uplift(folder.path(), &small(&[&["-o", "out", "--slendernesses", "0.1,0.3"], more].concat())).ok();
        rows(&folder.path().join("out/over-size.csv"))
    };
    for (rows, amplitude_g, periods_s) in
        [(run(&[]), 1.0, [0.5, 1.0]), (run(&["--amplitude-g", "0.6", "--period-s", "0.8"]), 0.6, [0.8, 0.8])]
    {
        assert_eq!(rows.len(), 2 * 2 * 5);
        for row in rows {
            let period_s = periods_s[usize::from(shape(&row) == RickerShape::Antisymmetric)];
            let block = RockingBlock::new(number(&row, "size_r_m"), number(&row, "alpha_rad")).unwrap();
            let pulse = RickerPulse::new(shape(&row), amplitude_g * 9.806_65, period_s).unwrap();
            let expected = respond(&block, pulse, FreeRocking::FirstPeak).unwrap();
            assert_eq!(number(&row, "u_max_m"), expected.displacement_m, "{row:?}");
            assert_eq!(row["overturning"], word(expected.overturning), "{row:?}");
        }
    }
}

#[test]
fn the_summary_and_the_figures() {
    let folder = tempfile::tempdir().unwrap();
    let run = uplift(folder.path(), &small(&["-o", "out", "--json"])).ok();
    let summary: Value = serde_json::from_str(&run.stdout).unwrap();
    let files = summary["files"].as_array().unwrap();
    for name in FIGURES {
        for extension in ["svg", "csv"] {
            let file = Path::new("out").join(format!("{name}.{extension}"));
            assert!(files.iter().any(|known| Path::new(known.as_str().unwrap()) == file), "{name}.{extension}");
            assert!(folder.path().join(&file).is_file());
        }
        let svg = std::fs::read_to_string(folder.path().join(format!("out/{name}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && !svg.contains("NaN") && !svg.contains("inf"), "{name}");
        assert!(svg.contains("symmetric") && svg.contains("antisymmetric"), "{name}");
        let is_map = ["rotation", "displacement", "by-half-width"].contains(&name);
        assert_eq!(svg.contains("overturns without impact"), is_map, "{name}");
    }
    let rotation = rows(&folder.path().join("out/rotation.csv"));
    for of in summary["wavelets"].as_array().unwrap() {
        let own: Vec<_> = rotation.iter().filter(|row| row["wavelet"] == of["wavelet"].as_str().unwrap()).collect();
        let count = |word: &str| own.iter().filter(|row| row["overturning"] == word).count();
        assert_eq!(of["points"], own.len());
        assert_eq!(of["overturned_without_impact"], count("without impact"));
        assert_eq!(of["overturned_after_impact"], count("after impact"));
        let overturned = own.iter().filter(|row| row["overturning"] != "none");
        let smallest = overturned.map(|row| number(row, "a_p_over_g_tan_alpha")).fold(f64::INFINITY, f64::min);
        assert_eq!(of["smallest_overturning_acceleration"].as_f64(), Some(smallest));
    }

    uplift(folder.path(), &small(&["-o", "one", "--shape", "antisymmetric", "--format", "svg"])).ok();
    let one = std::fs::read_to_string(folder.path().join("one/rotation.svg")).unwrap();
    assert!(one.contains("antisymmetric") && !one.contains(">\nsymmetric"), "one wavelet alone");
}

/// Section 2.3.2: a base 2b of "roughly nine times" aₚ/ωₚ² is enough, whatever the strength; here to a step of 0.04.
#[test]
fn a_base_of_roughly_nine_length_scales_is_enough() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "pulse",
        "-q",
        "--json",
        "--half-widths",
        "4.4:0.02:5",
        "--accelerations",
        "1.5:0.1:8",
        "--frequencies",
        "1,2",
        "--sizes-m",
        "1,2",
    ];
    let run = uplift(folder.path(), &arguments).ok();
    let summary: Value = serde_json::from_str(&run.stdout).unwrap();
    for of in summary["wavelets"].as_array().unwrap() {
        let base = of["largest_overturning_base"].as_f64().unwrap();
        println!("{}: up to a base of {base}", of["wavelet"]);
        assert!((9.0..9.5).contains(&base) && of["larger_bases_may_overturn"] == false, "{of}");
    }
}

#[test]
fn mistakes_are_reported_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, words) in [
        (&["--frequencies", "0:1:5"][..], &["--frequencies", "above zero"][..]),
        (&["--frequencies", "3"], &["at least two values"]),
        (&["--accelerations", "1:0.3:2"], &["--accelerations", "misses its stop", "whole number of steps"]),
        (&["--half-widths", "2,1"], &["1 follows 2", "must increase"]),
        (&["--sizes-m", "x"], &["--sizes-m", "\"x\" is not a number"]),
        (&["--frequency-lines", "1:1:20"], &["20 lines", "at most 7"]),
        (&["--frequencies", "0.001:0.001:10", "--accelerations", "0.001:0.001:10"], &["100,000,000 points"]),
        (&["--slenderness", "1.2"], &["slenderness alpha is 1.2 rad"]),
        (&["--restitution", "-1"], &["restitution r is -1"]),
        (&["--amplitude-g", "nan", "--period-s", "0"], &["2 problems", "amplitude is NaN g", "period is 0 s"]),
        (&["--period-s", "0"], &["period is 0 s", "from 1e-4 to 10000 s"]),
    ] {
        uplift(folder.path(), &[&["pulse"], arguments].concat()).fails(2, words);
    }
    assert!(!folder.path().join("results").exists(), "nothing is left behind");
    let at_rest =
        ["-o", "still", "--slendernesses", "0.1:0.1:0.3", "--amplitude-g", "0.25", "--acceleration-lines", "0.5,1,2"];
    let arguments: Vec<&str> = ["pulse"].into_iter().chain(SMALL[..8].iter().copied()).chain(at_rest).collect();
    let said = uplift(folder.path(), &arguments).ok().stderr;
    assert!(said.contains("note: 0.25 g does not uplift blocks of slenderness 0.3\n"), "{said}");
    assert!(said.contains("note: acceleration lines at 0.5, 1 g tan alpha do not uplift the block\n"), "{said}");
    assert!(!said.contains("accelerations up to"), "{said}");
    let faint = ["pulse", "-o", "faint", "--frequencies", "1,2", "--half-widths", "1,2", "--accelerations", "0.5,1"];
    let said = uplift(folder.path(), &faint).ok().stderr;
    assert!(said.contains("note: accelerations up to 1 g tan alpha do not uplift the block\n"), "{said}");
    std::fs::write(folder.path().join("taken"), "").unwrap();
    uplift(folder.path(), &small(&["-o", "taken"])).fails(4, &["taken"]);
}
