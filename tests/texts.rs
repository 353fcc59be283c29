//! Text from files does not command the terminal, the spreadsheet or the browser, and what is no file is not read.

use std::time::{Duration, Instant};

use crate::common::{SMALL_STUDY, SmallStudy, command};

/// Erases the screen; the second in one character.
const COMMANDS: &str = "\u{1b}[2J\u{9b}2J\u{202e}";

#[test]
fn a_terminal_is_not_commanded() {
    let title = "small\\u001b[2J\\u009b2J\\u202e\\nsecond line";
    let study = SmallStudy::with(&SMALL_STUDY.replace("\"small\"", &format!("\"{title}\"")));
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let clean = |text: &str| !text.contains(['\u{1b}', '\u{9b}', '\u{202e}']);
    for arguments in [&["status", "r.h5"][..], &["run", "study.toml", "-o", "r.h5", "--json"], &["table", "r.h5"]] {
        let done = study.uplift(arguments).ok();
        assert!(clean(&done.stdout) && clean(&done.stderr), "{arguments:?}:\n{}{}", done.stdout, done.stderr);
    }
    let status = study.uplift(&["status", "r.h5"]).ok().stdout;
    assert!(status.contains("small\\u{1b}[2J\\u{9b}2J\\u{202e}\\u{a}second line"), "{status}");
    // a program gets the title as it is
    let json = study.uplift(&["run", "study.toml", "-o", "r.h5", "--json"]).ok().stdout;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["title"], format!("small{COMMANDS}\nsecond line"));
    // names of files, and the lines of a file that an error shows
    let name = format!("no{COMMANDS}.toml");
    let refused = study.uplift(&["run", &name]).fails(3, &["no\\u{1b}[2J"]);
    assert!(clean(&refused.stderr), "{}", refused.stderr);
    study.write(&name, &format!("title = 3 # {COMMANDS}\n"));
    let refused = study.uplift(&["run", &name]).fails(3, &["\\u{1b}[2J"]);
    assert!(clean(&refused.stderr), "{}", refused.stderr);
    study.write("curve.csv", &format!("iml,maf\n{COMMANDS},1\n"));
    let refused = study.uplift(&["hazard", "show", "curve.csv", "--measure", "PGV", "--unit", "cm/s"]);
    assert!(refused.code == 4 && clean(&refused.stderr), "{}", refused.stderr);
}

#[test]
fn a_spreadsheet_computes_nothing_and_a_page_runs_nothing() {
    let name = "=HYPERLINK(1)&'x'";
    let text =
        SMALL_STUDY.replace("\"Here\"", &format!("\"{name}\"")).replace("\"small\"", "\"<script>x</script>\\u001b\"");
    let study = SmallStudy::with(&text);
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    study.uplift(&["export", "r.h5", "--csv"]).ok();
    study.uplift(&["report", "r.h5"]).ok();
    study.uplift(&["plot", "r.h5", "--only", "urs-pgv", "--format", "both"]).ok();
    let read = |name: &str| std::fs::read_to_string(study.path().join(name)).unwrap();
    for table in ["r.urs.csv", "r.regression.csv", "r.spectra.csv"] {
        let rows = read(table);
        assert!(rows.lines().skip(1).any(|line| line.starts_with("'=HYPERLINK(1)")), "{rows}");
        assert!(!rows.lines().any(|line| line.starts_with('=') || line.contains(",=")), "{rows}");
    }
    for file in ["r.html", "r.figures/urs-pgv.svg"] {
        let text = read(file);
        assert!(!text.contains("<script>x") && !text.contains('\u{1b}'), "{file}");
        assert!(text.contains("HYPERLINK(1)&amp;"), "{file}");
    }
}

#[test]
fn a_null_character_is_a_mistake_before_the_run() {
    let study = SmallStudy::with(&SMALL_STUDY.replace("\"small\"", "\"small\\u0000\""));
    study.uplift(&["run", "study.toml"]).fails(3, &["title", "null character"]);
    study.write("study.toml", SMALL_STUDY);
    let curve = std::fs::read_to_string(study.path().join("pga.csv")).unwrap();
    study.write("pga.csv", &curve.replace("a power law", "a power\0 law"));
    let refused = study.uplift(&["run", "study.toml"]).fails(4, &["pga.csv", "null character"]);
    assert!(!refused.stderr.contains("analyses"), "{}", refused.stderr);
    study.write("pga.csv", &curve);
    study.uplift(&["records", "synthesize", "-o", "set", "--count", "2"]).ok();
    let manifest = std::fs::read_to_string(study.path().join("set/manifest.csv")).unwrap();
    study.write("set/manifest.csv", &manifest.replace("SYN002,", "SYN002\0,"));
    study
        .uplift(&["check", "study.toml", "--set", "records.manifest=set/manifest.csv"])
        .fails(4, &["SYN002", "null character"]);
}

#[cfg(unix)]
#[test]
fn only_files_are_read() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let pipe = study.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for input in ["pipe", "/dev/zero", "."] {
        let manifest = format!("records.manifest={input}");
        for arguments in [
            &["run", input][..],
            &["check", "study.toml", "--set", &manifest],
            &["status", input],
            &["verify", input],
            &["bootstrap", input],
            &["export", input, "--csv"],
            &["report", input],
            &["design", input, "--urs", "r.h5"],
            &["response", input, "--strength", "0.1"],
            &["records", "show", input],
            &["records", "list", input],
            &["hazard", "show", input],
            &["table", "r.h5", "--reference", input],
            &["merge", "study.toml", input],
        ] {
            let mut run = command(study.path()).args(arguments).stderr(std::process::Stdio::null()).spawn().unwrap();
            let begin = Instant::now();
            let status = loop {
                match run.try_wait().unwrap() {
                    Some(status) => break status,
                    None if begin.elapsed() > Duration::from_secs(60) => {
                        run.kill().unwrap();
                        panic!("{arguments:?} waits");
                    }
                    None => std::thread::sleep(Duration::from_millis(5)),
                }
            };
            // the results of a folder are listed
            let expected = if arguments == ["status", "."] { 0..=0 } else { 2..=4 };
            assert!(status.code().is_some_and(|code| expected.contains(&code)), "{arguments:?}: {status}");
        }
    }
}

// What a manifest says in letters that a spreadsheet would compute comes back as it was.
#[test]
fn an_import_writes_what_a_study_reads() {
    let study = SmallStudy::new();
    study.uplift(&["records", "synthesize", "-o", "set", "--count", "2"]).ok();
    std::fs::rename(study.path().join("set"), study.path().join("@set")).unwrap();
    study.uplift(&["records", "import", "@set", "-o", "m.csv", "--no-pulses"]).ok();
    let manifest = std::fs::read_to_string(study.path().join("m.csv")).unwrap();
    assert!(manifest.contains(",'@set/"), "{manifest}");
    study.uplift(&["check", "study.toml", "--set", "records.manifest=m.csv", "--set", "records.first=2"]).ok();
    study.uplift(&["records", "select", "m.csv", "--pga-g", "0:9", "-o", "some.csv"]).ok();
    study.uplift(&["records", "list", "some.csv"]).ok();
}
