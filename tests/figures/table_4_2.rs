//! Table 4.2 beside ours (docs/comparison.md).

use serde_json::Value;

use super::marks::hold;
use super::{range, with_real_records};
use crate::common::{repository, uplift};

/// Rows of `uplift table` for configs/table-4-2.toml, with these options.
fn rows(set: &[String]) -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let (study, reference) = ("configs/table-4-2.toml", "tests/reference/table_4_2.csv");
    let [study, reference] = [study, reference].map(|file| repository().join(file).to_str().unwrap().to_owned());
    let run = ["run", &study, "-o", "t.h5", "-q"].map(str::to_owned);
    uplift(folder.path(), &[&run[..], set].concat()).ok();
    let table = uplift(folder.path(), &["table", "t.h5", "--reference", &reference, "--json"]).ok();
    serde_json::from_str::<Value>(&table.stdout).unwrap()["rows"].as_array().unwrap().clone()
}

fn ratios(rows: &[Value]) -> String {
    let [lowest, highest] = range(rows.iter().filter_map(|row| row["median_ratio"].as_f64()));
    format!("{lowest:.2} to {highest:.2}")
}

/// Sites whose c2 is on its bound for a probability.
fn on_the_bound(rows: &[Value], poe: f64) -> String {
    let sites: Vec<&str> = (rows.iter())
        .filter(|row| row["poe"] == poe && row["c2"] == 0.0)
        .map(|row| match row["site"].as_str().unwrap() {
            "Focsani" => "Focşani",
            site => site,
        })
        .collect();
    match &sites[..] {
        [] => "none".to_owned(),
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        [only, ..] => (*only).to_owned(),
    }
}

#[test]
#[ignore = "long: make test-long"]
fn ours_beside_the_dissertation() {
    let Some(set) = with_real_records() else { return };
    let (synthetic, real) = (rows(&[]), rows(&set));
    let name = |name: &str| format!("table-4-2.{name}");
    hold(
        "table-4-2",
        &[
            (name("synthetic"), ratios(&synthetic)),
            (name("real"), ratios(&real)),
            (name("compared"), real.iter().filter(|row| row["median_ratio"].is_number()).count().to_string()),
            (name("bound-2"), on_the_bound(&real, 0.02)),
            (name("bound-10"), on_the_bound(&real, 0.1)),
            (name("bound-50"), on_the_bound(&real, 0.5)),
        ],
    );
}
