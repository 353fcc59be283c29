//! Displacement spectra that are stopped, cut into shards and gone on with: the numbers are those of an undisturbed
//! run.

use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use uplift_labelled::LabelledReader;

use crate::common::{SmallStudy, command};

/// Oscillators of both kinds, and their design example.
const OSCILLATORS: &str = r#"kind = "displacement spectra"
title = "few"
[records.synthetic]
pairs = 3
[scaling]
to = ["unscaled", "2 PGA", "4 PGV"]
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
/// Blocks, and their design example.
const BLOCKS: &str = r#"kind = "displacement spectra"
title = "blocks"
[records.synthetic]
pairs = 3
[scaling]
to = ["1 PGV", "unscaled"]
[block]
height_m = [0.5, 1000]
[slenderness]
values = [0.02, "0.05:0.05:0.3"]
[design]
height_m = 2
noise_points = 3
"#;

/// Every array of a result, to the bit, and what it says of its records.
fn content(path: &Path) -> Vec<(String, Vec<u64>)> {
    let reader = LabelledReader::open(path).unwrap();
    let mut found = vec![(reader.attribute::<String>("/", "warnings").unwrap(), Vec::new())];
    for group in ["/spectra", "/sets/synthetic", "/design"] {
        for name in reader.children(group).unwrap() {
            if let Ok(array) = reader.array::<f64>(&format!("{group}/{name}")) {
                found.push((format!("{group}/{name}"), array.values.iter().map(|value| value.to_bits()).collect()));
            }
        }
    }
    assert!(found.len() > 12, "{found:?}");
    found
}

fn left(folder: &Path) -> Vec<String> {
    let names =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.contains(".part") || name.contains("shard")).collect();
    names.sort();
    names
}

#[test]
#[ignore = "long: make test-long"]
fn shards_make_the_same_result() {
    for text in [OSCILLATORS, BLOCKS] {
        let study = SmallStudy::with(text);
        study.uplift(&["run", "study.toml", "-o", "whole.h5", "-q"]).ok();
        let whole = content(&study.path().join("whole.h5"));
        let files: Vec<String> = (1..=3).map(|shard| format!("results/study.shard-{shard}-of-3")).collect();
        for shard in ["3/3", "1/3", "2/3"] {
            let done = study.uplift(&["run", "study.toml", "--shard", shard, "--threads", "2"]).ok();
            assert!(done.stdout.contains("analysis rows: "), "{}", done.stdout);
        }
        let status = study.uplift(&["status", &files[1]]).ok().stdout;
        assert!(status.contains("shard 2 of 3") && status.contains("(100 %)"), "{status}");
        let all: Vec<&str> = files.iter().map(String::as_str).collect();
        let merged = study.uplift(&[&["merge", "study.toml", "-o", "merged.h5"][..], &all].concat()).ok();
        assert!(merged.stderr.contains("analysis rows of 3 shards"), "{}", merged.stderr);
        assert_eq!(content(&study.path().join("merged.h5")), whole);
        // one that is missing or of other work is named
        study.uplift(&["merge", "study.toml", all[0], all[2]]).fails(4, &["1 shard missing: 2/3"]);
        let other = ["run", "study.toml", "--shard", "1/3", "-o", "foreign", "--set", "records.synthetic.seed=2"];
        study.uplift(&other).ok();
        study.uplift(&["merge", "study.toml", "foreign", all[1], all[2]]).fails(4, &["foreign", "other work"]);
        // one that was cut off is gone on with
        let bytes = std::fs::read(study.path().join(all[0])).unwrap();
        let head = bytes.iter().position(|byte| *byte == b'\n').unwrap() + 1;
        study.write_bytes(all[0], &bytes[..head + 500]);
        study.uplift(&[&["merge", "study.toml"][..], &all].concat()).fails(4, &["analysis rows", "--shard 1/3"]);
        study.uplift(&["run", "study.toml", "--shard", "1/3", "-q"]).ok();
        study.uplift(&[&["merge", "study.toml", "-o", "again.h5", "-q"][..], &all].concat()).ok();
        assert_eq!(content(&study.path().join("again.h5")), whole);
        assert!(!left(study.path()).iter().any(|name| name.contains(".part")), "{:?}", left(study.path()));
    }
}

/// A checkpoint as it is at any moment of a run: every row of the whole, and any first part of them.
#[test]
#[ignore = "long: make test-long"]
fn from_any_checkpoint_it_ends_with_the_same_bits() {
    for text in [OSCILLATORS, BLOCKS] {
        let study = SmallStudy::with(text);
        study.uplift(&["run", "study.toml", "-o", "whole.h5", "-q"]).ok();
        let whole = content(&study.path().join("whole.h5"));
        // the only shard of one has all rows, and is what the checkpoint of a run would be at its end
        study.uplift(&["run", "study.toml", "--shard", "1/1", "-o", "all", "-q"]).ok();
        let rows = std::fs::read(study.path().join("all")).unwrap();
        for share in [0, 1, 4, 7, 8] {
            study.write_bytes("r.h5.part", &rows[..rows.len() * share / 8]);
            // beside a whole result there would be nothing left to do
            std::fs::remove_file(study.path().join("r.h5")).ok();
            let threads = ["1", "3"][share % 2];
            let done = study.uplift(&["run", "study.toml", "-o", "r.h5", "--threads", threads]).ok();
            assert_eq!(done.stderr.contains("analyses resumed"), share > 0, "{share}: {}", done.stderr);
            assert_eq!(content(&study.path().join("r.h5")), whole, "{share}");
            assert!(left(study.path()).is_empty(), "{:?}", left(study.path()));
        }
    }
}

#[cfg(unix)]
#[test]
#[ignore = "long: make test-long"]
fn an_interrupted_run_says_so_and_resumes() {
    // a study of some seconds of work on one thread
    let text = OSCILLATORS.replace("pairs = 3", "pairs = 30").replace("0.1:0.1:0.3", "0.1:0.004:0.5");
    let study = SmallStudy::with(&text);
    let mut child = command(study.path())
        .args(["run", "study.toml", "-o", "r.h5", "--threads", "1"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let checkpoint = study.path().join("r.h5.part");
    let begin = Instant::now();
    while std::fs::metadata(&checkpoint).map_or(0, |file| file.len()) < 40_000 {
        assert!(begin.elapsed() < Duration::from_secs(60), "no checkpoint");
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(5));
    let mut said = String::new();
    std::io::Read::read_to_string(child.stderr.as_mut().unwrap(), &mut said).unwrap();
    assert!(said.contains("analyses are in the checkpoint") && said.contains("r.h5.part"), "{said}");
    let status = study.uplift(&["status", "r.h5"]).ok().stdout;
    assert!(status.contains("checkpoint of an unfinished run") && status.contains("few"), "{status}");
    let done = study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    assert!(done.stderr.contains("analyses resumed"), "{}", done.stderr);
    study.uplift(&["run", "study.toml", "-o", "fresh.h5", "-q", "--threads", "3"]).ok();
    assert_eq!(content(&study.path().join("r.h5")), content(&study.path().join("fresh.h5")));
}
