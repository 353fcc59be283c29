//! Displacement spectra of record sets from end to end: the arrays against the solvers called one by one, sets, tables,
//! refusals.

mod single_runs;

use std::path::Path;
use std::process::Command;

use uplift_labelled::{LabelledArray, LabelledReader};

use crate::common::{EARLIER, SmallStudy, python, real_records, repository, uplift};

/// Small oscillators and slender blocks: the synthetic motions are gentle.
const OSCILLATORS: &str = r#"kind = "displacement spectra"
title = "few"
[records.synthetic]
pairs = 3
[scaling]
to = ["unscaled", "2 PGA", "4 PGV"]
[spectrum]
percentiles = [50, 90]
[oscillator]
uplift_displacement_m = [0.0005, 0.005]
capacity_m = [0.02, inf]
[strengths]
values = [0, 0.02, "0.1:0.1:0.3"]
[design]
width_m = 0.1
height_m = 1
noise_points = 3
"#;
const BLOCKS: &str = r#"kind = "displacement spectra"
[records.synthetic]
pairs = 2
[scaling]
to = ["1 PGV", "unscaled"]
by = "record"
[spectrum]
percentiles = [50, 100]
[block]
height_m = [0.5, 1000]
[slenderness]
values = [0.02, "0.05:0.05:0.3"]
[design]
height_m = 2
noise_points = 3
"#;

fn read(study: &SmallStudy, name: &str) -> LabelledReader {
    LabelledReader::open(&study.path().join(name)).unwrap()
}

fn array(reader: &LabelledReader, path: &str) -> LabelledArray<f64> {
    reader.array::<f64>(path).unwrap()
}

fn close(a: f64, b: f64, relative: f64) -> bool {
    a == b || (a - b).abs() <= relative * b.abs()
}

/// All that does not tell of the run itself.
fn content(path: &Path) -> Vec<(String, Vec<u64>)> {
    let reader = LabelledReader::open(path).unwrap();
    let mut found = Vec::new();
    for group in ["/spectra", "/sets/synthetic", "/design"] {
        for name in reader.children(group).unwrap() {
            if let Ok(array) = reader.array::<f64>(&format!("{group}/{name}")) {
                found.push((name, array.values.iter().map(|value| value.to_bits()).collect()));
            }
        }
    }
    found
}

#[test]
#[ignore = "long: make test-long"]
fn the_same_bits_on_any_number_of_threads_and_from_the_stored_study() {
    for (text, arrays) in [(OSCILLATORS, 24), (BLOCKS, 23)] {
        let study = SmallStudy::with(text);
        study.uplift(&["run", "study.toml", "-o", "one.h5", "-q", "--threads", "1"]).ok();
        study.uplift(&["run", "study.toml", "-o", "three.h5", "-q", "--threads", "3"]).ok();
        let one = content(&study.path().join("one.h5"));
        assert_eq!(one.len(), arrays);
        assert_eq!(one, content(&study.path().join("three.h5")));
        let reader = read(&study, "one.h5");
        assert_eq!(reader.attribute::<String>("/", "kind").unwrap(), "displacement spectra");
        let elsewhere = tempfile::tempdir().unwrap();
        std::fs::write(elsewhere.path().join("again.toml"), reader.attribute::<String>("/", "study_toml").unwrap())
            .unwrap();
        uplift(elsewhere.path(), &["run", "again.toml", "-o", "again.h5", "-q"]).ok();
        assert_eq!(one, content(&elsewhere.path().join("again.h5")));
    }
}

/// What the text says of the design: Eq. 3.15 for each rule, and the error as it is defined.
#[test]
#[ignore = "long: make test-long"]
fn design_values_hang_together() {
    let study = SmallStudy::with(OSCILLATORS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--set", "design.width_m=0.001"]).ok();
    let reader = read(&study, "r.h5");
    assert!(close(reader.attribute::<f64>("/design", "strength").unwrap(), 0.001_f64.tan(), 1e-15));
    let of = |name: &str| array(&reader, &format!("/design/{name}")).values;
    let (zero, cap, exact, rule, error) =
        (of("u_dem_zs_m"), of("u_cap_m"), of("u_dem_th_m"), of("u_dem_rule_m"), of("error"));
    // [record_set, scaling, scaled_by, rule, bound]
    assert_eq!(zero.len(), 3 * 2 * 2 * 3);
    for (place, _) in zero.iter().enumerate().step_by(3) {
        let equal_energy = place / 3 % 2 == 1;
        let energy = |z: f64, c: f64| c - ((c - 0.0005) * (c - 2.0 * z + 0.0005)).sqrt();
        let expected = if equal_energy { energy(zero[place], cap[place]) } else { zero[place] };
        assert!(close(rule[place], expected, 1e-9), "{place}: {} {expected}", rule[place]);
        assert!(close(cap[place], 2.5 * rule[place], 1e-9), "{place}");
        if exact[place].is_finite() {
            assert!(close(error[place], rule[place] / exact[place] - 1.0, 1e-9), "{place}");
        }
        for values in [&zero, &cap, &exact, &rule] {
            let [value, lowest, highest] = values[place..place + 3] else { panic!() };
            assert!(lowest <= value && value <= highest);
        }
    }
    // the endless spectrum at the design slenderness of a block is what a spectrum through that point says
    let study = SmallStudy::with(BLOCKS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let design = array(&read(&study, "r.h5"), "/design/tan_alpha");
    let tangent = design.values[0];
    let set = format!("slenderness.values=[{}, {tangent}]", tangent / 2.5);
    study.uplift(&["run", "study.toml", "-o", "s.h5", "-q", "--set", &set, "--set", "block.height_m=[2, 1000]"]).ok();
    let (first, second) = (read(&study, "r.h5"), read(&study, "s.h5"));
    let spectra = array(&second, "/spectra/u_m");
    // [record_set, scaling, scaled_by, height, percentile, slenderness]
    assert_eq!(spectra.shape, [1, 2, 1, 2, 2, 2]);
    assert_eq!(array(&first, "/design/u_block_m").values[0].to_bits(), spectra.values[1].to_bits());
    assert_eq!(array(&first, "/design/u_endless_m").values[0].to_bits(), spectra.values[5].to_bits());
    // there the demand meets the capacity line u = 2H tan(alpha)
    assert!(close(spectra.values[4], 2.0 * tangent / 2.5, 0.3), "{} {}", spectra.values[4], 2.0 * tangent / 2.5);
}

/// Five records in a manifest with tags.
fn with_manifest() -> SmallStudy {
    let study = SmallStudy::with(&format!(
        "{OSCILLATORS}[records]\nmanifest = \"manifest.csv\"\n{}",
        r#"[[record_sets]]
name = "first"
tag = "a"
[[record_sets]]
name = "Second set!"
tag = "b"
leave_out = [3]
"#
    ));
    let text = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    study.write("study.toml", &text.replace("[records.synthetic]\npairs = 3\n", ""));
    study.uplift(&["records", "synthesize", "-o", "downloads", "--count", "5"]).ok();
    let row = |(index, tags): (usize, &str)| {
        let number = index + 1;
        format!("R{number},{number},{tags},downloads/SYN00{number}_H1.AT2,downloads/SYN00{number}_H2.AT2")
    };
    let rows: Vec<String> = ["a", "a;b", "b", "b", "other"].into_iter().enumerate().map(row).collect();
    study.write("manifest.csv", &format!("record_id,rsn,set_tags,file_h1,file_h2\n{}\n", rows.join("\n")));
    study
}

#[test]
#[ignore = "long: make test-long"]
fn sets_are_made_by_tags_and_records_left_out() {
    let study = with_manifest();
    let check = study.uplift(&["check", "study.toml", "--json"]).json();
    assert_eq!(check["sets"][0]["name"], "first");
    assert_eq!((&check["sets"][0]["records"], &check["sets"][1]["motions"]), (&2.into(), &4.into()));
    // 5 ways of scaling x 20 oscillators x 8 motions
    assert_eq!(check["analyses"], 800);
    assert!(check["seconds"].as_f64().unwrap() > 0.0);
    let plan = study.uplift(&["check", "study.toml", "--details"]).ok().stdout;
    let completed = study.uplift(&["check", "study.toml", "--print-study"]).ok().stdout;
    assert!(completed.contains("[[record_sets]]"), "{completed}");
    for words in ["Second set!: 2 records, 4 motions", "800", "can be run"] {
        assert!(plan.contains(words), "{words}:\n{plan}");
    }

    let run = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let heading = "Displacement spectra, median of the motions of each set, ";
    for words in ["r.h5", "r.displacements.csv", "r.design.csv", "uplift table r.h5", heading] {
        assert!(run.stdout.contains(words), "{words}:\n{}", run.stdout);
    }
    let reader = read(&study, "r.h5");
    assert_eq!(reader.axis::<String>("record_set").unwrap(), ["first", "Second set!"]);
    assert_eq!(reader.axis::<String>("motion_second_set_").unwrap(), ["R2 h1", "R2 h2", "R4 h1", "R4 h2"]);
    assert_eq!(reader.array::<String>("/sets/first/record").unwrap().values, ["R1", "R1", "R2", "R2"]);
    // a record in both sets has the same displacements in both, unscaled
    let (first, second) = (array(&reader, "/sets/first/u_m"), array(&reader, "/sets/Second set!/u_m"));
    assert_eq!(first.values[2..4], second.values[0..2]);
    let checksums = reader.attribute::<String>("/", "input_checksums").unwrap();
    assert!(
        checksums.contains("record R4 h2") && !checksums.contains("R3") && !checksums.contains("R5"),
        "{checksums}"
    );
    // the table has every line once, unscaled ones too
    let csv = std::fs::read_to_string(study.path().join("r.displacements.csv")).unwrap();
    let mut lines = csv.lines();
    insta::assert_snapshot!(
        lines.next().unwrap(),
        @"record_set,scaling,scaled_by,uplift_displacement_m,capacity_m,strength,u50_m,u90_m,overturned,u50_rounding_lowest_m,u50_rounding_highest_m,u90_rounding_lowest_m,u90_rounding_highest_m"
    );
    assert_eq!(lines.count(), 2 * 5 * 20);

    // the first of each set; a set that nothing is left of; a tag and a record that are not there
    let first = study.uplift(&["check", "study.toml", "--json", "--set", "records.first=1"]).ok();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&first.stdout).unwrap()["analyses"], 400);
    study
        .uplift(&["run", "study.toml", "--set", "record_sets.first.leave_out=[\"R1\", \"RSN2\"]"])
        .fails(4, &["record set \"first\" has no record"]);
    study
        .uplift(&["check", "study.toml", "--set", "record_sets.first.tag=c"])
        .fails(4, &["no record with the tag \"c\"", "a, b, other"]);
    let check = study.uplift(&["check", "study.toml", "--set", "record_sets.first.leave_out=[\"R5\"]"]).ok();
    assert!(check.stdout.contains("R5, which is left out, is not in it"), "{}", check.stdout);
}

#[test]
fn the_tree_of_a_result() {
    for (name, text) in [("oscillators", OSCILLATORS), ("blocks", BLOCKS)] {
        let study = SmallStudy::with(text);
        study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
        let reader = read(&study, "r.h5");
        let lines: Vec<String> = ["/", "/axes", "/spectra", "/sets/synthetic", "/design"]
            .into_iter()
            .map(|group| format!("{group}: {}", reader.children(group).unwrap().join(" ")))
            .collect();
        insta::assert_snapshot!(name, lines.join("\n"));
        let status = study.uplift(&["status", "r.h5"]).ok().stdout;
        assert!(status.contains("displacement spectra") && status.contains("uplift table"), "{status}");
        assert_eq!(study.uplift(&["status", "study.toml", "-q"]).code, 4, "its own result is not there");
        assert!(study.uplift(&["verify", "r.h5"]).ok().stdout.contains("every byte"));
    }
}

#[test]
fn tables_stand_beside_a_reference() {
    let study = SmallStudy::with(OSCILLATORS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let rows = |arguments: &[&str]| -> Vec<serde_json::Value> {
        let table = study.uplift(&[&["table", "r.h5", "--json"], arguments].concat()).ok();
        let table: serde_json::Value = serde_json::from_str(&table.stdout).unwrap();
        table["rows"].as_array().unwrap().clone()
    };
    let own = rows(&[]);
    // 2 rules x 4 quantities x 3 scalings x by
    assert_eq!(own.len(), 2 * 4 * 3 * 2);
    let pick = |rows: &[serde_json::Value], by: &str| -> serde_json::Value {
        let row = rows.iter().find(|row| {
            row["rule"] == "EE"
                && row["quantity"] == "u_dem_TH_m"
                && row["scaling"] == "2 PGA"
                && row["scaled_by"] == by
        });
        row.unwrap().clone()
    };
    let lowest = pick(&own, "component")["lowest"].as_f64().unwrap();
    // as tests/reference writes it: a scaling without a blank, a number that is rounded to a tenth of a millimetre,
    // below the range or at it
    for (value, within) in [(lowest - 0.00004, true), (lowest - 0.00011, false)] {
        let text = format!("rule,record_set,scaling,quantity,value\nEE,Synthetic,2.0PGA,u_dem_TH_m,{value:.4}\n");
        study.write("reference.csv", &text);
        let row = pick(&rows(&["--reference", "reference.csv"]), "component");
        assert_eq!(row["within"], within, "{row} {value}");
    }
    let table = study.uplift(&["table", "r.h5", "--reference", "reference.csv"]).ok().stdout;
    for words in ["synthetic, equal energy rule, FS = 2.5", "by component", "by record", "| reference", "3 points"] {
        assert!(table.contains(words), "{words}:\n{table}");
    }
    let other = study.write("other.csv", "record_set,scaling,quantity,value\nfar-field,1PGA,u_cap_m,1\n");
    let table = study.uplift(&["table", "r.h5", "--reference", other.to_str().unwrap()]).ok();
    assert!(table.stderr.contains("it has the sets far-field, the result synthetic"), "{}", table.stderr);
    study.write("bad.csv", "record_set,scaling,quantity,value\nx,1PGD,u_cap_m,1\n");
    study.uplift(&["table", "r.h5", "--reference", "bad.csv"]).fails(4, &["row 1", "1PGD", "0.5PGA"]);
    study.write("bad.csv", "record_set,scaling\nx,1PGA\n");
    study.uplift(&["table", "r.h5", "--reference", "bad.csv"]).fails(4, &["no column quantity, value"]);

    // blocks, and a slenderness that is not found
    let study = SmallStudy::with(BLOCKS);
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5", "--set", "slenderness.values=[0.25, 0.3]"]).ok();
    assert_eq!(run.code, 0);
    let warnings = study.uplift(&["warnings", "r.h5"]).ok().stdout;
    assert!(warnings.contains("meets the capacity line"), "{warnings}");
    assert!(study.uplift(&["table", "r.h5"]).ok().stdout.contains("none"));
    // and no design at all
    let text = BLOCKS.split("[design]").next().unwrap();
    study.write("study.toml", text);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--force"]).ok();
    study.uplift(&["table", "r.h5"]).fails(4, &["no design example", "[design]"]);
}

#[test]
fn each_kind_is_refused_where_the_other_is_wanted() {
    let study = SmallStudy::with(BLOCKS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    for command in
        [&["bootstrap", "r.h5"][..], &["influence", "r.h5"], &["measures", "r.h5"], &["export", "r.h5", "--csv"]]
    {
        study.uplift(command).fails(4, &["displacement spectra", "uplift table"]);
    }
    study.uplift(&["bootstrap", "study.toml"]).fails(3, &["kind", "of displacement spectra"]);
    study.uplift(&["plot", "study.toml"]).fails(3, &["kind", "`plot` and `report` on its result"]);
    // a result of the other kind is overwritten like that of any other study
    let risk = SmallStudy::new();
    risk.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    risk.write("other.toml", BLOCKS);
    risk.uplift(&["run", "other.toml", "-o", "r.h5", "-q"]).fails(2, &["another study (study.toml)", "--force"]);
    risk.uplift(&["run", "other.toml", "-o", "r.h5", "-q", "--force"]).ok();
    risk.uplift(&["table", "r.h5"]).ok();
    risk.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--force"]).ok();
    assert!(risk.uplift(&["table", "r.h5"]).ok().stdout.contains("c0"));
}

// Ctrl-C ends a long run soon, with its own exit code, and leaves the earlier result alone.
#[cfg(unix)]
#[test]
#[ignore = "long: make test-long"]
fn interruption_keeps_the_earlier_result() {
    let study = SmallStudy::with(OSCILLATORS);
    study.write_bytes("r.h5", EARLIER);
    let long = ["run", "study.toml", "-o", "r.h5", "--set", "strengths.values=0:1/99999:1"];
    let mut run = study.start(&long);
    run.wait_until_said("analyses");
    run.interrupt();
    run.end().fails(5, &["interrupted: ", "are in the checkpoint", "r.h5.part"]);
    assert_eq!(std::fs::read(study.path().join("r.h5")).unwrap(), EARLIER);
}

#[test]
#[ignore = "long: make test-long"]
fn python_finds_the_percentiles_of_the_displacements() {
    let Some(python) = python() else { return };
    for text in [OSCILLATORS, BLOCKS] {
        let study = SmallStudy::with(text);
        study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
        let script = repository().join("tests/python/read_displacements.py");
        let output = Command::new(&python).arg(script).arg(study.path().join("r.h5")).output().unwrap();
        let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success(), "{stdout}\n{stderr}");
    }
}

/// The sets of FEMA P695 as Chapter 3 uses them: their sizes, and its medians within the noise of ours more often than
/// not.
#[test]
#[ignore = "long: make test-long"]
fn the_sets_of_the_dissertation() {
    let Some(records) = real_records() else { return };
    let study = SmallStudy::new();
    let config = repository().join("configs/chapter-3.toml");
    let set = format!("records.manifest={}", records.join("manifest.csv").display());
    let small =
        ["scaling.to=[\"1 PGA\", \"1 PGV\"]", "strengths.values=0.2", "oscillator.uplift_displacement_m=0.0005"];
    let mut run = vec!["run", config.to_str().unwrap(), "-o", "r.h5", "-q", "--json", "--set", &set];
    run.extend(small.iter().flat_map(|small| ["--set", small]));
    let summary = study.uplift(&run).json();
    let sets: Vec<u64> = (0..3).map(|set| summary["sets"][set]["records"].as_u64().unwrap()).collect();
    assert_eq!(sets, [14, 14, 21]);
    let reference = repository().join("tests/reference/tables_3_2_to_3_7.csv");
    let table = study.uplift(&["table", "r.h5", "--json", "--reference", reference.to_str().unwrap()]).ok();
    let table: serde_json::Value = serde_json::from_str(&table.stdout).unwrap();
    let rows = table["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 3 * 2 * 4 * 2 * 2);
    assert!(rows.iter().all(|row| row["reference"].is_f64()));
    for by in ["component", "record"] {
        let of: Vec<_> = rows.iter().filter(|row| row["scaled_by"] == by).collect();
        let within = of.iter().filter(|row| row["within"] == true).count();
        println!("by {by}: {within} of {} printed values within our noise", of.len());
        assert!(3 * within > 2 * of.len(), "{within} of {} by {by}", of.len());
    }
}
