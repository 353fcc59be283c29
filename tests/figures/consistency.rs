//! What the sets of Chapter 4 bring of the other measure, and what the repair does (docs/method.md, section 18).

use serde_json::Value;

use super::marks::hold;
use super::{range, with_real_records};
use crate::common::{array, repository, uplift};

#[test]
#[ignore = "long: make test-long"]
fn of_the_real_records() {
    let Some(set) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml");
    let run = ["run", study.to_str().unwrap(), "-o", "r.h5", "-q"];
    let settings = [
        "strengths.values=[0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1]",
        "pgv.levels_cm_s=[\"1:0.5:20\", \"25:5:200\"]",
        "risk.maf_surface=false",
        "consistency.repair=weights",
    ];
    let settings: Vec<String> = settings.iter().flat_map(|key| ["--set".to_owned(), (*key).to_owned()]).collect();
    uplift(folder.path(), &[&run.map(str::to_owned)[..], &set[..], &settings[..]].concat()).ok();
    let report = uplift(folder.path(), &["consistency", "r.h5", "--json", "-q"]).ok();
    let report: Value = serde_json::from_str(&report.stdout).unwrap();
    let biases = |scaled_to: &str| {
        let rows = report["rows"].as_array().unwrap().iter().filter(|row| row["scaled_to"] == scaled_to);
        let [lowest, highest] = range(rows.filter_map(|row| row["bias"].as_f64()));
        format!("{lowest:.1} to {highest:.1}")
    };
    let all = report["agreement"].as_array().unwrap().last().unwrap();
    let agreement = |key: &str| {
        let [mean, least, most] = [1, 2, 3].map(|place| all[key][place].as_f64().unwrap());
        format!("{mean:.2} ({least:.2} to {most:.2})")
    };
    // samples that no weights mend, by their size
    uplift(folder.path(), &["bootstrap", "r.h5", "-q", "--sizes", "20,40,105"]).ok();
    let failed = |im: &str| {
        let shares = array(&folder.path().join("r.h5"), &format!("/bootstrap/{im}/consistent/failed"));
        let of_size = |size: usize| {
            let [least, most] = range(shares.iter().skip(size).step_by(3).copied());
            let [least, most] = [least, most].map(|share| format!("{:.0}", 100.0 * share));
            if least == most { most } else { format!("{least} to {most}") }
        };
        format!("{}, {} and {} %", of_size(2), of_size(1), of_size(0))
    };
    let computed = [
        ("failed-pgv", failed("pgv")),
        ("failed-pga", failed("pga")),
        ("bias-pga", biases("PGA")),
        ("bias-pgv", biases("PGV")),
        ("plain", agreement("plain")),
        ("repaired", agreement("repaired")),
    ];
    hold("consistency", &computed.map(|(name, value)| (format!("consistency.{name}"), value)));
}
