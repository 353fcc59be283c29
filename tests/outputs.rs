//! Nothing is overwritten unasked: whatever a command writes, what is there stays unless it is an earlier output of the
//! same kind, or `--force` is given; an input stays always.

use std::path::Path;

use uplift_labelled::LabelledWriter;

use crate::common::{SMALL_STUDY, SmallStudy};

/// A study with a result, `r.h5`, and two records.
fn study() -> SmallStudy {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    study.uplift(&["records", "synthesize", "-o", "set", "--count", "2"]).ok();
    study
}

/// The command fails, names `place` and `word`, and leaves what is there.
fn refused(study: &SmallStudy, command: &[&str], place: &str, word: &str) {
    let path = study.path().join(place);
    let before = std::fs::read(&path).unwrap();
    study.uplift(command).fails(2, &[place, word]);
    assert_eq!(std::fs::read(&path).unwrap(), before, "{command:?}");
}

#[test]
fn a_name_says_what_is_written() {
    let study = study();
    for (command, place, word) in [
        (&["run", "study.toml", "-o", "study.toml"][..], "study.toml", "ends in .h5"),
        (&["export", "r.h5", "--mat", "-o", "study.toml", "--force"], "study.toml", "ends in .mat, e.g. study.mat"),
        (&["export", "r.h5", "--csv", "-o", "r.h5", "--force"], "r.h5", "ends in .csv"),
        (&["export", "r.h5", "--xlsx", "-o", "pga.csv", "--force"], "pga.csv", "ends in .xlsx, e.g. pga.xlsx"),
        (&["export", "r.h5", "--json", "-o", "pga.csv", "--force"], "pga.csv", "ends in .json"),
        (&["report", "r.h5", "-o", "study.toml"], "study.toml", "ends in .html"),
        (&["response", "set/SYN001_H1.AT2", "--strength", "0.2", "--history", "study.toml"], "study.toml", ".csv"),
        (&["hazard", "plot", "pga.csv", "-o", "pga.csv"], "pga.csv", ".svg or .png"),
    ] {
        refused(&study, command, place, word);
    }
    for (command, word) in [
        (&["run", "study.toml", "--shard", "1/2", "-o", "part.csv"][..], "does not end in .csv"),
        (&["plot", "r.h5", "-o", "x.svg"], "write -o x"),
        (&["records", "synthesize", "-o", "new.CSV", "--count", "2"], "give a name without .csv"),
        (&["pulse", "-o", "new.html"], "write -o new"),
    ] {
        study.uplift(command).fails(2, &[word]);
    }
    study.write("file", "");
    for command in [
        &["run", "study.toml", "-o", "file/r.h5"][..],
        &["sweep", "study.toml", "--over", "seed=1,2", "-o", "file/x"],
        &["init", "file/x"],
        &["run", "study.toml", "--shard", "1/2", "-o", "file/x/part"],
    ] {
        let said = study.uplift(command).fails(4, &["a part of the path is a file, not a folder"]).stderr;
        assert!(!said.contains("os error"), "{said}");
    }
    for name in ["part.csv", "x.svg", "new.CSV", "new.html"] {
        assert!(!study.path().join(name).exists(), "{name}");
    }
    study.uplift(&["run", "study.toml", "--set", "output.file=x.txt"]).fails(3, &["x.txt", ".h5"]);
}

// One of each command, onto a file of somebody else, and again onto its own.
#[test]
#[ignore = "long: make test-long"]
fn what_others_wrote_is_left_alone() {
    let study = study();
    let response = ["response", "set/SYN001_H1.AT2", "--strength", "0.2"];
    let with = |more: &[&'static str]| [&response[..], more].concat();
    let commands: [(Vec<&str>, &str); 13] = [
        (vec!["export", "r.h5", "--csv"], "r.spectra.csv"),
        (vec!["export", "r.h5", "--csv"], "r.spectra.csv-metadata.json"),
        (vec!["export", "r.h5", "--xlsx"], "r.xlsx"),
        (vec!["export", "r.h5", "--json"], "r.json"),
        (vec!["export", "r.h5", "--mat"], "r.mat"),
        (vec!["report", "r.h5"], "r.html"),
        (vec!["plot", "r.h5", "--only", "urs-pgv"], "r.figures/urs-pgv.svg"),
        (vec!["measures", "r.h5"], "r.measures.csv"),
        (vec!["influence", "r.h5"], "r.influence.csv"),
        (vec!["bootstrap", "r.h5", "--replicates", "20", "--sizes", "2"], "r.bands.csv"),
        (vec!["hazard", "plot", "pga.csv", "--measure", "PGA", "--unit", "g", "-o", "curves.svg"], "curves.svg"),
        (with(&["--history", "history.csv"]), "history.csv"),
        (with(&["--plot", "history.svg"]), "history.svg"),
    ];
    for (command, place) in &commands {
        let path = study.path().join(place);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, "notes on uplift of mine\n").unwrap();
        refused(&study, command, place, "--force");
        study.uplift(&[&command[..], &["--force"]].concat()).ok();
        assert_ne!(std::fs::read(&path).unwrap(), b"notes on uplift of mine\n", "{command:?}");
        study.uplift(command).ok();
    }
    // the tables of a run too, before anything is computed
    study.write("r.urs.csv", "mine\n");
    refused(&study, &["run", "study.toml", "-o", "r.h5", "--again"], "r.urs.csv", "--force");
    study.uplift(&["run", "study.toml", "-o", "r.h5", "--again", "--force"]).ok();
    // and what is of another result
    study.uplift(&["run", "study.toml", "-o", "other.h5"]).ok();
    refused(&study, &["export", "other.h5", "--csv", "-o", "r.spectra.csv"], "r.spectra.csv", "not of other.h5");
}

#[test]
fn an_input_is_never_overwritten() {
    let study = study();
    // a hazard curve where a table of the result would be
    let curve = std::fs::read_to_string(study.path().join("pga.csv")).unwrap();
    study.write("q.urs.csv", &curve);
    study.write("study.toml", &SMALL_STUDY.replace("\"pga.csv\"", "\"q.urs.csv\""));
    let run = ["run", "study.toml", "-o", "q.h5", "--force"];
    refused(&study, &run, "q.urs.csv", "would overwrite an input");
    let select = ["records", "select", "set/manifest.csv", "--magnitude", "1:9", "--force", "-o", "set/manifest.csv"];
    refused(&study, &select, "set/manifest.csv", "would overwrite an input");
    let (record, copy) = (study.path().join("set/SYN001_H1.AT2"), study.path().join("set/r.csv"));
    std::fs::hard_link(&record, &copy).unwrap();
    let response = ["response", "set/SYN001_H1.AT2", "--strength", "0.2", "--force", "--history", "set/r.csv"];
    refused(&study, &response, "set/r.csv", "would overwrite an input");
}

#[test]
fn a_result_is_overwritten_only_by_its_own_study() {
    let study = study();
    let changed = SMALL_STUDY.replace("first = 4", "first = 3");
    // edited, or renamed: it is that study
    study.write("study.toml", &changed);
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    study.write("same.toml", &changed);
    study.uplift(&["run", "same.toml", "--again", "-o", "r.h5"]).ok();
    // another one
    study
        .write("b.toml", &changed.replace("title = \"small\"", "title = \"b\"").replace("values = [0, ", "values = ["));
    refused(&study, &["run", "b.toml", "-o", "r.h5"], "r.h5", "the result of another study (same.toml)");
    study.uplift(&["run", "b.toml", "-o", "r.h5", "--force"]).ok();
    // at the place that its own name gives too
    study.uplift(&["run", "study.toml", "-o", "results/b.h5"]).ok();
    refused(&study, &["run", "b.toml"], "results/b.h5", "the result of another study (study.toml)");
    study.uplift(&["run", "b.toml", "--force"]).ok();
}

#[test]
fn other_values_than_the_file_s_replace_nothing_unasked() {
    let study = study();
    let run = ["run", "study.toml", "-o", "r.h5"];
    let fewer = [&run[..], &["--set", "records.first=3"]].concat();
    refused(&study, &fewer, "r.h5", "of this study without --set, this run is with --set records.first=3");
    let check = study.uplift(&["check", "study.toml"]).ok();
    assert!(!check.stdout.contains("--force"), "{}", check.stdout);
    study.uplift(&[&fewer[..], &["--force"]].concat()).ok();
    study.uplift(&fewer).ok();
    let status = study.uplift(&["status", "r.h5"]).ok().stdout;
    assert!(status.contains("--set records.first=3"), "{status}");
    refused(&study, &run, "r.h5", "with --set records.first=3, this run is without --set");
    // what changes no number is no other result
    study.uplift(&[&fewer[..], &["--set", "title=\"another\""]].concat()).ok();
    // a check tells what a run would cost, and is refused as the run is
    study.uplift(&["run", "study.toml", "--set", "records.first=3"]).ok();
    for quiet in [&[][..], &["-q"]] {
        let [check, run] = ["check", "run"].map(|of| study.uplift(&[&[of, "study.toml"], quiet].concat()));
        let words = ["results/study.h5 is the result of this study with --set"];
        let (check, run) = (check.fails(2, &words), run.fails(2, &words));
        assert!(check.stdout.starts_with("A run would be refused"), "{}", check.stdout);
        assert_eq!(check.stderr.lines().last(), run.stderr.lines().last());
    }
    study.uplift(&["check", "study.toml", "--json"]).fails(2, &["--force"]);
    study.uplift(&["check", "study.toml", "--set", "output.file=free.h5"]).ok();
}

/// Names of the files in a folder, in order.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        folder.read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

// A result that is replaced takes with it what was made of it; nothing stale is left, and nothing computed is lost.
#[test]
#[ignore = "long: make test-long"]
fn what_was_made_of_a_replaced_result_goes_with_it() {
    let study = study();
    let run = ["run", "study.toml", "-o", "r.h5"];
    for made in [
        &["bootstrap", "r.h5", "--replicates", "20", "--sizes", "2"][..],
        &["influence", "r.h5"],
        &["measures", "r.h5"],
        &["export", "r.h5", "--csv", "--json", "--mat", "--xlsx"],
        &["plot", "r.h5", "--only", "urs-pgv"],
        &["report", "r.h5"],
    ] {
        study.uplift(made).ok();
    }
    study.write("r.notes.csv", "what I think of uplift; r.h5\n");
    study.write("r.mine.json", "{\"note\": \"uplift gave results/r.h5, my own remarks\"}\n");
    let digest = |name: &str| {
        let status = study.uplift(&["status", name]).ok().stdout;
        let line = status.lines().find_map(|line| line.trim().strip_prefix("digest"));
        line.unwrap().trim().to_owned()
    };
    let (first, before) = (digest("r.h5"), std::fs::read(study.path().join("r.h5")).unwrap());
    for table in ["r.urs.csv", "r.bands.csv", "r.influence.csv", "r.measures.csv", "r.json", "r.mat", "r.html"] {
        let says = if study.path().join(format!("{table}-metadata.json")).exists() {
            format!("{table}-metadata.json")
        } else {
            table.to_owned()
        };
        let text = String::from_utf8_lossy(&std::fs::read(study.path().join(says)).unwrap()).replace('\0', "");
        assert!(text.contains(&format!("study digest {first}")), "{table}");
    }
    // another run of the same numbers: the tables are of it still, and the bands that were in the file are kept
    study.uplift(&[&run[..], &["--again"]].concat()).ok();
    assert_eq!(digest("r.h5"), first);
    let earlier = study.path().join("r.earlier").join(&first);
    assert_eq!(names(&earlier), ["r.h5"]);
    assert_eq!(std::fs::read(earlier.join("r.h5")).unwrap(), before);
    assert!(study.path().join("r.bands.csv").exists());
    // and one of others: what was kept before stays as it is
    study.write("study.toml", &SMALL_STUDY.replace("first = 4", "first = 3"));
    let said = study.uplift(&run).ok().stderr;
    assert!(said.contains("r.earlier"), "{said}");
    assert_eq!(std::fs::read(earlier.join("r.h5")).unwrap(), before);
    let earlier = study.path().join("r.earlier").join(format!("{first}-2"));
    let tables = ["bands", "influence", "measures", "regression", "spectra", "table-4-1", "urs"];
    let tables = tables.iter().flat_map(|name| ["csv", "csv-metadata.json"].map(|end| format!("r.{name}.{end}")));
    let mut kept: Vec<String> = ["figures", "h5", "html", "json", "mat", "xlsx"].map(|end| format!("r.{end}")).into();
    kept.extend(tables);
    kept.sort();
    assert_eq!(names(&earlier), kept);
    assert_eq!(names(&earlier.join("r.figures")), ["urs-pgv.svg"]);
    let left = names(study.path());
    let own = ["r.h5", "r.urs.csv", "r.urs.csv-metadata.json", "r.regression.csv", "r.regression.csv-metadata.json"];
    for name in &kept {
        assert_eq!(left.contains(name), own.contains(&name.as_str()), "{name}");
    }
    // and what somebody else wrote
    assert!(left.iter().any(|name| name == "r.notes.csv") && left.iter().any(|name| name == "r.mine.json"));
    assert_ne!(digest("r.h5"), first);
    // what is put back beside another result is seen
    for name in ["r.bands.csv", "r.bands.csv-metadata.json"] {
        std::fs::copy(earlier.join(name), study.path().join(name)).unwrap();
    }
    let status = study.uplift(&["status", "r.h5"]).ok().stdout;
    assert!(status.contains("not of it: r.bands.csv"), "{status}");
    // and by whoever takes numbers of the result
    for command in [&["table", "r.h5"][..], &["report", "r.h5"], &["export", "r.h5", "--json"], &["plot", "r.h5"]] {
        let said = study.uplift(command).ok().stderr;
        assert!(said.contains("r.bands.csv beside r.h5 is from another result of that name"), "{command:?}: {said}");
    }
    std::fs::remove_file(study.path().join("r.bands.csv")).unwrap();
    std::fs::remove_file(study.path().join("r.bands.csv-metadata.json")).unwrap();
    let said = study.uplift(&["table", "r.h5"]).ok().stderr;
    assert!(!said.contains("another result"), "{said}");
}

// The new result is in its place, and what was made of the earlier one beside it still, as a kill between leaves them.
#[test]
fn what_a_killed_run_left_goes_to_the_result_that_it_is_of() {
    let study = study();
    let run = ["run", "study.toml", "-o", "r.h5", "-q"];
    study.uplift(&["export", "r.h5", "--csv", "-q"]).ok();
    let first = digest(&study, "r.h5");
    let tables = ["r.spectra.csv", "r.spectra.csv-metadata.json"];
    let kept: Vec<Vec<u8>> = tables.map(|name| std::fs::read(study.path().join(name)).unwrap()).into();
    study.write("study.toml", &SMALL_STUDY.replace("first = 4", "first = 3"));
    study.uplift(&run).ok();
    let second = digest(&study, "r.h5");
    for (name, bytes) in tables.iter().zip(&kept) {
        study.write_bytes(name, bytes);
    }
    // of the second nothing was made but its own tables, which are written again
    study.write("study.toml", &SMALL_STUDY.replace("first = 4", "first = 2"));
    study.uplift(&run).ok();
    let earlier = study.path().join("r.earlier");
    assert_eq!(names(&earlier.join(format!("{first}-2"))), tables);
    assert!(!names(&earlier.join(&second)).contains(&"r.spectra.csv".to_owned()));
}

#[test]
fn a_page_of_several_results_says_of_which() {
    let study = study();
    study.uplift(&["run", "study.toml", "-o", "b.h5", "-q", "--set", "records.first=3"]).ok();
    study.uplift(&["report", "r.h5", "b.h5", "-q"]).ok();
    let page = std::fs::read_to_string(study.path().join("r.html")).unwrap();
    let head = page.split("</head>").next().unwrap();
    for name in ["r.h5", "b.h5"] {
        let words = format!("; {name}; study digest {}", digest(&study, name));
        assert!(head.contains(&words), "{words}: {head:.600}");
    }
}

#[test]
fn a_file_where_earlier_results_go_is_found_before_anything_is_computed() {
    let study = study();
    study.write("n.earlier", "notes of mine\n");
    study.uplift(&["check", "study.toml", "--set", "output.file=n.h5"]).fails(2, &["n.earlier is a file", "n.h5"]);
    refused(&study, &["run", "study.toml", "-o", "n.h5"], "n.earlier", "rename that file");
    refused(&study, &["run", "study.toml", "-o", "n.h5", "--force"], "n.earlier", "rename that file");
}

/// What the numbers of a result of the study are known by.
fn digest(study: &SmallStudy, result: &str) -> String {
    let status = study.uplift(&["status", result]).ok().stdout;
    let words = status.split("digest").nth(1).unwrap();
    words.split_whitespace().next().unwrap().to_owned()
}

// A damaged byte that no table of a page needs.
#[test]
fn no_page_is_made_of_a_damaged_result() {
    let study = study();
    let path = study.path().join("r.h5");
    let sound = std::fs::read(&path).unwrap();
    for tenth in [3, 5, 7] {
        let mut damaged = sound.clone();
        damaged[sound.len() * tenth / 10] ^= 4;
        std::fs::write(&path, &damaged).unwrap();
        study.uplift(&["verify", "r.h5"]).fails(4, &["r.h5"]);
        study.uplift(&["report", "r.h5"]).fails(4, &["r.h5", "damaged"]);
    }
    // it is replaced, and kept for whoever wants to save something of it
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    assert_eq!(names(&study.path().join("r.earlier/damaged")), ["r.h5"]);
}

// A result of a program whose layout is another: it cannot be read here, and is kept whole.
#[test]
fn a_result_of_another_layout_is_kept_by_its_number() {
    let study = study();
    let path = study.path().join("r.h5");
    let mut writer = LabelledWriter::create(&path).unwrap();
    writer.attribute("/", "program", "uplift").unwrap();
    writer.attribute("/", "layout", 7_i64).unwrap();
    writer.finish().unwrap();
    let theirs = std::fs::read(&path).unwrap();
    study.uplift(&["table", "r.h5"]).fails(4, &["layout 7"]);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--force"]).ok();
    assert_eq!(std::fs::read(study.path().join("r.earlier/layout-7/r.h5")).unwrap(), theirs);
    study.uplift(&["verify", "r.h5"]).ok();
}

#[cfg(unix)]
#[test]
fn who_may_read_a_result_stays_the_same() {
    use std::os::unix::fs::PermissionsExt;
    let study = study();
    let mode = |name: &str| study.path().join(name).metadata().unwrap().permissions().mode() & 0o777;
    for name in ["r.h5", "r.urs.csv"] {
        std::fs::set_permissions(study.path().join(name), PermissionsExt::from_mode(0o600)).unwrap();
    }
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    study.uplift(&["measures", "r.h5"]).ok();
    assert_eq!([mode("r.h5"), mode("r.urs.csv")], [0o600, 0o600]);
}

#[test]
fn leftovers_of_the_killed_go_with_the_next_writing() {
    let study = study();
    let hidden = |study: &SmallStudy| {
        let names = study.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.contains(".partial-")).collect::<Vec<_>>()
    };
    // as a writer leaves it that is killed
    let report = ["report", "r.h5"];
    study.uplift(&report).ok();
    let partial = uplift_partial_name(study.path(), "r.html");
    std::fs::write(&partial, "half a page").unwrap();
    assert_eq!(hidden(&study).len(), 1);
    study.uplift(&report).ok();
    assert!(hidden(&study).is_empty(), "{:?}", hidden(&study));
}

/// The hidden file that a writer of `name` in `folder` has on this machine.
fn uplift_partial_name(folder: &Path, name: &str) -> std::path::PathBuf {
    uplift_atomic_file::AtomicFile::reserve(&folder.join(name)).unwrap().partial().to_owned()
}

// Two studies of one file name, typed alike in two folders: the result of the one is not the other's.
#[test]
fn a_result_of_another_study_stays() {
    let (one, other) = (SmallStudy::new(), SmallStudy::with(&SMALL_STUDY.replace("\"small\"", "\"another\"")));
    let place = one.path().join("r.h5");
    let run = ["run", "study.toml", "-o", place.to_str().unwrap()];
    one.uplift(&run).ok();
    other.uplift(&run).fails(2, &["is the result of another study", "--force"]);
    let untitled = SmallStudy::with(&SMALL_STUDY.replace("title = \"small\"", "").replace("first = 4", "first = 3"));
    untitled.uplift(&run).fails(2, &["is the result of another study"]);
    // the study itself, edited
    one.write("study.toml", &SMALL_STUDY.replace("first = 4", "first = 3"));
    one.uplift(&run).ok();
}

#[test]
fn a_table_is_overwritten_only_by_the_same_table() {
    let study = study();
    study.uplift(&["influence", "r.h5"]).ok();
    study.uplift(&["bootstrap", "r.h5", "--replicates", "20", "--sizes", "2"]).ok();
    for table in ["r.urs.csv", "r.regression.csv", "r.influence.csv", "r.bands.csv", "r.table-4-1.csv"] {
        refused(&study, &["export", "r.h5", "--csv", "-o", table], table, "already exists");
    }
}

#[test]
fn no_input_is_replaced_even_if_it_is_forced() {
    let study = study();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("pga.csv", study.path().join("link.h5")).unwrap();
        refused(&study, &["run", "study.toml", "-o", "link.h5", "--force"], "link.h5", "an input");
    }
    let record = "set/SYN001_H1.AT2";
    std::fs::rename(study.path().join(record), study.path().join("set/a.csv")).unwrap();
    let manifest = std::fs::read_to_string(study.path().join("set/manifest.csv")).unwrap();
    study.write("set/manifest.csv", &manifest.replace("SYN001_H1.AT2", "a.csv"));
    let select = ["records", "select", "set/manifest.csv", "--pga-g", "0:9", "-o", "set/a.csv", "--force"];
    refused(&study, &select, "set/a.csv", "an input");
    // and records that a manifest elsewhere may name
    std::fs::rename(study.path().join("set/manifest.csv"), study.path().join("set/mine.csv")).unwrap();
    let again = ["records", "synthesize", "-o", "set", "--count", "2", "--seed", "9"];
    refused(&study, &again, "set/SYN001_H2.AT2", "studies may use it");
}

/// Of a larger set that is replaced nothing is left, but files that the program did not make, or that have another
/// name, and all where the manifest is not its own.
#[test]
fn a_replaced_set_of_synthetic_records_leaves_nothing() {
    let study = SmallStudy::new();
    let make = |count: &str| {
        study.uplift(&["records", "synthesize", "-o", "set", "--count", count, "-q", "--force"]).ok();
    };
    let at = |name: &str| study.path().join("set").join(name);
    let left = |names: [&str; 3]| names.map(|name| at(name).exists());
    make("2");
    study.write("set/SYN002_H1.AT2", "mine");
    make("1");
    assert_eq!(left(["SYN001_H1.AT2", "SYN002_H1.AT2", "SYN002_H2.AT2"]), [true, true, false]);
    make("3");
    std::fs::rename(at("SYN003_H1.AT2"), at("mine.AT2")).unwrap();
    let manifest = std::fs::read_to_string(at("manifest.csv")).unwrap();
    study.write("set/manifest.csv", &manifest.replace("SYN003_H1.AT2", "mine.AT2"));
    make("1");
    assert_eq!(left(["mine.AT2", "SYN003_H2.AT2", "SYN002_H1.AT2"]), [true, false, false]);
    make("2");
    study.write("set/manifest.csv", manifest.split_once('\n').unwrap().1);
    make("1");
    assert!(at("SYN002_H1.AT2").exists());
}

// HDF5 locks what it opens where the environment has it do so, and so do writers here.
#[test]
fn the_lock_of_hdf5_and_that_of_a_writer_do_not_meet() {
    for word in ["TRUE", "BEST_EFFORT", "FALSE"] {
        let study = SmallStudy::new();
        for arguments in [&["run", "study.toml", "-o", "r.h5"][..], &["influence", "r.h5"], &["verify", "r.h5"]] {
            let mut program = crate::common::command(study.path());
            let done = program.args(arguments).env("HDF5_USE_FILE_LOCKING", word).output().unwrap();
            assert!(done.status.success(), "{word}: {}", String::from_utf8_lossy(&done.stderr));
        }
    }
}
