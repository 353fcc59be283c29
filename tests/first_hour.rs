//! What a newcomer types first, and types wrong.

use crate::common::{SmallStudy, repository};

fn study() -> SmallStudy {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

#[test]
fn a_decimal_comma_is_named() {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "-o", "set", "--count", "1", "-q"]).ok();
    let record = "set/SYN001_H1.AT2";
    for (command, words) in [
        (&["response", record, "--strength", "0,2"][..], "write 0.2"),
        (&["response", record, "--strength", "0.2", "--scale", "1,5"], "write 1.5"),
        (&["pulse", "--restitution", "0,9", "-o", "p"], "write 0.9"),
        (&["table", "r.h5", "--years", "50,5"], "write 50.5"),
        (&["response", record, "--strength", "a fifth"], "write a number, 0.2 or 2e-4"),
    ] {
        study.uplift(command).fails(2, &[words]);
    }
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["table", "r.h5", "--poe", "0,02"]).fails(2, &["--poe 0:", "the decimal mark is a point"]);
}

#[test]
fn a_study_in_place_of_a_result_is_named_as_one() {
    let study = study();
    for command in ["report", "table", "export"] {
        let format = if command == "export" { &["--json"][..] } else { &[] };
        let said = study.uplift(&[&[command, "study.toml"], format].concat());
        said.fails(4, &["study.toml: is a study, not a result: run `uplift run study.toml` first, and give "]);
    }
}

#[test]
fn samples_far_larger_than_the_set_are_refused() {
    let study = study();
    let words = ["--sizes: 1000 samples of 100000 records from a set of 4", "the largest size is 1000"];
    study.uplift(&["bootstrap", "r.h5", "--sizes", "2,100000"]).fails(2, &words);
    study.uplift(&["bootstrap", "r.h5", "--sizes", "400", "--replicates", "3", "-q"]).ok();
}

#[test]
fn the_result_of_a_changed_study_is_not_recomputed_unasked() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-q", "--set", "records.first=3"]).ok();
    let before = std::fs::read(study.path().join("results/study.h5")).unwrap();
    let refused = study.uplift(&["bootstrap", "study.toml", "--replicates", "20", "--sizes", "2"]);
    assert!(!refused.stderr.contains("computing "), "{}", refused.stderr);
    refused.fails(2, &["with --set records.first=3", "give", "in place of the study file", "--force"]);
    assert_eq!(std::fs::read(study.path().join("results/study.h5")).unwrap(), before);
    let same = ["bootstrap", "study.toml", "--replicates", "20", "--sizes", "2", "-q", "--set", "records.first=3"];
    study.uplift(&same).ok();
}

// The line of the README that writes a curve, as a shell would.
#[test]
fn the_curve_of_the_readme_says_what_it_is() {
    let study = SmallStudy::new();
    let readme = std::fs::read_to_string(repository().join("README.md")).unwrap();
    let line = readme.lines().find(|line| line.starts_with("printf") && line.ends_with("> pgv.csv")).unwrap();
    study.write("pgv.csv", &line.split('\'').nth(1).unwrap().replace("\\n", "\n"));
    let shown = study.uplift(&["hazard", "show", "pgv.csv"]).ok().stdout;
    assert!(shown.contains("PGV [cm/s]") && shown.contains("5 levels, read as annual rates, source:"), "{shown}");
    study.write("poe.csv", "PGV cm/s,probability of exceedance in 50 years\n1,0.9\n10,0.2\n100,0.001\n");
    let shown = study.uplift(&["hazard", "show", "poe.csv"]).ok().stdout;
    assert!(shown.contains("3 levels, read as probabilities of exceedance in 50 years, source:"), "{shown}");
    study.write("unsaid.csv", "iml,maf\n1,0.4\n10,0.01\n");
    study
        .uplift(&["hazard", "show", "unsaid.csv"])
        .fails(4, &["unsaid.csv", "pgv_cm_s", "or give the measure (--measure"]);
}

#[test]
fn an_import_names_the_option_for_the_unit() {
    let study = SmallStudy::new();
    std::fs::create_dir(study.path().join("downloads")).unwrap();
    let samples: Vec<String> = (0..200).map(|i| format!("{:.3} 0.01\n", 0.01 * f64::from(i))).collect();
    for name in ["downloads/a_H1.txt", "downloads/a_H2.txt"] {
        study.write(name, &samples.concat());
    }
    let said = study.uplift(&["records", "import", "downloads", "-o", "m.csv"]).stderr;
    assert!(said.contains("does not say its unit") && said.contains("--unit"), "{said}");
    // where the unit is not known, the values are to be converted
    let import = ["records", "import", "downloads", "-o", "m.csv", "--unit"];
    study
        .write("downloads/a_H1.txt", &format!("accel in mg\n# dt = 0.01 s\n{}", samples.concat().replace(" 0.01", "")));
    let said = study.uplift(&[&import[..], &["m/s2"]].concat()).stderr;
    assert!(said.contains("unknown acceleration unit in \"accel in mg\""), "{said}");
    assert!(said.contains("Convert the values and correct the line, or remove the unit"), "{said}");
}

#[test]
fn a_unit_is_given_to_the_files_that_state_none() {
    let study = SmallStudy::new();
    std::fs::create_dir(study.path().join("downloads")).unwrap();
    for (name, head, scale) in [
        ("stated_H1", "accel in m/s2\n", 0.01),
        ("stated_H2", "accel in m/s2\n", 0.02),
        ("silent_H1", "", 0.03),
        ("silent_H2", "", 0.04),
    ] {
        let values: Vec<String> = (0..200).map(|i| format!("{:.3}\n", scale * f64::from(i))).collect();
        study.write(&format!("downloads/{name}.txt"), &format!("# dt = 0.01 s\n{head}{}", values.concat()));
    }
    let import =
        |unit| study.uplift(&["records", "import", "downloads", "-o", "m.csv", "--force", "--unit", unit]).ok();
    let manifest = || std::fs::read_to_string(study.path().join("m.csv")).unwrap();
    let unit_of_silent_files = |unit: &str| {
        let manifest = manifest();
        let lines = manifest.lines().filter(|line| line.contains(&format!(",columns,{unit},"))).count();
        assert!(lines == 1 && manifest.contains(&format!("silent_H2.txt,\"\",\"\",columns,{unit},")), "{manifest}");
    };
    // a file that states its unit keeps it
    let done = import("g");
    assert!(done.stdout.starts_with("2 pairs from 4 files"), "{}", done.stdout);
    assert!(done.stderr.contains("another unit (2):\n"), "{}", done.stderr);
    assert!(done.stderr.contains("stated_H1.txt: states m/s2, which is used; --unit is g\n"), "{}", done.stderr);
    unit_of_silent_files("g");
    let shown = |record| study.uplift(&["records", "show", "m.csv", record]).ok().stdout;
    // 0.01 * 199 m/s2, and 0.03 * 199 g
    assert!(shown("stated").contains(" 0.20292 g"), "{}", shown("stated"));
    assert!(shown("silent").contains("5.97"), "{}", shown("silent"));
    let done = import("m/s2");
    assert!(done.stdout.starts_with("2 pairs") && !done.stderr.contains("another unit"), "{}", done.stderr);
    unit_of_silent_files("m/s2");
    // all that the files lack is asked for at once
    for name in ["silent_H1", "silent_H2"] {
        study.write(&format!("downloads/{name}.txt"), &"0.1\n-0.2\n".repeat(50));
    }
    let said = study.uplift(&["records", "import", "downloads", "-o", "m.csv", "--force"]).stderr;
    let line = said.lines().find(|line| line.contains("silent_H1.txt")).unwrap_or_default();
    assert!(line.contains("--unit") && line.contains("--dt-s"), "{said}");
}

#[test]
fn a_mistyped_command_or_file_is_answered_with_the_nearest() {
    let study = SmallStudy::new();
    study.uplift(&["rn", "study.toml"]).fails(2, &["there is no command `rn`: did you mean `run`?"]);
    // and so is a mistyped file
    let beside = study.path().join("study.toml");
    for command in ["run", "check"] {
        for name in ["studdy.toml", "study"] {
            let meant = "there is no such file: did you mean `study.toml`?";
            study.uplift(&[command, name]).fails(3, &[meant]);
        }
    }
    let mistyped = study.path().join("stduy.toml").display().to_string();
    study.uplift(&["check", &mistyped]).fails(3, &[&format!("did you mean `{}`?", beside.display())]);
    study.write("set.csv", "record_id,file_h1,file_h2\n");
    study
        .uplift(&["check", "study.toml", "--set", "records.manifest=sett.csv"])
        .fails(3, &["file not found", "did you mean", "set.csv`?"]);
    study.write("result.h5", "");
    study.uplift(&["spectrum", "reslut.h5"]).fails(4, &["did you mean `result.h5`?"]);
    // below a command of several, one of these
    study.uplift(&["records", "mport"]).fails(2, &["did you mean `import`?"]);
    // a search names what it can vary
    study.uplift(&["target", "pier.toml", "--urs", "r.h5"]).fails(2, &["--vary <strength|size|width|capacity|tendon-"]);
}

#[test]
#[ignore = "long: make test-long"]
fn figures_are_as_wide_as_a_journal_asks() {
    let study = study();
    let plot = ["plot", "r.h5", "--only", "urs-pgv", "-o", "narrow", "--format", "both"];
    study.uplift(&[&plot[..], &["--width-mm", "84", "--dpi", "600", "-q"]].concat()).ok();
    let svg = std::fs::read_to_string(study.path().join("narrow/urs-pgv.svg")).unwrap();
    // 84 mm at 96 to the inch
    assert!(svg.contains("width=\"317\""), "{svg:.200}");
    let image = std::fs::read(study.path().join("narrow/urs-pgv.png")).unwrap();
    let said = image.windows(4).position(|name| name == b"pHYs").unwrap();
    assert_eq!(image[said + 4..said + 8], 23_622_u32.to_be_bytes(), "600 dots an inch");
    study.uplift(&[&plot[..], &["--width-mm", "5"]].concat()).fails(2, &["60..=500"]);
    // no title inside, whatever draws
    study.uplift(&["records", "synthesize", "-o", "set", "--count", "1", "-q"]).ok();
    let curves = ["hazard", "plot", "pga.csv", "--measure", "PGA", "--unit", "g", "-o", "curves.svg"];
    study.uplift(&curves).ok();
    study.uplift(&["response", "set/SYN001_H1.AT2", "--strength", "0.2", "--plot", "history.svg"]).ok();
    for (name, title) in [("curves.svg", "Hazard curves"), ("history.svg", "strength 0.2")] {
        let drawn = std::fs::read_to_string(study.path().join(name)).unwrap();
        assert!(!drawn.contains(title), "{name}");
    }
}

#[test]
fn every_star_has_its_footnote() {
    let study = study();
    let shown = study.uplift(&["table", "r.h5", "--measure", "all"]).ok().stdout;
    let (table, notes) = shown.split_once("probabilities in").unwrap();
    assert_eq!(table.contains(" *\n") || table.contains(" *  "), table.ends_with("* c2 held at 0; "), "{shown}{notes}");
}

#[test]
fn a_quiet_table_is_the_table_and_says_what_its_risks_are() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let (told, quiet) = (["table", "r.h5"], ["table", "r.h5", "-q", "--return-period", "475"]);
    let told = study.uplift(&told).ok().stdout;
    assert!(told.contains("\nWarnings\n  ") && told.contains("probabilities in 50 years"), "{told}");
    let quiet = study.uplift(&quiet).ok().stdout;
    assert!(quiet.contains("475 years") && !quiet.contains("Warnings"), "{quiet}");
    assert!(!quiet.contains("probabilities"), "{quiet}");
    // zero has no sign in a table
    let csv = std::fs::read_to_string(study.path().join("r.urs.csv")).unwrap();
    assert!(csv.contains(",0.0") && !csv.contains(",-0.0"), "{csv}");
}

#[test]
fn an_option_of_another_command_is_said_to_be_so() {
    let study = SmallStudy::new();
    for (typed, words) in [
        (&["run", "study.toml", "--urs", "r.h5"][..], "run has no --urs: it is an option of design, overturning"),
        (&["spectrum", "r.h5", "--report", "a.html"], "spectrum has no --report: it is an option of `uplift design`"),
        (&["run", "study.toml", "--site", "There"], "run has no --site: a run computes every site"),
    ] {
        study.uplift(typed).fails(2, &[words]);
    }
    let unknown = study.uplift(&["run", "study.toml", "--nowhere", "1"]).fails(2, &["--nowhere"]);
    assert!(!unknown.stderr.contains("as a value"), "{}", unknown.stderr);
}

#[test]
fn a_body_wider_than_tall_is_doubted_on_the_first_line() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.write("pier.toml", "kind = \"block\"\nwidth_m = 18\nheight_m = 2.5\nmass_kg = 400e3\n");
    let said = study.uplift(&["design", "pier.toml", "--urs", "r.h5", "--site", "There"]).ok().stdout;
    assert!(said.lines().next().unwrap().contains("subject to the mistake? below, "), "{said}");
    assert!(said.contains("mistake? pier: wider than tall"), "{said}");
    // a width that is meant, as one that `target` found, is not asked to be corrected
    assert!(said.contains(". Swap width and height if they were mixed up\n"), "{said}");
}
