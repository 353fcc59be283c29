//! Two runs side by side, again and again: neither takes what the other is writing.
//!
//! `UPLIFT_RACES` says how often; `make torture` runs the long one.

use crate::common::SmallStudy;

/// Rounds of the long trial.
const RACES: usize = 25;

#[test]
fn runs_side_by_side_lose_nothing() {
    race(3);
}

#[ignore = "minutes; make torture"]
#[test]
fn torture_runs_side_by_side() {
    race(RACES);
}

/// `site.h5` and `site.v2.h5`, whose names begin alike, with their tables and hidden files in one folder; and a third
/// run that is killed on its way, whose leftovers are to be cleared meanwhile.
fn race(rounds: usize) {
    let rounds = std::env::var("UPLIFT_RACES").ok().and_then(|text| text.parse().ok()).unwrap_or(rounds);
    let study = SmallStudy::new();
    let mut lost = Vec::new();
    for round in 0..rounds {
        let mut killed = study.start(&["run", "study.toml", "--again", "--quiet", "-o", "site.h5"]);
        killed.wait_until("its lock", || study.path().join(".site.h5.lock").exists());
        killed.kill();
        let runs =
            ["site.h5", "site.v2.h5"].map(|name| study.start(&["run", "study.toml", "--again", "--quiet", "-o", name]));
        let codes = runs.map(|run| {
            let ended = run.end();
            if ended.code != 0 {
                lost.push(format!("round {round}: {}", ended.stderr));
            }
            ended.code
        });
        if codes == [0, 0] {
            study.uplift(&["verify", "site.h5", "site.v2.h5"]).ok();
        }
    }
    println!("{} of {rounds} races lost", lost.len());
    assert!(lost.is_empty(), "{}", lost.join("\n"));
    let names = study.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let left: Vec<String> = names.filter(|name| name.contains(".partial-")).collect();
    assert!(left.is_empty(), "{left:?}");
}
