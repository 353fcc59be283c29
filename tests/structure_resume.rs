//! Design, overturning and risk that are stopped, cut into shards and gone on with: the answer is that of an
//! undisturbed run.

use std::path::Path;

use crate::common::{SmallStudy, command};

const STUDY: &str = r#"title = "structures"
[records]
manifest = "manifest.csv"
[strengths]
values = [0.05, 0.1, 0.2, 0.4]
[pgv]
levels_cm_s = [1, 3, 10, 30, 60, 100, 200]
[[sites]]
name = "Here"
pgv = "here-pgv.csv"
"#;
const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 1000\n";
const JOBS: [&str; 3] = ["design", "overturning", "risk"];

fn study() -> SmallStudy {
    let study = SmallStudy::with(STUDY);
    study.uplift(&["records", "synthesize", "-o", "downloads", "--count", "4", "-q"]).ok();
    study.uplift(&["records", "import", "downloads", "-o", "manifest.csv", "-q"]).ok();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.write("block.toml", BLOCK);
    study
}

fn left(folder: &Path) -> Vec<String> {
    let names =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    names.filter(|name| name.contains(".part") || name.contains(".lock")).collect()
}

#[test]
#[ignore = "long: make test-long"]
fn shards_give_the_same_answer() {
    let study = study();
    for job in JOBS {
        let ask = [job, "block.toml", "--urs", "r.h5", "--json"];
        let whole = study.uplift(&ask).ok().stdout;
        for shard in ["2/3", "1/3", "3/3"] {
            let done = study.uplift(&[job, "block.toml", "--urs", "r.h5", "--shard", shard, "--threads", "2"]).ok();
            assert!(done.stdout.contains("analysis rows: "), "{}", done.stdout);
        }
        let files: Vec<String> = (1..=3).map(|shard| format!("r.h5.{job}-block.shard-{shard}-of-3")).collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let joined = study.uplift(&[&ask[..], &["--shards"], &files].concat()).ok();
        assert!(joined.stderr.contains("analyses resumed"), "{}", joined.stderr);
        assert_eq!(joined.stdout, whole);
        study.uplift(&[&ask[..], &["--shards"], &files[1..]].concat()).fails(4, &["1 shard missing: 1/3"]);
        // of another structure they are of no use
        study.write("other.toml", &BLOCK.replace("0.8", "0.6"));
        let other = [&[job, "other.toml", "--urs", "r.h5", "--shards"][..], &files].concat();
        study.uplift(&other).fails(4, &["other work"]);
        study.uplift(&[&ask[..], &["--shard", "1/2"]].concat()).fails(2, &["--json"]);
        assert!(left(study.path()).is_empty(), "{:?}", left(study.path()));
    }
}

/// A checkpoint as a stopped job leaves it, whole or cut off anywhere.
#[test]
#[ignore = "long: make test-long"]
fn from_any_checkpoint_the_answer_is_the_same() {
    let study = study();
    for job in JOBS {
        let ask = [job, "block.toml", "--urs", "r.h5", "--json"];
        let whole = study.uplift(&ask).ok().stdout;
        study.uplift(&[job, "block.toml", "--urs", "r.h5", "--shard", "1/1", "-q"]).ok();
        let rows = std::fs::read(study.path().join(format!("r.h5.{job}-block.shard-1-of-1"))).unwrap();
        let checkpoint = format!("r.h5.{job}-block.part");
        for (share, threads) in [(2, "1"), (3, "3"), (4, "1")] {
            study.write_bytes(&checkpoint, &rows[..rows.len() * share / 4]);
            let done = study.uplift(&[&ask[..], &["--threads", threads]].concat()).ok();
            assert!(done.stderr.contains("analyses resumed"), "{}", done.stderr);
            assert_eq!(done.stdout, whole, "{job} {share}");
            assert!(left(study.path()).is_empty(), "{:?}", left(study.path()));
        }
        // where no checkpoint can be written it goes on without
        std::fs::create_dir(study.path().join(&checkpoint)).unwrap();
        let done = study.uplift(&ask).ok();
        assert!(done.stderr.contains("no checkpoint can be written (") && done.stdout == whole, "{}", done.stderr);
        std::fs::remove_dir(study.path().join(&checkpoint)).unwrap();
    }
}

#[cfg(unix)]
#[test]
#[ignore = "long: make test-long"]
fn ctrl_c_leaves_a_checkpoint() {
    use std::process::Stdio;
    let study = study();
    // long enough to be stopped
    study.uplift(&["records", "synthesize", "-o", "many", "--count", "60", "-q"]).ok();
    study.uplift(&["records", "import", "many", "-o", "many.csv", "-q"]).ok();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--force", "--set", "records.manifest=many.csv"]).ok();
    let ask = ["design", "block.toml", "--urs", "r.h5", "--json"];
    let mut child = command(study.path())
        .args(ask)
        .args(["--threads", "1"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let checkpoint = study.path().join("r.h5.design-block.part");
    let begin = std::time::Instant::now();
    while std::fs::metadata(&checkpoint).map_or(0, |file| file.len()) < 2_000 {
        assert!(begin.elapsed().as_secs() < 60 && child.try_wait().unwrap().is_none(), "no checkpoint");
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    assert!(std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(5));
    let mut said = String::new();
    std::io::Read::read_to_string(child.stderr.as_mut().unwrap(), &mut said).unwrap();
    assert!(said.contains("are in the checkpoint") && said.contains("r.h5.design-block.part"), "{said}");
    let resumed = study.uplift(&ask).ok();
    assert!(resumed.stderr.contains("analyses resumed"), "{}", resumed.stderr);
    assert_eq!(resumed.stdout, study.uplift(&ask).ok().stdout);
}
