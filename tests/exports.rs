//! What `uplift influence` and `uplift measures` found goes with the spectra to other programs.

use std::io::Read;

use serde_json::Value;

use crate::common::SmallStudy;

const EXPORT: [&str; 7] = ["export", "r.h5", "--json", "--csv", "--mat", "--xlsx", "-q"];

fn json(study: &SmallStudy) -> Value {
    serde_json::from_slice(&std::fs::read(study.path().join("r.json")).unwrap()).unwrap()
}

fn head_of_table(study: &SmallStudy) -> String {
    std::fs::read_to_string(study.path().join("r.spectra.csv")).unwrap().lines().next().unwrap().to_owned()
}

fn sheets(study: &SmallStudy) -> String {
    let file = std::fs::File::open(study.path().join("r.xlsx")).unwrap();
    let mut text = String::new();
    zip::ZipArchive::new(file).unwrap().by_name("xl/workbook.xml").unwrap().read_to_string(&mut text).unwrap();
    text
}

fn matlab_has(study: &SmallStudy, name: &str) -> bool {
    let bytes = std::fs::read(study.path().join("r.mat")).unwrap();
    bytes.windows(name.len()).any(|window| window == name.as_bytes())
}

#[test]
fn influence_and_efficiency_are_exported_once_they_are_there() {
    let study = SmallStudy::new();
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    study.uplift(&EXPORT).ok();
    let none = json(&study);
    assert_eq!((&none["influence"], &none["efficiency"]), (&Value::Array(Vec::new()), &Value::Array(Vec::new())));
    assert!(none["spectra"][0]["disaggregation"].is_null());
    assert!(!head_of_table(&study).contains("level_p50") && !sheets(&study).contains("Influence"));

    study.uplift(&["influence", "r.h5", "-q"]).ok();
    study.uplift(&["measures", "r.h5", "-q"]).ok();
    study.uplift(&EXPORT).ok();
    let some = json(&study);
    // as the table beside the result has them
    let table = std::fs::read_to_string(study.path().join("r.influence.csv")).unwrap();
    let influence = some["influence"].as_array().unwrap();
    assert_eq!(influence.len(), table.lines().count() - 1);
    for (row, line) in influence.iter().zip(table.lines().skip(1)) {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!((row["site"].as_str().unwrap(), row["record"].as_str().unwrap()), (cells[0], cells[4]));
        assert_eq!(row["mean_change_pct"].as_f64(), cells[5].parse::<f64>().ok().filter(|value| value.is_finite()));
    }
    let of = &some["spectra"][0]["disaggregation"];
    assert_eq!(of["level_from"].as_array().unwrap().len(), 6);
    let shares: Vec<Vec<Option<f64>>> = serde_json::from_value(of["share"].clone()).unwrap();
    let sums: Vec<f64> = shares.iter().filter_map(|shares| shares.iter().copied().sum::<Option<f64>>()).collect();
    assert!(sums.len() > 5 && sums.iter().all(|sum| (sum - 1.0).abs() < 1e-9), "{sums:?}");
    let efficiency = some["efficiency"].as_array().unwrap();
    assert_eq!((efficiency.len(), efficiency[0]["dispersion_rocking"].as_array().unwrap().len()), (2, 10));
    assert!(efficiency[0]["trends"][0]["p_value"].as_array().unwrap().len() == 10, "{}", efficiency[0]);
    let head = head_of_table(&study);
    assert!(head.ends_with("level_p05,level_p50,level_p95,dispersion_rocking,dispersion_initiation"), "{head}");
    for name in ["share_pgv", "bin_pga", "u_without_pgv_m", "record", "dispersion_rocking_pga", "p_value_magnitude_pgv"]
    {
        assert!(matlab_has(&study, name), "{name}");
    }
    let sheets = sheets(&study);
    for name in ["Influence", "Disaggregation", "Efficiency", "Flags and tails"] {
        assert!(sheets.contains(&format!("name=\"{name}\"")), "{name}: {sheets}");
    }

    // the influence is of the probabilities of the study, the efficiency of the stripes
    study.uplift(&[&EXPORT[..], &["--poe", "0.05"]].concat()).ok();
    let asked = json(&study);
    assert_eq!(asked["influence"], Value::Array(Vec::new()));
    assert_eq!(asked["efficiency"], some["efficiency"]);
}
