//! Runs that are killed, stopped, cut into shards and gone on with: nothing is lost, and the numbers are those of an
//! undisturbed run.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use uplift_labelled::LabelledReader;

use crate::common::{self, EARLIER, SMALL_STUDY, SmallStudy};

/// A study of about a second of work on one thread.
fn study() -> SmallStudy {
    let text = SMALL_STUDY
        .replace("first = 4", "first = 8")
        .replace("pairs = 4", "pairs = 8")
        .replace("values = [0, 0.05, \"0.1:0.1:0.8\"]", "values = \"0.02:0.02:0.8\"");
    SmallStudy::with(&text)
}

/// Everything in a result but what tells of time and circumstance: arrays by their checksums, attributes by their text.
fn content(path: &Path) -> BTreeMap<String, String> {
    const CIRCUMSTANCE: [&str; 6] = ["created", "command", "wall_time_s", "threads", "seconds", "study_toml"];
    let reader = LabelledReader::open(path).unwrap();
    let mut content = BTreeMap::new();
    let mut groups = vec![String::new()];
    while let Some(group) = groups.pop() {
        for child in reader.children(if group.is_empty() { "/" } else { &group }).unwrap() {
            let object = format!("{group}/{child}");
            if reader.children(&object).is_ok() {
                groups.push(object);
            } else {
                assert_eq!(reader.is_sound(&object).unwrap(), Some(true), "{object}");
                content.insert(object.clone(), reader.attribute::<String>(&object, "sha256").unwrap());
            }
        }
    }
    for name in ["version", "commit", "title", "study_file", "record_set", "input_checksums", "warnings"] {
        assert!(!CIRCUMSTANCE.contains(&name));
        content.insert(format!("attribute {name}"), reader.attribute::<String>("/", name).unwrap());
    }
    assert!(content.keys().filter(|key| key.starts_with("/ida")).count() >= 4 && content.len() > 30, "{content:?}");
    content
}

/// What the run computed, from its summary.
fn computed(study: &SmallStudy, arguments: &[&str]) -> (u64, u64) {
    let done = study.uplift(&[arguments, &["--json"]].concat()).ok();
    let summary: serde_json::Value = serde_json::from_str(&done.stdout).unwrap();
    let sum = |key: &str| summary["measures"].as_array().unwrap().iter().map(|m| m[key].as_u64().unwrap()).sum();
    (sum("analyses_computed"), sum("analyses"))
}

/// Kills a run `times` times, at moments all over its course, and looks at what is there after each.
fn killed(times: u32) {
    let undisturbed = study();
    let begin = Instant::now();
    undisturbed.uplift(&["run", "study.toml"]).ok();
    let whole = begin.elapsed();
    let expected = content(&undisturbed.path().join("results/study.h5"));

    let study = study();
    let result = study.path().join("results/study.h5");
    let mut state = 12345_u64;
    let (mut kills, mut finished) = (0, 0);
    while kills < times {
        let mut run = study.start(&["run", "study.toml", "--quiet", "--threads", "2"]);
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        // from the first moment to a little after the usual end, so that some hit the writing
        let share = f64::from(u32::try_from(state >> 33).unwrap()) / f64::from(1_u32 << 31);
        std::thread::sleep(whole.mul_f64(1.1 * share).min(Duration::from_secs(1)));
        if run.is_at_work() {
            run.kill();
            kills += 1;
        } else {
            run.end().ok();
            finished += 1;
        }
        if result.exists() {
            // what is there is whole, whenever it was killed; and the next run starts from nothing
            assert_eq!(content(&result), expected, "after {kills} kills");
            if finished % 2 == 1 || kills % 7 == 0 {
                std::fs::remove_file(&result).unwrap();
            }
        }
    }
    study.uplift(&["run", "study.toml"]).ok();
    assert_eq!(content(&result), expected);
    // nothing is left but the result and its tables, and what stands beside these
    let mut left: Vec<String> = std::fs::read_dir(study.path().join("results"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    left.retain(|name| !name.ends_with(".csv-metadata.json"));
    left.sort();
    assert_eq!(left, ["study.h5", "study.regression.csv", "study.urs.csv"]);
    println!("{kills} kills, {finished} ends; an undisturbed run takes {whole:?}");
}

#[test]
#[ignore = "long: make test-long"]
fn killed_at_any_moment_it_resumes_and_ends_with_the_same_bits() {
    killed(30);
}

#[test]
#[ignore = "minutes: make torture"]
fn torture_kills() {
    killed(200);
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_reports_its_progress_and_resumes() {
    let study = study();
    let mut run = study.start(&["run", "study.toml", "--threads", "1"]);
    let checkpoint = study.path().join("results/study.h5.part");
    run.wait_until("a few rows", || std::fs::metadata(&checkpoint).is_ok_and(|file| file.len() >= 20_000));
    run.interrupt();
    let said = run.end().fails(5, &["analyses are in the checkpoint", "study.h5.part"]).stderr;
    // what `status` says, in the same words
    let progress = said.split_once("interrupted: ").unwrap().1.split_once(" are in the checkpoint").unwrap().0;
    study.uplift(&["spectrum", "results/study.h5"]).fails(4, &["its run was interrupted: repeat it to resume it"]);

    let rows = std::fs::read(&checkpoint).unwrap();
    for input in ["results/study.h5", "study.toml"] {
        let status = study.uplift(&["status", input]).ok().stdout;
        assert!(status.contains(&format!("checkpoint of an unfinished run, {progress} (")), "{status}\n{said}");
    }
    let (computed, all) = computed(&study, &["run", "study.toml"]);
    assert!(computed > 0 && computed < all, "{computed} of {all}");
    let status = study.uplift(&["status", "results/study.h5"]).ok().stdout;
    assert!(
        status.contains("finished") && status.contains("Here, There") && !status.contains("checkpoint"),
        "{status}"
    );
    study.uplift(&["status", "absent.h5"]).fails(4, &["absent.h5", "no result"]);
    // a run that was killed when its result was in place left its checkpoint; that of another run stays
    let other = ["run", "study.toml", "-o", "other.h5", "--set", "oscillator.restitution=0.9"];
    study.uplift(&other).ok();
    study.write_bytes("other.h5.part", &rows);
    study.write_bytes("results/study.h5.part", &rows);
    for run in [&other[..], &["run", "study.toml"]] {
        assert!(study.uplift(run).ok().stdout.contains("done already"));
    }
    assert!(study.path().join("other.h5.part").exists() && !checkpoint.exists());
}

// A run that is killed when its result is in place, but not yet its tables.
#[cfg(unix)]
#[test]
fn what_a_killed_run_left_undone_is_done_by_the_next() {
    const TABLES: [&str; 4] =
        ["r.urs.csv", "r.urs.csv-metadata.json", "r.regression.csv", "r.regression.csv-metadata.json"];
    let study = SmallStudy::new();
    let run = |more: &[&str]| study.uplift(&[&["run", "study.toml", "-o", "r.h5"][..], more].concat()).ok();
    let read = |name: &str| std::fs::read(study.path().join(name)).unwrap();
    run(&["--set", "risk.years=10"]);
    let of_other = TABLES.map(read);
    run(&["--force"]);
    let (result, tables) = (read("r.h5"), TABLES.map(read));
    assert_ne!(tables, of_other);
    std::fs::remove_dir_all(study.path().join("r.earlier")).unwrap();
    let finishes = || {
        assert!(run(&[]).stdout.contains("done already"));
        assert_eq!((read("r.h5"), TABLES.map(read)), (result.clone(), tables.clone()));
    };
    for gone in [&TABLES[..], &TABLES[2..], &TABLES[2..3]] {
        for name in gone {
            std::fs::remove_file(study.path().join(name)).unwrap();
        }
        finishes();
    }
    // before it moved the tables of an earlier result away
    TABLES.iter().zip(&of_other).for_each(|(name, bytes)| study.write_bytes(name, bytes));
    finishes();
    let earlier = std::fs::read_dir(study.path().join("r.earlier")).unwrap().next().unwrap().unwrap();
    assert_eq!(std::fs::read(earlier.path().join(TABLES[0])).unwrap(), of_other[0]);
    // while it wrote any of its files
    let mut machine = flate2::Crc::new();
    machine.update(&std::fs::read("/proc/sys/kernel/hostname").unwrap());
    let hidden = |name: &str| format!(".{name}.partial-{:08x}-0", machine.sum());
    TABLES.iter().chain(&["r.h5"]).for_each(|name| study.write_bytes(&hidden(name), b"half"));
    finishes();
    let left = std::fs::read_dir(study.path()).unwrap().map(|entry| entry.unwrap().file_name());
    let left: Vec<_> = left.filter(|name| name.to_string_lossy().starts_with('.')).collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
#[ignore = "long: make test-long"]
fn only_what_is_new_is_computed() {
    let study = SmallStudy::new();
    let first = computed(&study, &["run", "study.toml"]);
    assert_eq!(first, (4 * 10 * 9, 4 * 10 * 9));
    // another site, another probability: no analysis
    assert_eq!(computed(&study, &["run", "study.toml", "--force", "--set", "risk.poe=[0.01]"]).0, 0);
    // two strengths more, one level more, two records fewer
    let more = ["run", "study.toml", "--force", "--set", "strengths.values=[0, 0.05, \"0.1:0.1:0.8\", 0.9, 1]"];
    assert_eq!(computed(&study, &more), (4 * 2 * 9, 4 * 12 * 9));
    let levels = ["run", "study.toml", "--force", "--set", "pgv.levels_cm_s=[1, 3, 10, 30, 60, 100]"];
    assert_eq!(computed(&study, &levels), (4 * 10, 4 * 10 * 10));
    let fewer = ["run", "study.toml", "--force", "--set", "records.first=2"];
    assert_eq!(computed(&study, &fewer), (0, 2 * 10 * 9));
    // what a result was made of bit by bit is what a fresh run makes
    let patched = study.path().join("results/study.h5");
    let again = ["run", "study.toml", "--force"];
    let (computed_again, _) = computed(&study, &again);
    assert!(computed_again > 0);
    study.uplift(&["run", "study.toml", "-o", "fresh.h5"]).ok();
    assert_eq!(content(&patched), content(&study.path().join("fresh.h5")));
    // another oscillator, another measure of the records, another motion: all anew
    for set in
        ["oscillator.restitution=0.9", "gravity_m_s2=9.81", "records.component=\"h2\"", "records.synthetic.seed=2"]
    {
        let (computed, all) = computed(&study, &["run", "study.toml", "--force", "--set", set, "-o", "other.h5"]);
        assert_eq!(computed, all, "{set}");
        study.uplift(&["run", "study.toml", "--force", "-o", "other.h5"]).ok();
    }
}

#[test]
fn shards_make_the_same_result() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "whole.h5"]).ok();
    for shard in ["3/3", "1/3", "2/3"] {
        let done = study.uplift(&["run", "study.toml", "--shard", shard]).ok();
        assert!(done.stdout.contains("analysis rows"), "{}", done.stdout);
    }
    let shard = |n: u32| format!("results/study.shard-{n}-of-3");
    let (one, two, three) = (shard(1), shard(2), shard(3));
    study.uplift(&["status", &two]).ok();
    let merged = study.uplift(&["merge", "study.toml", &three, &one, &two]).ok();
    assert!(merged.stderr.contains("80 analysis rows of 3 shards"), "{}", merged.stderr);
    assert_eq!(content(&study.path().join("results/study.h5")), content(&study.path().join("whole.h5")));

    std::fs::remove_file(study.path().join("results/study.h5")).unwrap();
    study.uplift(&["merge", "study.toml", &one, &three]).fails(4, &["1 shard missing: 2/3"]);
    study.uplift(&["merge", "study.toml", &one, &one, &two, &three]).fails(4, &["shard 1 of 3 is given twice"]);
    study.uplift(&["run", "study.toml", "--shard", "1/2", "-o", "half"]).ok();
    study
        .uplift(&["merge", "study.toml", &one, &two, &three, "half"])
        .fails(4, &["half", "merge shards of the same number"]);
    study.uplift(&["run", "study.toml", "--shard", "1/3", "-o", "foreign", "--set", "oscillator.restitution=0.9"]).ok();
    study
        .uplift(&["merge", "study.toml", "foreign", &two, &three])
        .fails(4, &["foreign", "other work", "missing: 1/3"]);
    // cut off in the middle, a shard is gone on with
    let bytes = std::fs::read(study.path().join(&two)).unwrap();
    study.write_bytes(&two, &bytes[..bytes.len() * 2 / 3]);
    study
        .uplift(&["merge", "study.toml", &one, &two, &three])
        .fails(4, &["study.shard-2-of-3", "analysis rows", "--shard 2/3"]);
    study.uplift(&["run", "study.toml", "--shard", "2/3"]).ok();
    assert_eq!(std::fs::read(study.path().join(&two)).unwrap().len(), bytes.len());
    study.uplift(&["merge", "study.toml", &one, &two, &three]).ok();
    assert_eq!(content(&study.path().join("results/study.h5")), content(&study.path().join("whole.h5")));
    study
        .uplift(&["merge", "study.toml", "study.toml"])
        .fails(4, &["study.toml", "not a file of finished analysis rows"]);
    study.uplift(&["run", "study.toml", "--shard", "4/3"]).fails(2, &["there is no shard 4 of 3"]);
}

#[test]
#[ignore = "long: make test-long"]
fn every_flipped_byte_is_found() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml"]).ok();
    let sound = study.uplift(&["verify", "results/study.h5"]).ok().stdout;
    assert!(sound.contains("arrays and every byte"), "{sound}");
    let bytes = std::fs::read(study.path().join("results/study.h5")).unwrap();
    for part in 0..97 {
        let mut damaged = bytes.clone();
        let index = part * (bytes.len() - 1) / 96;
        damaged[index] ^= 0x04;
        study.write_bytes("damaged.h5", &damaged);
        let found = study.uplift(&["verify", "damaged.h5"]);
        assert_eq!(found.code, 4, "byte {index}: {}\n{}", found.stdout, found.stderr);
    }
    // what is added to a result is sealed too, and what is damaged is not added to
    study.uplift(&["bootstrap", "results/study.h5", "--replicates", "20"]).ok();
    study.uplift(&["verify", "results/study.h5"]).ok();
    study.uplift(&["verify", "study.toml"]).fails(4, &["study.toml"]);
    study.uplift(&["verify", "absent.h5"]).fails(4, &["absent.h5"]);
}

// A damaged earlier result is no source of numbers.
#[test]
#[ignore = "long: make test-long"]
fn damage_does_not_spread() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "a.h5"]).ok();
    let expected = content(&study.path().join("a.h5"));
    let bytes = std::fs::read(study.path().join("a.h5")).unwrap();
    for part in 1..40 {
        let mut damaged = bytes.clone();
        let index = part * bytes.len() / 40;
        damaged[index] ^= 0x20;
        study.write_bytes("b.h5", &damaged);
        let done = study.uplift(&["run", "study.toml", "-o", "b.h5"]);
        // where it no longer is an HDF5 file it is left alone
        if done.code == 0 {
            assert_eq!(content(&study.path().join("b.h5")), expected, "byte {index}");
        } else {
            done.fails(4, &["b.h5"]);
        }
    }
}

// Not even where what it says of its numbers is damaged, and not the numbers.
#[test]
fn a_damaged_axis_is_no_source_of_numbers() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "a.h5"]).ok();
    let mut bytes = std::fs::read(study.path().join("a.h5")).unwrap();
    let levels: Vec<u8> = [1.0, 3.0, 10.0, 30.0, 100.0_f64].iter().flat_map(|level| level.to_le_bytes()).collect();
    let at = bytes.windows(levels.len()).position(|window| window == levels).unwrap() + 2 * 8;
    bytes[at..at + 8].copy_from_slice(&20.0_f64.to_le_bytes());
    study.write_bytes("a.h5", &bytes);
    let levels = ["--set", "pgv.levels_cm_s=[1, 3, 20, 30, 100]"];
    study.uplift(&[&["run", "study.toml", "-o", "a.h5"][..], &levels].concat()).ok();
    study.uplift(&[&["run", "study.toml", "-o", "fresh.h5"][..], &levels].concat()).ok();
    assert_eq!(content(&study.path().join("a.h5")), content(&study.path().join("fresh.h5")));
    // and nothing is added to a damaged result
    study.write_bytes("b.h5", &bytes);
    study.uplift(&["bootstrap", "b.h5", "--replicates", "20"]).fails(4, &["b.h5", "has changed since it was written"]);
    assert_eq!(std::fs::read(study.path().join("b.h5")).unwrap(), bytes);
}

#[cfg(unix)]
#[test]
fn bands_are_not_written_into_another_result() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml"]).ok();
    study.uplift(&["run", "study.toml", "-o", "other.h5", "--set", "oscillator.restitution=0.5"]).ok();
    let mut bootstrap = study.start(&["bootstrap", "results/study.h5", "--replicates", "100000", "--threads", "1"]);
    // the result has been read by then
    bootstrap.wait_until_said("plan");
    bootstrap.hold();
    // a run does not take the place of what is being added to
    study.uplift(&["run", "study.toml", "--again"]).fails(4, &["study.h5 is being written by another run"]);
    // another program may
    let written = content(&study.path().join("other.h5"));
    std::fs::rename(study.path().join("other.h5"), study.path().join("results/study.h5")).unwrap();
    bootstrap.release();
    bootstrap.end().fails(4, &["overwritten it meanwhile"]);
    assert_eq!(content(&study.path().join("results/study.h5")), written);
}

#[cfg(unix)]
#[test]
fn one_that_adds_to_a_result_waits_for_another() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).ok();
    let mut bootstrap = study.start(&["bootstrap", "r.h5", "--replicates", "20000", "--threads", "1"]);
    bootstrap.wait_until_said("plan");
    bootstrap.hold();
    let mut influence = study.start(&["influence", "r.h5"]);
    influence.wait_until_said("is being written by another run (process");
    bootstrap.release();
    assert_eq!((bootstrap.end().code, influence.end().code), (0, 0));
    // neither has lost what it made
    let reader = LabelledReader::open(&study.path().join("r.h5")).unwrap();
    assert!(reader.exists("/bootstrap") && reader.exists("/influence"));
}

#[test]
fn files_of_other_programs_stay() {
    let study = SmallStudy::new();
    let other = study.path().join("thesis.h5");
    let mut writer = uplift_labelled::LabelledWriter::create(&other).unwrap();
    writer.attribute("/", "author", "somebody").unwrap();
    writer.finish().unwrap();
    let before = std::fs::read(&other).unwrap();
    study.uplift(&["run", "study.toml", "-o", "thesis.h5"]).fails(4, &["thesis.h5", "another program"]);
    assert_eq!(std::fs::read(&other).unwrap(), before);
    study.uplift(&["verify", "thesis.h5"]).fails(4, &["thesis.h5"]);
}

#[cfg(unix)]
#[test]
fn a_link_and_its_file_are_one_result() {
    let study = study();
    std::fs::create_dir(study.path().join("real")).unwrap();
    study.uplift(&["run", "study.toml", "-o", "real/a.h5", "--set", "records.first=1"]).ok();
    std::os::unix::fs::symlink("real/a.h5", study.path().join("link.h5")).unwrap();
    let mut run = study.start(&["run", "study.toml", "-o", "real/a.h5", "--force", "--threads", "1"]);
    run.wait_until("a checkpoint", || study.path().join("real/a.h5.part").exists());
    run.hold();
    study.uplift(&["run", "study.toml", "-o", "link.h5", "--force"]).fails(4, &["another run"]);
    run.kill();
    study.uplift(&["run", "study.toml", "-o", "link.h5", "--force"]).ok();
    assert!(study.path().join("link.h5").is_symlink() && !study.path().join("link.h5.part").exists());
}

#[test]
fn shards_that_start_together_do_not_meet() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "whole.h5"]).ok();
    for round in 0..3 {
        let shards: Vec<String> = (1..=4).map(|shard| format!("{shard}/4")).collect();
        let children: Vec<_> =
            shards.iter().map(|shard| study.start(&["run", "study.toml", "--shard", shard])).collect();
        for child in children {
            child.end().ok();
        }
        let files: Vec<String> = (1..=4).map(|shard| format!("results/study.shard-{shard}-of-4")).collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        study.uplift(&[&["merge", "study.toml", "-o", "merged.h5"][..], &files].concat()).ok();
        assert_eq!(content(&study.path().join("merged.h5")), content(&study.path().join("whole.h5")));
        let other = [&["merge", "study.toml", "-o", "other.h5", "--set", "gravity_m_s2=9.81"][..], &files].concat();
        study.uplift(&other).fails(4, &["is a shard of other work (\"small\"): of another study, of other records"]);
        // a shard of other work is not gone on with
        let other = ["run", "study.toml", "--shard", "1/4", "--set", "gravity_m_s2=9.81"];
        study.uplift(&other).fails(4, &["shard-1-of-4", "other work"]);
        for file in files.iter().skip(round) {
            std::fs::remove_file(study.path().join(file)).unwrap();
        }
        std::fs::remove_file(study.path().join("merged.h5")).unwrap();
    }
    study.uplift(&["run", "study.toml", "--shard", "1/1000000000000"]).fails(2, &["100000"]);
}

// Killed while the result is being written, of which the hidden file beside it tells.
#[test]
fn killed_while_writing() {
    let study = study();
    let results = study.path().join("results");
    let result = results.join("study.h5");
    study.uplift(&["run", "study.toml", "-o", "whole.h5"]).ok();
    let expected = content(&study.path().join("whole.h5"));
    let being_written = || -> BTreeSet<String> {
        let entries = std::fs::read_dir(&results).into_iter().flatten().flatten();
        entries
            .filter(|entry| entry.metadata().is_ok_and(|file| file.len() > 10_000))
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .filter(|name| name.starts_with(".study.h5.partial-"))
            .collect()
    };
    // on a busy machine the moment may pass unseen
    let (mut hits, mut kills) = (0, 0);
    while hits < 5 {
        assert!(kills < 100, "{hits} of {kills} kills hit the writing");
        let left = being_written();
        let mut run = study.start(&["run", "study.toml", "--quiet"]);
        while run.is_at_work() && being_written().is_subset(&left) {
            std::thread::sleep(Duration::from_micros(50));
        }
        run.kill();
        kills += 1;
        if result.exists() {
            assert_eq!(content(&result), expected);
            std::fs::remove_file(&result).unwrap();
        } else {
            hits += usize::from(!being_written().is_subset(&left));
        }
    }
    println!("{hits} of {kills} kills hit the writing");
    study.uplift(&["run", "study.toml"]).ok();
    assert_eq!(content(&result), expected);
    assert_eq!(being_written(), BTreeSet::new());
}

#[cfg(unix)]
#[test]
fn one_run_at_a_time() {
    let study = study();
    let mut run = study.start(&["run", "study.toml", "--threads", "1"]);
    run.wait_until("a checkpoint", || study.path().join("results/study.h5.part").exists());
    run.hold();
    study.uplift(&["run", "study.toml"]).fails(4, &["results/study.h5", "another run (process"]);
    let status = study.uplift(&["status", "results/study.h5"]).ok().stdout;
    assert!(status.contains("being written now, by process"), "{status}");
    run.kill();
    study.uplift(&["run", "study.toml"]).ok();
}

#[test]
fn what_is_in_the_way_is_left_alone() {
    let study = SmallStudy::new();
    std::fs::create_dir(study.path().join("results")).unwrap();
    study.write("results/study.h5.part", "my own notes\n");
    study.uplift(&["run", "study.toml"]).fails(4, &["study.h5.part", "not a file of finished analysis rows"]);
    assert_eq!(std::fs::read_to_string(study.path().join("results/study.h5.part")).unwrap(), "my own notes\n");
    // an earlier result that only begins as one is empty, and is overwritten
    std::fs::remove_file(study.path().join("results/study.h5.part")).unwrap();
    study.write_bytes("results/study.h5", EARLIER);
    study.uplift(&["run", "study.toml"]).ok();
    // a record that vanishes between check and run
    let made = ["records", "synthesize", "-o", "set", "--count", "2"];
    study.uplift(&made).ok();
    let set = ["--set", "records.manifest=set/manifest.csv"];
    study.uplift(&[&["check", "study.toml", "--set", "output.file=of-set.h5"][..], &set].concat()).ok();
    std::fs::remove_file(study.path().join("set/SYN002_H1.AT2")).unwrap();
    study.uplift(&[&["run", "study.toml", "--force"][..], &set].concat()).fails(4, &["SYN002", "SYN002_H1.AT2"]);
}

// A file system of its own, so small that the run fills it: what is finished is kept, and once there is room the run
// goes on.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_loses_nothing() {
    let study = study();
    let small = study.path().join("small");
    std::fs::create_dir(&small).unwrap();
    let mount = |options: &str| Command::new("mount").args(["-t", "tmpfs", "-o", options, "none"]).arg(&small).output();
    if !mount("size=32k").is_ok_and(|done| done.status.success()) {
        println!("skipped: no right to mount a small file system");
        return;
    }
    let run = ["run", "study.toml", "--again", "-o", "small/a.h5", "--set", "output.csv=false"];
    // found before anything is computed, unless whoever asks knows better
    study.uplift(&run).fails(4, &["of disk are needed", "free some, write elsewhere"]);
    let full = common::uplift_where(study.path(), ("UPLIFT_LIMITS", "warn"), &run);
    let full = full.fails(4, &["small/a.h5.part", "free some space"]);
    assert!(full.stderr.contains("No space left"), "{}", full.stderr);
    assert!(mount("remount,size=16m").unwrap().status.success());
    let (computed, all) = computed(&study, &run);
    // a place that cannot be written at all is said before anything is computed
    assert!(mount("remount,ro,size=16m").unwrap().status.success());
    study.uplift(&run).fails(4, &["small", "Read-only file system"]);
    study.uplift(&["run", "study.toml", "-o", "fresh.h5", "--set", "output.csv=false"]).ok();
    let same = content(&small.join("a.h5")) == content(&study.path().join("fresh.h5"));
    Command::new("umount").arg(&small).status().unwrap();
    assert!(same && computed > 0 && computed < all, "{computed} of {all}");
}

/// What an interrupted run left is no other run's to throw away.
#[test]
fn a_run_with_other_settings_leaves_the_checkpoint() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "--shard", "1/1", "-o", "all", "-q"]).ok();
    let rows = std::fs::read(study.path().join("all")).unwrap();
    let checkpoint = study.path().join("r.h5.part");
    std::fs::write(&checkpoint, &rows[..rows.len() * 3 / 4]).unwrap();
    let other = study.uplift(&["run", "study.toml", "--set", "records.first=2", "-o", "r.h5"]).ok();
    assert!(other.stderr.contains("r.h5.part stays: it holds analyses of other settings"), "{}", other.stderr);
    let status = study.uplift(&["status", "r.h5"]).ok().stdout;
    assert!(status.contains("r.h5.part: checkpoint with analyses of other settings\n"), "{status}");
    let kept = "--force to replace it; r.h5.part has analyses of an interrupted run";
    study.uplift(&["run", "study.toml", "-o", "r.h5"]).fails(2, &[kept]);
    // a checkpoint that nothing can resume from is not offered
    let rows = std::fs::read(&checkpoint).unwrap();
    std::fs::write(&checkpoint, "").unwrap();
    let refused = study.uplift(&["run", "study.toml", "-o", "r.h5"]).fails(2, &["--force to replace it"]);
    assert!(!refused.stderr.contains("r.h5.part"), "{}", refused.stderr);
    std::fs::write(&checkpoint, rows).unwrap();
    // without the result nothing is finished
    let result = study.path().join("r.h5");
    std::fs::rename(&result, study.path().join("away.h5")).unwrap();
    for asked in ["r.h5", "r.h5.part"] {
        let status = study.uplift(&["status", asked]).ok().stdout;
        assert!(status.contains("r.h5.part: checkpoint of an unfinished run, "), "{status}");
    }
    std::fs::rename(study.path().join("away.h5"), result).unwrap();
    let plain = study.uplift(&["run", "study.toml", "-o", "r.h5", "--force"]).ok();
    assert!(plain.stderr.contains("analyses resumed") && !checkpoint.exists(), "{}", plain.stderr);
}
