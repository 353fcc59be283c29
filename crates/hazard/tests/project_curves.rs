//! The curves of the project's `hazard/` folder and the outside reference case.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use uplift_hazard::{CsvOptions, HazardCurve, rate_from_probability, read_csv, read_path};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn project_curve(folder: &str, measure: &str, unit: &str) -> HazardCurve {
    let file = repository().join("hazard").join(folder).join(format!("{}.csv", measure.to_lowercase()));
    let read = read_path(&file, &CsvOptions::new(measure, unit)).unwrap();
    assert_eq!((read.dropped_zeros, read.dropped_certain), (0, 0));
    read.curve
}

/// Each row of the table in hazard/README.md: folder, PGV and PGA at 50, 10 and 2 % in 50 years as printed.
fn readme_rows() -> Vec<(String, [Vec<String>; 2])> {
    let text = fs::read_to_string(repository().join("hazard/README.md")).unwrap();
    let triple = |cell: &str| cell.split('/').map(|value| value.trim().to_owned()).collect();
    text.lines()
        .filter_map(|line| {
            let cells: Vec<&str> = line.strip_prefix("| `")?.split('|').collect();
            Some((cells[0].split_once('`')?.0.to_owned(), [triple(cells[2]), triple(cells[3])]))
        })
        .collect()
}

/// Every folder below `root` that has a curve, relative to it.
fn folders_with_curves(root: &Path, folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(root.join(folder)).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_dir() {
            found.extend(folders_with_curves(root, &folder.join(entry.file_name())));
        } else if entry.file_name() == "pgv.csv" {
            found.insert(folder.to_owned());
        }
    }
    found
}

#[test]
fn every_project_curve_gives_the_values_of_the_readme() {
    let rows = readme_rows();
    let named: BTreeSet<PathBuf> = rows.iter().map(|(folder, _)| PathBuf::from(folder)).collect();
    assert_eq!(named, folders_with_curves(&repository().join("hazard"), Path::new("")));
    for (folder, printed) in &rows {
        for (printed, (measure, unit)) in printed.iter().zip([("PGV", "cm/s"), ("PGA", "g")]) {
            let curve = project_curve(folder, measure, unit);
            assert!((50..=60).contains(&curve.len()));
            assert!(curve.source().contains("source model: ") && curve.source().contains("trust: "));
            assert_eq!(printed.len(), 3);
            for (printed, probability) in printed.iter().zip([0.5, 0.1, 0.02]) {
                let level = curve.im_at_rate(rate_from_probability(probability, 50.0).unwrap()).unwrap();
                let decimals = printed.split_once('.').unwrap().1.len();
                assert_eq!(&format!("{level:.decimals$}"), printed, "{folder} {measure} {probability}");
            }
        }
    }
}

#[test]
fn a_project_curve_read_as_something_else_is_refused() {
    let file = repository().join("hazard/athens/pgv.csv");
    for (measure, unit, wrong) in
        [("PGV", "m/s", "unit \"cm/s\", but \"m/s\""), ("PGA", "g", "measure \"PGV\", but \"PGA\"")]
    {
        let error = read_path(&file, &CsvOptions::new(measure, unit)).unwrap_err().to_string();
        assert!(error.contains("pgv.csv, line 1: ") && error.contains(wrong), "{error}");
    }
}

/// The uniform-hazard value of the public risk-targeted ground motion test "Fox Plaza"
/// (usgs/earthquake-rtgm-calculator).
#[test]
fn uniform_hazard_value_of_the_outside_reference() {
    let file = repository().join("../shared/reference/rtgm_fox_plaza.csv");
    let Ok(text) = fs::read_to_string(&file) else {
        println!("skipped: the reference table rtgm_fox_plaza.csv is not there");
        return;
    };
    let curve = read_csv(&text, "rtgm_fox_plaza.csv", &CsvOptions::new("SA(1.0)", "g")).unwrap().curve;
    assert_eq!(curve.len(), 20);
    let level = curve.im_at_rate(rate_from_probability(0.02, 50.0).unwrap()).unwrap();
    assert!((level / 0.675_385_717_276_94 - 1.0).abs() < 1e-12, "{level}");
}
