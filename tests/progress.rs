//! `--progress json`: what a program that starts this one is reported, and studies on standard input.

use std::io::Write;
use std::process::Stdio;

use serde_json::Value;

use crate::common::{SmallStudy, command};

/// The lines of standard error, each one event.
fn events(stderr: &str) -> Vec<Value> {
    stderr.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}"))).collect()
}

fn of_kind<'a>(events: &'a [Value], kind: &str) -> Vec<&'a Value> {
    events.iter().filter(|event| event["event"] == kind).collect()
}

#[test]
fn a_run_reports_its_phases_and_remarks() {
    let study = SmallStudy::new();
    let run = study.uplift(&["run", "study.toml", "-o", "r.h5", "--progress", "json", "--json"]).ok();
    let told = events(&run.stderr);
    // a phase begins, advances without going back, and ends where all is done
    let (begun, ended) = (of_kind(&told, "begin"), of_kind(&told, "end"));
    assert_eq!(begun.len(), 2);
    for (begin, end) in begun.iter().zip(&ended) {
        assert_eq!(begin["unit"], "analyses");
        assert!(begin["total"].as_u64().unwrap() > 0);
        assert_eq!((&end["done"], &end["total"]), (&begin["total"], &begin["total"]));
    }
    let done: Vec<u64> = of_kind(&told, "advance").iter().map(|event| event["done"].as_u64().unwrap()).collect();
    assert!(!done.is_empty() && done.iter().all(|done| *done > 0));
    assert!(of_kind(&told, "remark").iter().any(|event| event["topic"] == "records"));
    assert!(of_kind(&told, "checkpoint")[0]["path"].as_str().unwrap().ends_with("r.h5.part"));
    assert!(of_kind(&told, "error").is_empty());
    // the answer is the same as without
    let summary: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!(summary["files"][0], "r.h5");
    // a quiet command tells errors only
    let quiet = study.uplift(&["run", "study.toml", "-o", "q.h5", "--progress", "json", "-q"]).ok();
    assert_eq!(quiet.stderr, "");
}

#[test]
fn errors_are_events_with_all_their_mistakes() {
    let study = SmallStudy::new();
    let error = |arguments: &[&str], code: i32| {
        let run = study.uplift(&[arguments, &["--progress", "json"]].concat()).fails(code, &[]);
        let told = events(&run.stderr);
        let errors = of_kind(&told, "error");
        assert_eq!(errors.len(), 1, "{}", run.stderr);
        assert_eq!(errors[0]["exit_code"], code);
        errors[0].clone()
    };
    study.write("bad.toml", "[pgv]\n[records]\nfirst = -3\n[risk]\npoe = [2]\n");
    let found = error(&["run", "bad.toml", "--set", "risk.years=no"], 3);
    assert_eq!(found["kind"], "study");
    let mistakes = found["mistakes"].as_array().unwrap();
    let places: Vec<_> =
        mistakes.iter().map(|mistake| (&mistake["key"], &mistake["line"], &mistake["override"])).collect();
    let null = Value::Null;
    assert!(places.contains(&(&"records.first".into(), &3.into(), &null)), "{places:?}");
    assert!(places.contains(&(&"risk.poe[0]".into(), &5.into(), &null)), "{places:?}");
    assert!(places.contains(&(&"risk.years".into(), &null, &"risk.years=no".into())), "{places:?}");
    assert!(mistakes.iter().all(|mistake| !mistake["message"].as_str().unwrap().is_empty()));

    let swept = error(&["sweep", "study.toml", "--over", "records.first=-3,-2"], 3);
    let mistakes = swept["mistakes"].as_array().unwrap();
    assert!(swept["kind"] == "study" && mistakes.len() == 2, "{swept}");
    assert!(mistakes.iter().all(|mistake| mistake["message"].as_str().unwrap().contains("records.first")), "{swept}");

    let absent = error(&["run", "absent.toml"], 3);
    assert_eq!((&absent["kind"], &absent["reason"]), (&"file".into(), &"not found".into()));
    assert_eq!(error(&["table", "absent.h5"], 4)["kind"], "input");
    assert_eq!(
        error(&["plot", "study.toml", "--set", "strengths.values=0.1", "--only", "nothing"], 2)["kind"],
        "usage"
    );
    study.write("text.h5", "no result");
    assert_eq!(error(&["export", "text.h5", "--csv"], 4)["kind"], "input");
}

/// What a file says stays text: no line of its own, nothing that a terminal would obey.
#[test]
fn texts_of_files_do_not_break_the_lines() {
    let study = SmallStudy::new();
    study.write("bad.toml", "\"a\\u001b[2J\\u009b\\nb\" = 1\n[pgv]\n");
    let run = study.uplift(&["run", "bad.toml", "--progress", "json"]).fails(3, &[]);
    assert!(!run.stderr.contains(['\u{1b}', '\u{9b}']));
    let told = events(&run.stderr);
    assert_eq!(told.len(), 1);
    assert!(told[0]["mistakes"][0]["key"].as_str().unwrap().contains("\u{1b}[2J\u{9b}\nb"), "{}", run.stderr);
}

#[test]
fn a_study_on_standard_input_is_the_study_file() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "file.h5"]).ok();
    let text = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    let run = |text: &str, arguments: &[&str]| {
        let mut child = command(study.path())
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
        child.wait_with_output().unwrap()
    };
    assert!(run(&text, &["run", "-", "-o", "input.h5"]).status.success());
    let compare = |name: &str| {
        let reader = uplift_labelled::LabelledReader::open(&study.path().join(name)).unwrap();
        (reader.attribute::<String>("/", "study_toml").unwrap(), reader.array::<f64>("/urs/pgv/u_m").unwrap().values)
    };
    assert_eq!(compare("file.h5").1, compare("input.h5").1);
    // without a name of its own the result has that of any study
    assert!(run(&text, &["run", "-"]).status.success());
    assert!(study.path().join("results/study.h5").is_file());
    let wrong = run("[pgv]\nx = 1\n", &["run", "-"]);
    assert_eq!(wrong.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&wrong.stderr).contains("pgv.x"));
}
