//! `uplift run` and `uplift check` from end to end.

use std::path::Path;
use std::process::Command;

use uplift_labelled::LabelledReader;

use crate::common::{self, EARLIER, SmallStudy, python, repository};

fn arrays(path: &Path) -> Vec<(String, Vec<u64>)> {
    let reader = LabelledReader::open(path).unwrap();
    let mut found = Vec::new();
    for im in ["pgv", "pga"] {
        for name in ["ida/@/edp_m", "risk/@/maf_per_year", "urs/@/u_m", "urs/@/lower_tail_share", "regression/@/c0_m"] {
            let path = format!("/{}", name.replace('@', im));
            let bits = reader.array::<f64>(&path).unwrap().values.iter().map(|value| value.to_bits()).collect();
            found.push((path, bits));
        }
    }
    found
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let study = SmallStudy::new();
    for threads in ["1", "2", "5"] {
        study.uplift(&["run", "study.toml", "-o", &format!("{threads}.h5"), "--threads", threads]).ok();
    }
    let one = arrays(&study.path().join("1.h5"));
    assert!(one.iter().all(|(_, bits)| !bits.is_empty()));
    assert_eq!(one, arrays(&study.path().join("2.h5")));
    assert_eq!(one, arrays(&study.path().join("5.h5")));
}

#[test]
fn known_limits_come_out_right() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();

    // strength 0: the displacement is the peak ground displacement, so it grows in proportion to the level, to rounding
    let edp = reader.array::<f64>("/ida/pgv/edp_m").unwrap();
    let levels = reader.axis::<f64>("pgv_level").unwrap();
    let [records, strengths, count] = edp.shape[..] else { panic!("{:?}", edp.shape) };
    assert_eq!((records, strengths, count), (4, 10, 5));
    for record in 0..records {
        let row = &edp.values[record * strengths * count..][..count];
        for (u, level) in row.iter().zip(&levels) {
            assert!((u / row[0] / (level / levels[0]) - 1.0).abs() < 1e-12, "{row:?}");
        }
    }
    // ordinates fall with the probability; the surface is a falling function of the threshold that ends at the ordinate
    let u_m = reader.array::<f64>("/urs/pgv/u_m").unwrap().values;
    let surface = reader.array::<f64>("/risk/pgv/maf_per_year").unwrap();
    let thresholds = reader.axis::<f64>("threshold").unwrap();
    let poes = reader.axis::<f64>("poe").unwrap();
    assert_eq!(poes, [0.02, 0.1, 0.5]);
    for site in 0..2 {
        for strength in 0..strengths {
            let ordinate = |poe: usize| u_m[(site * 3 + poe) * strengths + strength];
            assert!(ordinate(0) >= ordinate(1) && ordinate(1) >= ordinate(2));
            let row = &surface.values[(site * strengths + strength) * thresholds.len()..][..thresholds.len()];
            assert!(row.windows(2).all(|pair| pair[0] >= pair[1]));
            for (poe, p) in poes.iter().enumerate() {
                let target = -(-p).ln_1p() / 50.0;
                for (threshold, rate) in thresholds.iter().zip(row) {
                    assert_eq!(*threshold >= ordinate(poe), *rate <= target, "{threshold} {rate} {target}");
                }
            }
        }
    }
}

// The site There has half the rates of Here, given as probabilities in 50 years and in m/s: the same spectrum at half
// the rate.
#[test]
fn probabilities_and_units_of_hazard_are_converted() {
    let study = SmallStudy::new();
    // half the rate of 4 % in 50 years
    let half = 1.0 - 0.96_f64.sqrt();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "--set", &format!("risk.poe=[{half}, 0.04]")]).ok();
    let u_m = LabelledReader::open(&study.path().join("r.h5")).unwrap().array::<f64>("/urs/pgv/u_m").unwrap().values;
    let (here_at_4, there_at_half) = (&u_m[10..20], &u_m[20..30]);
    assert!(here_at_4.iter().any(|&u| u > 0.001));
    for (a, b) in here_at_4.iter().zip(there_at_half) {
        assert!((a - b).abs() < 1e-9, "{here_at_4:?} {there_at_half:?}");
    }
}

#[test]
fn summary_tables_and_provenance() {
    let study = SmallStudy::new();
    let run = study.uplift(&["run", "study.toml", "-o", "out/r.h5"]).ok();
    for words in ["synthetic", "out/r.h5", "2 % in 50 years, by PGV", "Here", "Few records: 4 (40 advised)"] {
        assert!(run.stdout.contains(words), "{words}:\n{}", run.stdout);
    }
    assert!(run.stderr.contains("200 analyses"), "{}", run.stderr);
    let urs = std::fs::read_to_string(study.path().join("out/r.urs.csv")).unwrap();
    let beside = std::fs::read_to_string(study.path().join("out/r.urs.csv-metadata.json")).unwrap();
    let beside: serde_json::Value = serde_json::from_str(&beside).unwrap();
    let line = beside["dc:provenance"].as_str().unwrap();
    assert!(line.starts_with("uplift ") && line.contains("synthetic") && line.contains("study.toml"), "{line}");
    assert_eq!((&beside["url"], &beside["tableSchema"]["columns"][5]["titles"]), (&"r.urs.csv".into(), &"u_m".into()));
    let mut lines = urs.lines();
    insta::assert_snapshot!(
        lines.next().unwrap(),
        @"site,im,poe,years,strength,u_m,flag,lower_tail_share,upper_tail_share,lower_m,upper_m"
    );
    // the bands that `spectrum` quotes
    let quoted = study.uplift(&["spectrum", "out/r.h5", "--strength", "0.2", "--poe", "0.02", "--csv"]).ok().stdout;
    let quoted: Vec<&str> = quoted.lines().nth(1).unwrap().split(',').collect();
    let row = urs.lines().find(|line| line.starts_with("Here,PGV,0.02,50.0,0.2,")).unwrap();
    assert_eq!(row.split(',').skip(9).collect::<Vec<_>>(), quoted[7..]);
    assert_eq!(lines.count(), 2 * 2 * 3 * 10);
    let regression = std::fs::read_to_string(study.path().join("out/r.regression.csv")).unwrap();
    insta::assert_snapshot!(
        regression.lines().next().unwrap(),
        @"site,im,poe,years,c0_m,c1,c2_m,rmse_m,rmse_plain_m,bound_active,points"
    );
    assert_eq!(regression.lines().count(), 1 + 12);

    let reader = LabelledReader::open(&study.path().join("out/r.h5")).unwrap();
    assert!(reader.attribute::<String>("/", "record_set").unwrap().contains("synthetic"));
    let resolved = reader.attribute::<String>("/", "study_toml").unwrap();
    // the resolved study in the file runs again, from anywhere
    let elsewhere = tempfile::tempdir().unwrap();
    std::fs::write(elsewhere.path().join("again.toml"), resolved).unwrap();
    common::uplift(elsewhere.path(), &["run", "again.toml", "-o", "again.h5", "-q"]).ok();
    assert_eq!(arrays(&elsewhere.path().join("again.h5")), arrays(&study.path().join("out/r.h5")));

    let quiet = study.uplift(&["run", "study.toml", "-o", "q.h5", "--quiet"]).ok();
    // the table with its two lines of heading
    let (table, _) = run.stdout.split_once("\n\nWarnings").unwrap();
    assert_eq!((quiet.stdout, quiet.stderr), (format!("{table}\n"), String::new()));
    let json = study.uplift(&["run", "study.toml", "-o", "j.h5", "--quiet", "--json"]).ok();
    let summary: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(summary["synthetic"], true);
    assert_eq!(summary["coefficients"].as_array().unwrap().len(), 12);
    assert_eq!(summary["measures"][0]["analyses"], 200);
}

#[test]
fn check_says_what_a_run_would_do() {
    let study = SmallStudy::new();
    let check = study.uplift(&["check", "study.toml"]).ok();
    for words in [
        "Synthetic records: not for design",
        "Few records: 4 (40 advised)",
        "The study can be run: 360 analyses, about a second on ",
    ] {
        assert!(check.stdout.contains(words), "{words}:\n{}", check.stdout);
    }
    let completed = study.uplift(&["check", "study.toml", "--print-study"]).ok().stdout;
    assert!(completed.contains("[oscillator]") && completed.contains("restitution = 0.95"), "{completed}");
    // as it is printed it is the same study
    study.write("completed.toml", &completed);
    assert_eq!(study.uplift(&["check", "completed.toml", "--print-study"]).ok().stdout, completed);
    let json = study.uplift(&["check", "study.toml", "--json"]).json();
    assert_eq!(json["analyses"], 360);
    assert!(json["seconds"].as_f64().unwrap() > 0.0);
}

#[test]
fn negative_stiffness_overturns_and_is_said_so() {
    let study = SmallStudy::new();
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5", "--set", "oscillator.capacity_m=0.02"]).ok();
    assert!(run.stdout.contains("overturns"), "{}", run.stdout);
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let edp = reader.array::<f64>("/ida/pgv/edp_m").unwrap().values;
    assert!(edp.iter().any(|u| u.is_infinite()) && !edp.iter().any(|u| u.is_nan()));
    let (u_m, flag) =
        (reader.array::<f64>("/urs/pgv/u_m").unwrap().values, reader.array::<u8>("/urs/pgv/flag").unwrap().values);
    assert!(flag.contains(&2));
    assert!(u_m.iter().zip(&flag).all(|(u, flag)| u.is_infinite() == (*flag == 2)));
}

// So does SIGTERM, and says in a line how to go on.
#[cfg(unix)]
#[test]
fn termination_says_how_to_go_on() {
    let study = SmallStudy::new();
    let long =
        ["run", "study.toml", "-o", "r.h5", "--set", "strengths.values=0:1/20000:1", "--set", "risk.maf_surface=false"];
    let mut run = study.start(&[&long[..], &["-q"]].concat());
    let checkpoint = study.path().join("r.h5.part");
    run.wait_until("a checkpoint", || checkpoint.exists());
    run.terminate();
    let ended = run.end().fails(5, &["interrupted", "checkpoint", "Run the same command to resume"]);
    assert_eq!(ended.stderr.lines().count(), 1, "{}", ended.stderr);
}

// Ctrl-C ends a long run soon, with its own exit code, and leaves the earlier result alone.
#[cfg(unix)]
#[test]
fn interruption_keeps_the_earlier_result() {
    let study = SmallStudy::new();
    study.write_bytes("r.h5", EARLIER);
    let long =
        ["run", "study.toml", "-o", "r.h5", "--set", "strengths.values=0:1/20000:1", "--set", "risk.maf_surface=false"];
    let mut run = study.start(&long);
    let checkpoint = study.path().join("r.h5.part");
    run.wait_until("a checkpoint", || checkpoint.exists());
    run.interrupt();
    run.end().fails(5, &["interrupted"]);
    assert_eq!(std::fs::read(study.path().join("r.h5")).unwrap(), EARLIER);
    // asked twice it ends at once, not without a word
    let mut run = study.start(&[&long[..], &["--force"]].concat());
    run.wait_until_said("records");
    run.hold();
    run.interrupt();
    run.terminate();
    run.release();
    let ended = run.end().fails(5, &["uplift: interrupted"]);
    assert!(ended.stderr.lines().last().unwrap().starts_with("uplift: interrupted"), "{}", ended.stderr);
    assert_eq!(
        study
            .path()
            .read_dir()
            .unwrap()
            .filter(|entry| { entry.as_ref().unwrap().file_name().to_string_lossy().contains("partial") })
            .count(),
        0
    );
}

// A disk that fills up while the result is written: a limit on the size of files stands in for it.
#[cfg(unix)]
#[test]
fn full_disk_keeps_the_earlier_result() {
    let study = SmallStudy::new();
    study.write_bytes("r.h5", EARLIER);
    let script =
        format!("trap '' XFSZ; ulimit -f 16; exec '{}' run study.toml -o r.h5 --quiet", env!("CARGO_BIN_EXE_uplift"));
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(study.path())
        .env("UPLIFT_CACHE", "")
        .env("XDG_CACHE_HOME", study.path().join("no-cache"))
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{stderr}");
    assert!(stderr.contains("r.h5") && stderr.contains("File too large"), "{stderr}");
    assert_eq!(std::fs::read(study.path().join("r.h5")).unwrap(), EARLIER);
}

#[test]
#[ignore = "long: make test-long"]
fn python_reads_the_result() {
    let Some(python) = python() else { return };
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    add_everything(&study);
    for script in ["tests/python/read_result.py", "tests/python/read_spectra.py"] {
        let output =
            Command::new(&python).arg(repository().join(script)).arg(study.path().join("r.h5")).output().unwrap();
        let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success(), "{stdout}\n{stderr}");
    }
}

/// What the commands after a run add to its result.
fn add_everything(study: &SmallStudy) {
    study.uplift(&["bootstrap", "r.h5", "--replicates", "20", "--sizes", "2,4", "--simultaneous"]).ok();
    study.uplift(&["influence", "r.h5"]).ok();
    study.uplift(&["measures", "r.h5"]).ok();
}

#[test]
fn the_tree_of_a_result() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    add_everything(&study);
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let mut lines = Vec::new();
    let groups = [
        "/axes",
        "/records",
        "/ida/pgv",
        "/risk/pgv",
        "/urs/pgv",
        "/regression/pgv",
        "/hazard/Here/pgv",
        "/bootstrap",
        "/bootstrap/pgv",
        "/influence/pgv",
        "/disaggregation/pgv",
        "/efficiency/pgv",
        "/sufficiency/pgv",
        "/sufficiency/pgv/magnitude",
    ];
    for group in groups {
        lines.push(format!("{group}: {}", reader.children(group).unwrap().join(" ")));
    }
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
#[ignore = "long: make test-long"]
fn shipped_studies_are_in_order() {
    for entry in repository().join("configs").read_dir().unwrap() {
        let path = entry.unwrap().path();
        let is_toml = path.extension().is_some_and(|extension| extension == "toml");
        if !is_toml || path.ends_with(crate::schema::LIBRARY) {
            continue; // structures, schemas, and the library, which is no study
        }
        let out = tempfile::tempdir().unwrap();
        // small enough to be checked in no time
        let set = format!("output.file={}", out.path().join("r.h5").display());
        let study = path.to_str().unwrap();
        common::uplift(out.path(), &["check", study, "--set", "records.first=2", "--set", &set, "-q"]).ok();
    }
}

#[test]
fn a_finished_run_is_done_already_and_keeps_what_was_added() {
    let study = SmallStudy::new();
    let run = |more: &[&str]| study.uplift(&[&["run", "study.toml", "-o", "r.h5"][..], more].concat()).ok();
    let done = |more: &[&str]| -> bool {
        let told: serde_json::Value = serde_json::from_str(&run(&[&["--json"], more].concat()).stdout).unwrap();
        told["done_already"].as_bool().unwrap()
    };
    assert!(!done(&[]));
    study.uplift(&["bootstrap", "r.h5", "--replicates", "20", "--sizes", "2", "-q"]).ok();
    let before = std::fs::read(study.path().join("r.h5")).unwrap();
    // a run that was killed after its last write left its lock
    let lock = study.path().join(".r.h5.lock");
    std::fs::write(&lock, "process 1").unwrap();
    assert!(done(&[]) && run(&[]).stdout.contains("done already") && !lock.exists());
    // a table that is gone, and another title, take nothing away
    std::fs::remove_file(study.path().join("r.urs.csv")).unwrap();
    assert!(run(&[]).stderr.contains("r.urs.csv was missing"));
    assert!(study.path().join("r.urs.csv").exists());
    assert!(done(&["--set", "title=\"other\""]));
    assert_eq!(std::fs::read(study.path().join("r.h5")).unwrap(), before);
    // what a bootstrap is asked for by default is another result, and so is a damaged one
    assert!(!done(&["--force", "--set", "bootstrap.replicates=30"]));
    std::fs::write(study.path().join("r.h5"), &before[..before.len() / 2]).unwrap();
    assert!(!done(&["--force"]));
    assert!(!done(&["--again"]) && study.path().join("r.urs.csv").exists());
}

/// Whether the JSON of a run says that nothing was computed.
fn says_done_already(study: &SmallStudy, arguments: &[&str]) -> (bool, serde_json::Value) {
    let text = study.uplift(&[arguments, &["--json"]].concat()).ok().stdout;
    let mut told: serde_json::Value = serde_json::from_str(&text).unwrap();
    let done = told["done_already"].as_bool().unwrap();
    for volatile in ["done_already", "seconds"] {
        told.as_object_mut().unwrap().remove(volatile);
    }
    (done, told)
}

#[test]
fn every_kind_of_study_is_done_already_until_its_inputs_change() {
    let study = SmallStudy::new();
    study.write(
        "spectra.toml",
        "kind = \"displacement spectra\"\ntitle = \"few\"\n[records.synthetic]\npairs = 3\n[scaling]\nto = \
         [\"unscaled\", \"2 PGA\"]\n[block]\nheight_m = [0.5]\n[slenderness]\nvalues = [0.1, 0.2]\n",
    );
    study.write("table.toml", crate::shake_table::STUDY);
    study.write("frame.toml", crate::shake_table::FRAME);
    for file in ["spectra.toml", "table.toml"] {
        let run = ["run", file, "-o", "r.h5", "--force"];
        let (done, first) = says_done_already(&study, &run);
        assert!(!done, "{file}");
        let bytes = std::fs::read(study.path().join("r.h5")).unwrap();
        // the second report has the numbers of the first, and writes the tables that are missing
        assert_eq!(says_done_already(&study, &run), (true, first.clone()), "{file}");
        let tables: Vec<&str> = first["files"].as_array().unwrap()[1..].iter().map(|it| it.as_str().unwrap()).collect();
        let read = || tables.iter().map(|table| std::fs::read(study.path().join(table)).unwrap()).collect::<Vec<_>>();
        let written = read();
        for table in &tables {
            std::fs::remove_file(study.path().join(table)).unwrap();
        }
        assert_eq!(says_done_already(&study, &run), (true, first.clone()), "{file}");
        assert!(!written.is_empty() && read() == written, "{tables:?}");
        assert!(study.uplift(&run).ok().stdout.contains("done already"));
        assert_eq!(std::fs::read(study.path().join("r.h5")).unwrap(), bytes, "{file}");
        let other = [&run[..], &["--set", "records.synthetic.pairs=5"]].concat();
        assert!(!says_done_already(&study, &other).0, "{file}");
        assert!(!says_done_already(&study, &[&other[..], &["--again"]].concat()).0, "{file}");
        // a damaged result is computed again
        let whole = std::fs::read(study.path().join("r.h5")).unwrap();
        std::fs::write(study.path().join("r.h5"), &whole[..whole.len() / 2]).unwrap();
        assert!(!says_done_already(&study, &other).0 && says_done_already(&study, &other).0, "{file}");
    }
    // the same study of another structure
    study.write("frame.toml", &crate::shake_table::FRAME.replace("9000", "9001"));
    assert!(!says_done_already(&study, &["run", "table.toml", "-o", "r.h5", "--force"]).0);
}

/// Metadata of a manifest is in the result: another magnitude is another result, though the motions are the same.
#[test]
fn another_magnitude_in_the_manifest_is_another_displacement_result() {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "--count", "3", "-o", "set", "-q"]).ok();
    study.write(
        "spectra.toml",
        "kind = \"displacement spectra\"\ntitle = \"few\"\n[records]\nmanifest = \"set/manifest.csv\"\n[scaling]\n\
         to = [\"unscaled\"]\n[block]\nheight_m = [0.5]\n[slenderness]\nvalues = [0.1]\n",
    );
    let run = ["run", "spectra.toml", "-o", "r.h5"];
    assert!(!says_done_already(&study, &run).0 && says_done_already(&study, &run).0);
    let manifest = std::fs::read_to_string(study.path().join("set/manifest.csv")).unwrap();
    let changed = with_another_magnitude(&manifest);
    assert_ne!(changed, manifest);
    study.write("set/manifest.csv", &changed);
    assert!(!says_done_already(&study, &run).0);
}

/// The manifest with another magnitude in its last row.
fn with_another_magnitude(manifest: &str) -> String {
    let header = manifest.lines().find(|line| !line.starts_with('#')).unwrap();
    let last = manifest.lines().last().unwrap();
    // the text of an earthquake may have commas: count from the end
    let from_end = header.split(',').rev().position(|name| name == "magnitude").unwrap();
    let mut cells: Vec<&str> = last.split(',').collect();
    let column = cells.len() - 1 - from_end;
    cells[column] = "6.123";
    manifest.replace(last, &cells.join(","))
}

/// The additions that a file holds, in the words of `uplift status`.
fn additions(study: &SmallStudy) -> Vec<&'static str> {
    let reader = uplift_labelled::LabelledReader::open(&study.path().join("r.h5")).unwrap();
    let groups = ["/bootstrap", "/influence", "/disaggregation", "/efficiency", "/sufficiency", "/structures"];
    groups.into_iter().filter(|group| reader.exists(group)).collect()
}

#[test]
fn additions_survive_every_change_that_does_not_touch_them() {
    let study = SmallStudy::new();
    let run = |more: &[&str]| study.uplift(&[&["run", "study.toml", "-o", "r.h5", "-q"][..], more].concat()).ok();
    run(&[]);
    study.write("block.toml", "kind = \"block\"\nheight_m = 6\nwidth_m = 0.6\nmass_kg = 1e4\n");
    study.uplift(&["bootstrap", "r.h5", "--replicates", "20", "--sizes", "2", "-q"]).ok();
    study.uplift(&["influence", "r.h5", "-q"]).ok();
    study.uplift(&["measures", "r.h5", "-q"]).ok();
    let site = ["--site", "Here"];
    study.uplift(&[&["design", "block.toml", "--urs", "r.h5", "--spectrum-only", "-q"][..], &site].concat()).ok();
    let all = ["/bootstrap", "/influence", "/disaggregation", "/efficiency", "/sufficiency", "/structures"];
    assert_eq!(additions(&study), all);
    let array = |name: &str| {
        let reader = uplift_labelled::LabelledReader::open(&study.path().join("r.h5")).unwrap();
        reader.array::<f64>(name).unwrap()
    };
    let before = array("/influence/pgv/u_without_m");
    // bands alone depend on [bootstrap]
    run(&["--set", "bootstrap.replicates=30"]);
    assert_eq!(additions(&study), all[1..]);
    assert_eq!(array("/influence/pgv/u_without_m"), before);
    study.uplift(&["verify", "r.h5", "-q"]).ok();
    study.uplift(&["influence", "r.h5", "-q"]).ok();
    // where nothing is repaired, only answers about structures quote the consistency
    let settings = ["--set", "bootstrap.replicates=30", "--set", "consistency.least_effective=2"];
    run(&settings);
    assert_eq!(additions(&study), all[1..5]);
    // with repaired spectra, influence depends on it too
    run(&[&settings[..], &["--set", "consistency.repair=\"weights\""]].concat());
    assert_eq!(additions(&study), all[3..5]);
    // other spectra leave nothing
    run(&["--force", "--set", "risk.years=100"]);
    assert_eq!(additions(&study), all[..0]);
}

/// A repair that a command added stays where the study does not ask for one.
#[test]
fn an_added_repair_survives_another_bootstrap_setting() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&["consistency", "r.h5", "--repair", "-q"]).ok();
    let repaired = || {
        let reader = uplift_labelled::LabelledReader::open(&study.path().join("r.h5")).unwrap();
        reader.children("/consistency/pgv").unwrap()
    };
    let before = repaired();
    assert!(before.iter().any(|name| name == "u_m"), "{before:?}");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--set", "bootstrap.replicates=30"]).ok();
    assert_eq!(repaired(), before);
    study.uplift(&["verify", "r.h5", "-q"]).ok();
}
