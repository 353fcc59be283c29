//! Joint bands of repaired spectra: over resampled records and weighted hazard curves, with weights solved again for
//! every pair of a sample and a curve.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use serde_json::Value;
use uplift::JobError;
use uplift::bootstrap::{BootstrapOptions, bootstrap};
use uplift::events::{Events, Phase, Silent};
use uplift_labelled::LabelledReader;

use crate::common::{SmallStudy, array, same_bits};
use crate::epistemic::two_measures;

/// What a job that failed says.
fn job_error<T, E: std::error::Error + 'static>(outcome: &Result<T, E>) -> Option<&JobError> {
    uplift::cause(outcome.as_ref().err()?)
}

const MEASURES: [&str; 2] = ["pgv", "pga"];
const ARRAYS: [&str; 5] = ["u05_m", "u50_m", "u95_m", "r_90ci", "failed"];

/// A site with the hazard of Montreux, weight 0.3, or of Athens, 0.7; its result is `r.h5`.
fn study() -> SmallStudy {
    run(two_measures("north south", "north south", ""))
}

fn run(study: SmallStudy) -> SmallStudy {
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study
}

/// The same study with other words in its file.
fn with(study: SmallStudy, from: &str, to: &str) -> SmallStudy {
    let text = std::fs::read_to_string(study.path().join("study.toml")).unwrap();
    assert!(text.contains(from), "{text}");
    study.write("study.toml", &text.replace(from, to));
    study
}

fn resample(study: &SmallStudy, more: &[&str]) -> String {
    study.uplift(&[&["bootstrap", "r.h5"][..], more].concat()).ok().stdout
}

fn joint(file: &Path, measure: &str, name: &str) -> Vec<f64> {
    array(file, &format!("/bootstrap/{measure}/consistent/joint/Here/{name}"))
}

fn all(file: &Path) -> Vec<f64> {
    MEASURES.iter().flat_map(|measure| ARRAYS.map(|name| joint(file, measure, name)).concat()).collect()
}

// Of one sample and two curves there are two pairs: the band says what the sample is worth under either curve, and that
// is what a study of this curve alone makes of the same sample.
#[test]
#[ignore = "long: make test-long"]
fn a_pair_is_worth_what_a_study_of_its_curve_makes_of_its_sample() {
    let options = ["--sizes", "60,105", "--replicates", "1", "-q"];
    let both = study();
    resample(&both, &options);
    let alone = ["montreux", "athens"].map(|place| run(two_measures(place, place, "")));
    for study in &alone {
        resample(study, &options);
    }
    for measure in MEASURES {
        let [north, south] = alone.each_ref().map(|study| {
            assert!(
                !LabelledReader::open(&study.path().join("r.h5")).unwrap().exists("/bootstrap/pgv/consistent/joint")
            );
            array(&study.path().join("r.h5"), &format!("/bootstrap/{measure}/consistent/u50_m"))
        });
        assert_ne!(north, south);
        let [lower, median, upper] =
            ["u05_m", "u50_m", "u95_m"].map(|name| joint(&both.path().join("r.h5"), measure, name));
        let of_pairs = |choose: fn(f64, f64) -> f64| -> Vec<f64> {
            north.iter().zip(&south).map(|(&north, &south)| choose(north, south)).collect()
        };
        assert!(same_bits(&lower, &of_pairs(f64::min)) && same_bits(&upper, &of_pairs(f64::max)));
        // 0.7 of the weight is on one side of the middle
        assert!(same_bits(&median, &south));
    }
}

#[test]
#[ignore = "long: make test-long"]
fn of_one_curve_twice_it_is_the_band_of_that_curve() {
    // the 6th, 51st and 96th of 101, whichever of both definitions of a percentile is taken
    let options = ["--sizes", "105", "--replicates", "101", "-q"];
    let twice = run(with(two_measures("north south", "north south", ""), "athens", "montreux"));
    let once = run(two_measures("montreux", "montreux", ""));
    for study in [&twice, &once] {
        resample(study, &options);
    }
    for measure in MEASURES {
        for name in ARRAYS {
            let expected = array(&once.path().join("r.h5"), &format!("/bootstrap/{measure}/consistent/{name}"));
            assert!(same_bits(&joint(&twice.path().join("r.h5"), measure, name), &expected), "{measure} {name}");
        }
    }
}

#[test]
#[ignore = "long: make test-long"]
fn it_is_in_tables_and_exports_and_hangs_on_no_thread() {
    let study = study();
    std::fs::copy(study.path().join("r.h5"), study.path().join("one.h5")).unwrap();
    let options = ["--sizes", "40,105", "--replicates", "60"];
    let told = resample(&study, &[&options[..], &["--details"]].concat());
    assert!(told.contains("the same for the repaired spectra, and how many of their weights do not match"));
    study.uplift(&[&["bootstrap", "one.h5", "--threads", "1", "-q"][..], &options].concat()).ok();
    let [file, one] = ["r.h5", "one.h5"].map(|name| study.path().join(name));
    assert!(same_bits(&all(&file), &all(&one)));
    for measure in MEASURES {
        let [lower, median, upper] = ["u05_m", "u50_m", "u95_m"].map(|name| joint(&file, measure, name));
        assert!(lower.iter().zip(&median).zip(&upper).all(|((lower, median), upper)| lower < median && median < upper));
        assert_ne!(median, array(&file, &format!("/bootstrap/{measure}/joint/Here/u50_m")));
    }
    let header =
        |name: &str| std::fs::read_to_string(study.path().join(name)).unwrap().lines().next().unwrap().to_owned();
    assert!(header("r.bands.csv").ends_with(
        ",u95_consistent_m,truth_lower_consistent_m,truth_upper_consistent_m,prediction_lower_consistent_m,\
         prediction_upper_consistent_m,u05_joint_m,u50_joint_m,u95_joint_m,u05_consistent_joint_m,\
         u50_consistent_joint_m,u95_consistent_joint_m"
    ));
    assert!(
        header("r.table-4-1.csv")
            .ends_with(",r_90ci_joint_pct,r_90ci_consistent_joint_pct,failed_consistent_joint_pct")
    );
    // asked for the risks of the study anew, the bands are the same
    let json = |more: &[&str]| -> Value {
        study.uplift(&[&["export", "r.h5", "--json", "-o", "r.json", "-q", "--force"][..], more].concat()).ok();
        serde_json::from_str(&std::fs::read_to_string(study.path().join("r.json")).unwrap()).unwrap()
    };
    let (stored, asked) = (json(&[]), json(&["--poe", "0.02,0.1,0.5"]));
    let (stored, asked) = (stored["spectra"].as_array().unwrap(), asked["spectra"].as_array().unwrap());
    assert_eq!((stored.len(), asked.len()), (6, 6));
    for (stored, asked) in stored.iter().zip(asked) {
        for key in ["bands_joint", "bands_consistent_joint"] {
            assert_eq!(stored[key], asked[key]);
            assert_eq!(stored[key].as_array().unwrap().len(), 2, "a band for each size");
        }
    }
    let first = stored[0]["bands_consistent_joint"][0]["u95_m"].as_array().unwrap();
    let first: Vec<f64> = first.iter().map(|value| value.as_f64().unwrap()).collect();
    assert!(same_bits(&first, &joint(&file, "pgv", "u95_m")[..3]));
    study.uplift(&["export", "r.h5", "--csv", "-o", "t.csv", "-q"]).ok();
    assert!(header("t.csv").contains(",u05_consistent_joint_n40_m,"), "{}", header("t.csv"));
}

/// Stops at the third look in the phase of this name: of the first site, after the band of its mean curve.
struct StopIn {
    label: &'static str,
    is_there: AtomicBool,
    looks: AtomicUsize,
}

impl Events for StopIn {
    fn begin(&self, phase: Phase<'_>) {
        self.is_there.store(phase.label == self.label, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.is_there.load(Ordering::Relaxed) && self.looks.fetch_add(1, Ordering::Relaxed) >= 2
    }
}

#[test]
#[ignore = "long: make test-long"]
fn a_stop_before_and_after_it_loses_nothing() {
    let study = study();
    let [whole, parts] = ["r.h5", "parts.h5"].map(|name| study.path().join(name));
    std::fs::copy(&whole, &parts).unwrap();
    let options = BootstrapOptions { sizes: Some(vec![105]), replicates: Some(20), ..BootstrapOptions::default() };
    bootstrap(&whole, &options, &Silent).unwrap();
    for (label, expected) in [("PGV repaired", 0), ("PGA repaired", 1)] {
        let stop = StopIn { label, is_there: AtomicBool::new(false), looks: AtomicUsize::new(0) };
        let stopped = bootstrap(&parts, &options, &stop);
        let Some(JobError::Paused { what, done, total, .. }) = job_error(&stopped) else { panic!("{stopped:?}") };
        assert_eq!((*what, *done, *total), ("repaired sites", expected, 2), "{label}");
    }
    bootstrap(&parts, &options, &Silent).unwrap();
    assert!(same_bits(&all(&whole), &all(&parts)));
}

#[test]
#[ignore = "long: make test-long"]
fn where_a_curve_cannot_be_repaired_there_is_none_and_it_is_said() {
    let study = two_measures("north south", "north south", "");
    let athens = crate::common::repository().join("hazard/athens/pga.csv");
    // so rare that all records bring it more often
    let far: String = (std::fs::read_to_string(&athens).unwrap().lines())
        .map(|line| match line.split_once(',').and_then(|(level, rate)| Some((level, rate.parse::<f64>().ok()?))) {
            Some((level, rate)) => format!("{level},{:e}\n", 0.02 * rate),
            None => format!("{line}\n"),
        })
        .collect();
    study.write("far.csv", &far);
    let study = run(with(study, &athens.display().to_string(), "far.csv"));
    let done = study.uplift(&["bootstrap", "r.h5", "--sizes", "105", "--replicates", "5"]).ok();
    let told = format!("{}{}", done.stdout, done.stderr);
    let words = "Here by PGV: no joint band of repaired spectra, since the hazard curve south cannot be repaired: ";
    assert!(told.contains(words), "{told}");
    let file = study.path().join("r.h5");
    assert!(all(&file).iter().all(|value| value.is_nan()));
    assert!(array(&file, "/bootstrap/pgv/joint/Here/u50_m").iter().all(|u_m| u_m.is_finite()));
}
