//! The sets of the processor's instructions that the oscillators are compiled for give the same bits.

use std::path::Path;
use std::process::Output;

use uplift_labelled::LabelledReader;

use crate::common::{SmallStudy, command};

/// Every set, and whether this processor has it.
fn sets() -> [(&'static str, bool); 3] {
    #[cfg(target_arch = "x86_64")]
    let [avx2, avx512] = [
        is_x86_feature_detected!("avx2"),
        is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512dq"),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let [avx2, avx512] = [false; 2];
    [("portable", true), ("avx2", avx2), ("avx512", avx512)]
}

fn run_with(study: &SmallStudy, set: &str, output: &str) -> Output {
    let mut run = command(study.path());
    run.args(["run", "study.toml", "-o", output]).env("UPLIFT_INSTRUCTIONS", set).output().unwrap()
}

/// Every array of numbers of a result, bit by bit.
fn bits(path: &Path) -> Vec<(String, Vec<u64>)> {
    let reader = LabelledReader::open(path).unwrap();
    let names = ["ida/@/edp_m", "ida/@/impacts", "risk/@/maf_per_year", "urs/@/u_m", "urs/@/lower_tail_share"];
    let of_measure = |measure: &str| names.map(|name| format!("/{}", name.replace('@', measure)));
    let paths = ["pgv", "pga"].iter().flat_map(|measure| of_measure(measure));
    let array = |path: String| {
        let values = if path.ends_with("impacts") {
            reader.array::<u32>(&path).unwrap().values.into_iter().map(u64::from).collect()
        } else {
            reader.array::<f64>(&path).unwrap().values.into_iter().map(f64::to_bits).collect()
        };
        (path, values)
    };
    paths.map(array).collect()
}

#[test]
fn every_set_of_this_processor_gives_the_same_results() {
    let study = SmallStudy::new();
    let mut portable = None;
    for (set, available) in sets() {
        let file = format!("{set}.h5");
        let run = run_with(&study, set, &file);
        let said = String::from_utf8(run.stderr).unwrap();
        if !available {
            assert_eq!(run.status.code(), Some(2), "{said}");
            assert!(said.contains("UPLIFT_INSTRUCTIONS") && said.contains(set) && said.contains("portable"), "{said}");
            continue;
        }
        assert!(run.status.success(), "{said}");
        let result = bits(&study.path().join(file));
        assert!(result.iter().all(|(_, values)| !values.is_empty()));
        let expected = portable.get_or_insert_with(|| result.clone());
        assert!(*expected == result, "{set} differs from portable");
    }
    assert!(portable.is_some());
}

#[test]
fn an_unknown_set_is_not_passed_over() {
    let study = SmallStudy::new();
    for (index, word) in ["", "AVX2", "sse9"].into_iter().enumerate() {
        let run = run_with(&study, word, &format!("{index}.h5"));
        let said = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(2), "{said}");
        assert!(said.contains(&format!("UPLIFT_INSTRUCTIONS is \"{word}\"")) && said.contains("portable"), "{said}");
        assert!(!study.path().join(format!("{index}.h5")).exists());
    }
}
