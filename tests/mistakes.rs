//! Bad input: each gets a message with file, line or key, value, and what to do, and the exit code of its kind.

use crate::common::{self, EARLIER, SMALL_STUDY, SmallStudy, repository};

const MANIFEST: &str = "record_id,file_h1,file_h2,set_tags,dt_s,unit\n";

/// A study with the records that `manifest` lists, and good record files to list.
fn with_manifest(manifest: &str) -> SmallStudy {
    let study = SmallStudy::with(
        &SMALL_STUDY.replace("first = 4\n[records.synthetic]\npairs = 4\n", "manifest = \"manifest.csv\"\n"),
    );
    study.write("manifest.csv", &format!("{MANIFEST}{manifest}"));
    let wave: Vec<f64> = (0..300).map(|i| 0.3 * (f64::from(i) * 0.1).sin()).collect();
    study.write("a.txt", &wave.iter().fold(String::new(), |text, a| text + &format!("{a}\n")));
    study.write("a.AT2", &at2(&wave, wave.len()));
    study
}

fn at2(values: &[f64], points: usize) -> String {
    let header = "PEER\nEvent\nACCELERATION TIME SERIES IN UNITS OF G\n";
    let body: String = values.chunks(5).fold(String::new(), |text, line| {
        text + &line.iter().fold(String::new(), |text, a| text + &format!(" {a:.7E}")) + "\n"
    });
    format!("{header}NPTS= {points}, DT= .0100 SEC\n{body}")
}

#[test]
fn usage() {
    let study = SmallStudy::new();
    study.uplift(&["rum"]).fails(2, &["run"]);
    study.uplift(&["run"]).fails(2, &["<STUDY>"]);
    study.uplift(&["run", "study.toml", "--threads", "0"]).fails(2, &["--threads"]);
    study.uplift(&["spectrum", "r.h5", "--period", "475"]).fails(2, &["has no --period: write --return-period"]);
    study.uplift(&["export", "r.h5", "--excel"]).fails(2, &["has no --excel: write --xlsx"]);
}

#[test]
fn study_file() {
    let study = SmallStudy::new();
    study.uplift(&["run", "absent.toml"]).fails(3, &["absent.toml"]);
    study.uplift(&["run", "."]).fails(3, &["."]);
    study.uplift(&["check", "study.toml", "--set", "records.frist=2"]).fails(3, &["frist", "first"]);
    study.uplift(&["check", "study.toml", "--set", "risk.poe=[0.02, 2]"]).fails(3, &["risk.poe", "2"]);
    study.uplift(&["check", "study.toml", "--set", "risk.return_period=475"]).fails(3, &["--return-period 475"]);
    let coordinates = SMALL_STUDY.replace("[[sites]]\n", "[[sites]]\nlongitude = 23.7\n");
    study.write("map.toml", &coordinates);
    study.uplift(&["check", "map.toml"]).fails(3, &["map.toml:", "a site needs no coordinates"]);
    // all mistakes at once, each with its line
    study.write(
        "wrong.toml",
        &SMALL_STUDY
            .replace("[strengths]\nvalues", "[strengths]\nvlaues")
            .replace("levels_cm_s", "levels_m_s")
            .replace("[0, 0.0005, \"0.01:0.01:1\"]", "[0.5, 0.1]")
            .replace("here-pgv.csv", "nowhere.csv"),
    );
    let failed =
        study.uplift(&["run", "wrong.toml"]).fails(3, &["vlaues", "levels_cm_s", "thresholds_m", "nowhere.csv"]);
    assert!(failed.stderr.contains("wrong.toml:"), "{}", failed.stderr);
    assert!(!study.path().join("results").exists());
}

#[test]
fn hazard_curves() {
    let study = SmallStudy::new();
    let spoil = |text: &str, words: &[&str]| {
        study.write("here-pgv.csv", text);
        study.uplift(&["check", "study.toml"]).fails(4, &[&["Here", "here-pgv.csv"], words].concat());
    };
    spoil("iml,maf\n1,0.1\n10,0.2\n300,0.01\n", &["0.2", "0.1"]);
    spoil("iml,maf\n0.5,0.1\n10,abc\n300,0.01\n", &["abc", "line 3"]);
    spoil("iml,maf\n0.5,0.1\n10,NaN\n300,0.01\n", &["NaN"]);
    // all lines at once, up to a number that can be read
    spoil("iml,maf\n0.5,0.1\n10,abc\n20,0,05\n30,x\n300,0.01\n", &["line 3", "abc", "line 4", "line 5"]);
    spoil(&format!("iml,maf\n{}300,0.01\n", "1,what\n".repeat(500)), &["line 2", "and 499 more lines"]);
    spoil("# IM: PGV [m/s]\niml,maf\n0.5,0.1\n300,0.01\n", &["m/s", "cm/s"]);
    spoil("", &["point"]);
    // the last stripe, 100 cm/s, is outside
    spoil("iml,maf\n0.5,0.1\n50,0.01\n", &["100 cm/s", "extrapolate"]);
    study.uplift(&["check", "study.toml", "--set", "risk.extrapolate=loglog"]).ok();
    // m/s taken for cm/s, and cm/s for m/s, where the levels still reach beyond the stripes
    for (rows, word) in
        [("0.5,0.9\n10,0.5\n2000,0.02\n", "1000 cm/s is exceeded"), ("0.1,5e-5\n1,2e-5\n300,1e-9\n", "0.3 cm/s")]
    {
        study.write("here-pgv.csv", &format!("iml,maf\n{rows}"));
        let checked = study.uplift(&["check", "study.toml"]).ok();
        let said = checked.stdout + &checked.stderr;
        assert!(
            said.contains(word) && said.contains("mistake?") && said.contains("which is hardly possible"),
            "{said}"
        );
    }
    study.write("here-pgv.csv", "iml,maf\n0.5,0.1\n10,0.2\n300,0.01\n");
    // the mistakes of several sites at once
    study.write("there-pgv.csv", "iml,poe\n0.005,0.5\n3,1.5\n");
    study.uplift(&["check", "study.toml"]).fails(4, &["Here", "There", "1.5"]);
    // and those of the records
    study.write("manifest.csv", "record_id,file_h1,file_h2\na,no.AT2,no.AT2\n");
    let records = ["check", "study.toml", "--set", "records.manifest=manifest.csv"];
    study.uplift(&records).fails(4, &["Here", "There", "1.5", "no.AT2"]);
}

#[test]
fn manifests() {
    let check = |rows: &str, words: &[&str]| {
        with_manifest(rows).uplift(&["check", "study.toml"]).fails(4, words);
    };
    with_manifest("A,a.AT2,a.AT2,good,,\nB,a.txt,a.txt,good,0.01,g\n").uplift(&["check", "study.toml"]).ok();
    check("", &["manifest.csv", "no records"]);
    check("A,a.AT2,,good,,\n", &["record A", "file_h2", "blank"]);
    check("A,a.AT2,b.AT2,good,,\n", &["record A", "b.AT2", "is missing"]);
    check("A,a.AT2,a.AT2,,,\nA,a.AT2,a.AT2,,,\n", &["twice"]);
    check("A,a.txt,a.txt,,,\n", &["record A", "a.txt"]);
    check("A,a.txt,a.txt,,0.01,stone\n", &["record A", "stone"]);
    check("A,a.txt,a.txt,,-1,g\n", &["dt_s", "-1"]);
    // all of one row
    check("A,b.AT2,,,-1,stone\n", &["b.AT2", "file_h2", "dt_s", "stone"]);
    // one file as both components is said, and a spreadsheet's semicolons are read
    let semicolons = with_manifest("");
    semicolons.write("manifest.csv", "record_id;file_h1;file_h2;set_tags\nA;a.AT2;a.AT2;good\n");
    let checked = semicolons.uplift(&["check", "study.toml", "--set", "records.tag=good"]).ok();
    assert!((checked.stdout + &checked.stderr).contains("same motion as both components (A)"));
    let study = with_manifest("A,a.AT2,a.AT2,one;two,,\n");
    study.uplift(&["check", "study.toml", "--set", "records.tag=three"]).fails(4, &["three", "one", "two"]);
    study.uplift(&["check", "study.toml", "--set", "records.tag=two"]).ok();
    study.write("manifest.csv", "name,h1\nA,a.AT2\n");
    study.uplift(&["check", "study.toml"]).fails(4, &["record_id", "file_h1", "name"]);
    study.write("manifest.csv", "\u{0}\u{1}binary\u{ff}");
    study.uplift(&["check", "study.toml"]).fails(4, &["manifest.csv"]);
}

// Copies under another name are refused, all at once; the user may keep them.
#[test]
fn records_entered_twice() {
    let study = with_manifest("A,a.AT2,b.AT2,,,\nB,copy.AT2,again.AT2,,,\nC,c.AT2,b.AT2,,,\n");
    let wave = |factor: f64| -> Vec<f64> { (0..300).map(|i| factor * (f64::from(i) * 0.1).sin()).collect() };
    for (name, factor) in [("b", 0.2), ("c", 0.1), ("copy", 0.3), ("again", 0.2)] {
        study.write(&format!("{name}.AT2"), &at2(&wave(factor), 300).replace("Event", name));
    }
    for command in ["check", "run"] {
        let failed = study.uplift(&[command, "study.toml"]).fails(
            4,
            &["record B is record A again", "copy.AT2", "record C has a motion of record A", "records.duplicates"],
        );
        assert!(failed.stderr.contains("2 problems"), "{}", failed.stderr);
    }
    let keep = ["--set", "records.duplicates=keep"];
    let checked = study.uplift(&[&["check", "study.toml"], &keep[..]].concat()).ok();
    assert!(checked.stdout.contains("records entered twice are kept: B is A, C is A"), "{}", checked.stdout);
    let one = ["--set", "records.first=1"];
    study.uplift(&[&["check", "study.toml"], &one[..]].concat()).ok();
}

// The checkpoint of a run is no result, and says what makes one of it.
#[test]
fn a_part_of_a_run_says_how_to_finish_it() {
    let study = SmallStudy::new();
    study.write("r.h5.part", "{\"format\":\"uplift analysis rows 2\"}\n");
    for command in ["report", "spectrum", "bootstrap", "warnings"] {
        study.uplift(&[command, "r.h5.part"]).fails(4, &["r.h5.part", "interrupted", "repeat the command", "status"]);
    }
}

// One --set turns a study of synthetic records into one of real ones; a path typed there starts from where it is typed.
#[test]
fn manifest_goes_before_the_synthetic_set() {
    let study = with_manifest("A,a.AT2,a.AT2,good,,\nB,a.txt,a.txt,,0.01,g\n");
    study.write("synthetic.toml", SMALL_STUDY);
    let set = ["--set", "records.manifest=manifest.csv", "--set", "records.tag=good", "--set", "records.first=1"];
    let run = study.uplift(&[&["run", "synthetic.toml", "-o", "r.h5"], &set[..]].concat()).ok();
    assert!(run.stderr.contains("1 recorded pair (manifest.csv, tag good)"), "{}", run.stderr);
    assert!(!run.stdout.contains("synthetic"), "{}", run.stdout);
}

#[test]
fn record_files() {
    let study = with_manifest("A,a.AT2,b.AT2,,,\nC,c.AT2,a.AT2,,,\nD,a.AT2,d.AT2,,,\nE,e.AT2,e.AT2,,,\n");
    let wave: Vec<f64> = (0..50).map(|i| 0.1 * f64::from(i % 7)).collect();
    study.write("b.AT2", &at2(&wave, 60));
    study.write("c.AT2", &at2(&wave, 50).replace("1.0000000E-1", "NaN"));
    study.write("d.AT2", &at2(&wave, 50).replace("ACCELERATION", "VELOCITY"));
    study.write("e.AT2", &at2(&[0.0; 50], 50));
    // all of them at once, each with its record
    study
        .uplift(&["run", "study.toml"])
        .fails(4, &["record A", "b.AT2", "60", "50", "record C", "c.AT2", "NaN", "record D", "d.AT2", "VELOCITY"]);
    study.write("manifest.csv", &format!("{MANIFEST}E,e.AT2,e.AT2,,,\n"));
    study.uplift(&["run", "study.toml"]).fails(4, &["record E", "does not move"]);
}

#[cfg(unix)]
#[test]
fn places_that_cannot_be_written() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "."]).fails(4, &["folder"]);
    study.uplift(&["run", "study.toml", "-o", "study.toml/r.h5"]).fails(4, &["study.toml"]);
    study.uplift(&["run", "study.toml", "-o", "/proc/r.h5"]).fails(4, &["/proc", "cannot create"]);
    // found before the analyses, not after
    assert!(!study.uplift(&["run", "study.toml", "-o", "."]).stderr.contains("analyses"));
}

// An earlier result survives whatever ends a run early.
#[test]
fn earlier_result_survives() {
    let study = SmallStudy::new();
    study.write_bytes("r.h5", EARLIER);
    study.write("here-pgv.csv", "iml,maf\n0.5,0.1\n50,0.01\n");
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).fails(4, &["100 cm/s"]);
    assert_eq!(std::fs::read(study.path().join("r.h5")).unwrap(), EARLIER);
}

#[test]
fn closed_output_is_no_error() {
    let study = SmallStudy::new();
    let script = format!("'{}' check study.toml | head -n 1", env!("CARGO_BIN_EXE_uplift"));
    let output = std::process::Command::new("sh").args(["-c", &script]).current_dir(study.path()).output().unwrap();
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn help_names_every_command() {
    let study = SmallStudy::new();
    let help = study.uplift(&["--help"]).ok().stdout;
    for command in ["run", "check", "response", "pulse", "table", "Exit codes"] {
        assert!(help.contains(command), "{command}:\n{help}");
    }
}

// A slip of the keyboard must not cost an input: a result overwrites only an HDF5 file.
#[test]
fn inputs_are_never_overwritten() {
    let study = with_manifest("A,a.AT2,a.AT2,,,\n");
    for name in ["study.toml", "manifest.csv", "here-pgv.csv", "a.AT2"] {
        let before = std::fs::read(study.path().join(name)).unwrap();
        study.uplift(&["run", "study.toml", "-o", name]).fails(2, &[name, "HDF5 file", ".h5"]);
        assert_eq!(std::fs::read(study.path().join(name)).unwrap(), before, "{name}");
    }
    let before = std::fs::read(study.path().join("a.AT2")).unwrap();
    study.uplift(&["response", "a.AT2", "--strength", "0.2", "--history", "./a.AT2"]).fails(2, &["a.AT2", ".csv"]);
    assert_eq!(std::fs::read(study.path().join("a.AT2")).unwrap(), before);
}

// A manifest saved by a spreadsheet, and what stands for an unknown number.
#[test]
fn numbers_of_a_manifest() {
    let study = with_manifest("");
    let check = |magnitude: &str| {
        study.write("manifest.csv", &format!("record_id;file_h1;file_h2;magnitude\nA;a.AT2;a.AT2;{magnitude}\n"));
        study.uplift(&["check", "study.toml", "--set", "records.select.magnitude=\":7\""])
    };
    check("6.7").ok();
    check("6,69").ok();
    study.write("manifest.csv", "record_id,file_h1,file_h2,magnitude\nA,a.AT2,a.AT2,\"6,69\"\n");
    study.uplift(&["check", "study.toml"]).fails(4, &["record A", "magnitude", "decimal comma", "semicolons"]);
    check("17. Jan").fails(4, &["magnitude is \"17. Jan\"", "0 to 10"]);
    check("99").fails(4, &["magnitude is \"99\""]);
    check("-999").fails(4, &["1 of 1 records have no magnitude in the manifest"]);
}

// Nobody reads what is reported on the way: the work goes on.
#[cfg(target_os = "linux")]
#[test]
fn a_closed_error_output_ends_nothing() {
    let study = SmallStudy::new();
    let full = || std::process::Stdio::from(std::fs::File::options().write(true).open("/dev/full").unwrap());
    let run = |arguments: &[&str]| common::command(study.path()).args(arguments).stderr(full()).output().unwrap();
    assert!(run(&["run", "study.toml"]).status.success());
    assert!(run(&["bootstrap", "results/study.h5", "--replicates", "20"]).status.success());
    assert_eq!(run(&["run", "absent.toml"]).status.code(), Some(3));
}

/// One kind of file given where another is wanted: what it is, and what takes it.
#[test]
fn files_in_the_wrong_place() {
    let study = SmallStudy::new();
    std::fs::copy(repository().join("configs/structures/block.toml"), study.path().join("block.toml")).unwrap();
    study.write("a.AT2", &at2(&[0.0, 0.1, 0.2], 3));
    study.write("manifest.csv", "record_id,file_h1,file_h2\na,a.AT2,a.AT2\n");
    study.write("marked.csv", "\u{feff}record_id,file_h1,file_h2\na,a.AT2,a.AT2\n");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    std::fs::create_dir(study.path().join("results")).unwrap();
    for (arguments, code, words) in [
        (&["run", "r.h5"][..], 3, &["r.h5", "it is a result, not a study", "`uplift status`"][..]),
        (&["check", "r.h5"], 3, &["it is a result, not a study"]),
        (&["run", "block.toml"], 3, &["block.toml", "it is a structure, not a study", "`uplift design`"]),
        (&["run", "manifest.csv"], 3, &["manifest.csv", "it is a manifest of records, not a study"]),
        (&["hazard", "show", "study.toml"], 4, &["study.toml: is TOML, not a hazard curve", "`uplift check`"]),
        (&["hazard", "show", "nothing.toml"], 4, &["nothing.toml", "there is no such file"]),
        (&["run", "marked.csv"], 3, &["marked.csv", "it is a manifest of records, not a study"]),
        (&["check", "a.AT2"], 3, &["a.AT2", "it is a record, not a study", "`uplift response`"]),
        (&["design", "study.toml", "--urs", "r.h5"], 3, &["it is a study, not a structure", "`uplift run`"]),
        (&["design", "r.h5", "--urs", "r.h5"], 3, &["it is a result, not a structure", "--urs"]),
        (&["check", "."], 3, &["it is a folder: give a file, e.g. ./study.toml"]),
        (&["check", "results"], 3, &["it is a folder: give a file, e.g. configs/europe.toml"]),
        (&["table", "study.toml"], 4, &["study.toml: is a study, not a result", "`uplift run study.toml`"]),
        (&["export", "study.toml", "--csv"], 4, &["study.toml: is a study, not a result"]),
        (&["export", "block.toml", "--csv"], 4, &["block.toml: is a structure, not a result"]),
        (&["table", "r.urs.csv"], 4, &["r.urs.csv: is a table, not a result"]),
        (
            &["design", "block.toml", "--urs", "study.toml", "--site", "Here"],
            4,
            &["study.toml: is a study, not a result: run `uplift run study.toml` first, and give results/study.h5"],
        ),
        (&["response", "r.h5", "--strength", "0.1"], 4, &["r.h5: is an HDF5 file such as a result", "not a record"]),
        (&["response", "block.toml", "--strength", "0.1"], 4, &["block.toml: is a TOML file such as a study or"]),
        (&["response", "manifest.csv", "--strength", "0.1"], 4, &["manifest.csv: is a manifest", "not a record"]),
        (&["records", "list", "r.h5"], 4, &["r.h5", "it is an HDF5 file such as a result"]),
        (&["records", "list", "block.toml"], 4, &["block.toml", "it is a TOML file such as a study or structure"]),
        (&["records", "list", "a.AT2"], 4, &["a.AT2", "it is a record"]),
        (&["response", "a.AT2/b", "--strength", "0.1"], 4, &["a.AT2/b: a part of the path is a file, not a folder"]),
        (&["check", "study.toml", "--set", "records.manifest=a.AT2/x.csv"], 3, &["a part of the path is a file"]),
        (&["check", "a.AT2/x.toml"], 3, &["cannot read a.AT2/x.toml: a part of the path is a file, not a folder"]),
        (&["hazard", "show", "a.AT2/x.csv"], 4, &["a.AT2/x.csv: a part of the path is a file, not a folder"]),
        (&["status", "a.AT2/x.h5"], 4, &["a part of the path is a file, not a folder"]),
        (&["sweep", "study.toml", "--cases", "r.h5"], 4, &["r.h5: it is an HDF5 file such as a result"]),
        (&["sweep", "study.toml", "--cases", "a.AT2"], 4, &["a.AT2: it is a record"]),
        (&["hazard", "show", "r.h5"], 4, &["it is an HDF5 file such as a result, not a hazard curve"]),
        (&["sweep", "study.toml", "--cases", "block.toml"], 4, &["block.toml: it is a TOML file"]),
        (&["sweep", "study.toml", "--cases", "manifest.csv"], 4, &["manifest.csv: it is a manifest of records"]),
        (&["run", "absent.toml"], 3, &["absent.toml", "there is no such file"]),
        (&["records", "show", "absent.AT2"], 4, &["absent.AT2: there is no such file"]),
        (&["hazard", "show", "absent.csv"], 4, &["absent.csv: there is no such file"]),
        (&["validate", "absent.csv", "a.AT2"], 4, &["absent.csv: cannot read the file: there is no such file"]),
        (&["verify", "absent.h5"], 4, &["absent.h5: cannot open the file: there is no such file"]),
        (&["table", "absent.h5"], 4, &["absent.h5: there is no such file", "`uplift run STUDY.toml`"]),
    ] {
        let failed = study.uplift(arguments).fails(code, words);
        assert!(!failed.stderr.contains("os error"), "{}", failed.stderr);
    }
}

#[test]
fn probabilities_as_they_are_typed() {
    let study = SmallStudy::new();
    let rare = ["--set", "risk.poe=[1e-9, 0.1]", "--set", "risk.extrapolate=loglog"];
    study.uplift(&[&["run", "study.toml", "-o", "r.h5", "-q"], &rare[..]].concat()).ok();
    let shown = study.uplift(&["influence", "r.h5", "--poe", "10%"]).ok().stdout;
    assert!(shown.contains("10 % in 50 years"), "{shown}");
    let shown = study.uplift(&["influence", "r.h5", "--poe", "1e-9"]).ok().stdout;
    assert!(shown.contains("1e-9 in 50 years"), "{shown}");
    for (asked, words) in [
        (["--return-period", "0.02"], "--return-period 0.02: is in years, e.g. 475; a probability is --poe 0.02"),
        (["--poe", "475"], "a return period is --return-period 475"),
        (["--site", "Her"], "the result has no site Her: it has Here, There; did you mean Here?"),
    ] {
        study.uplift(&[&["spectrum", "r.h5"], &asked[..]].concat()).fails(2, &[words]);
    }
    study.uplift(&["influence", "r.h5", "--poe", "10"]).fails(2, &["10 per cent is 10%"]);
    study.uplift(&["influence", "r.h5", "--poe", "20%"]).fails(2, &["no probability 0.2: it has 1e-9, 0.1"]);
}

/// Records in cm/s² whose files say g.
#[test]
fn impossible_units_are_reported() {
    let study = with_manifest("A,gal.AT2,gal.AT2,,,\n");
    let wave: Vec<f64> = (0..200).map(|i| 200.0 * (f64::from(i) * 0.1).sin() * (-f64::from(i) * 0.01).exp()).collect();
    study.write("gal.AT2", &at2(&wave, wave.len()));
    for arguments in
        [&["check", "study.toml"][..], &["records", "show", "gal.AT2"], &["records", "show", "manifest.csv", "A"]]
    {
        let run = study.uplift(arguments).ok();
        let said = run.stdout + &run.stderr;
        assert!(said.contains("unit right"), "{arguments:?}\n{said}");
    }
    // the other way round: in g, and the head says cm/s2
    let weak = at2(&wave.iter().map(|a| a / 500.0).collect::<Vec<_>>(), wave.len());
    study.write("gal.AT2", &weak.replace("UNITS OF G", "UNITS OF CM/S2"));
    std::fs::create_dir(study.path().join("d")).unwrap();
    study.write("d/RSN1_A000.AT2", &weak.replace("UNITS OF G", "UNITS OF CM/S2"));
    study.write("d/RSN1_A090.AT2", &weak);
    for (arguments, component) in [
        (&["check", "study.toml"][..], "h1 "),
        (&["records", "show", "gal.AT2"], ""),
        (&["records", "show", "manifest.csv", "A"], "h1 "),
        (&["records", "import", "d", "-o", "set.csv"], "h1 "),
    ] {
        let run = study.uplift(arguments).ok();
        let said = run.stdout + &run.stderr;
        let doubt = format!("{component}PGA 3.");
        let doubted = ["mistake? ", "mistake? A: "].iter().any(|of| said.contains(&format!("{of}{doubt}")));
        assert!(doubted && said.contains("e-4 g: is the file in g?"), "{arguments:?}\n{said}");
    }
}

/// Names given with `-o` that are those of something else.
#[test]
fn names_of_other_outputs() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
        .uplift(&["run", "study.toml", "--shard", "1/2", "-o", "x.h5"])
        .fails(2, &["x.h5: a shard is not yet a result", "write -o x.shard-1-of-2", "`uplift merge`"]);
    for (arguments, words) in [
        (&["plot", "r.h5", "-o", "figures.h5"][..], "write -o figures"),
        (&["plot", "r.h5", "-o", "r.h5"], "write -o r"),
        (&["plot", "r.h5", "-o", "one.svg", "--only", "urs"], "write -o one"),
        (&["hazard", "import", "pga.csv", "-o", "hz.csv"], "-o names a folder for the curves"),
        (&["pulse", "-o", "p.png"], "-o names a folder for the figures and tables"),
    ] {
        study.uplift(arguments).fails(2, &["this is the name of a file", words]);
    }
    for name in ["x.h5", "figures.h5", "one.svg", "hz.csv", "p.png"] {
        assert!(!study.path().join(name).exists(), "{name}");
    }
}
