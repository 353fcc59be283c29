//! The dissertation's design tables beside ours (docs/comparison.md).

use std::collections::BTreeMap;

use serde_json::Value;

use super::marks::hold;
use crate::common::{real_records, repository, uplift};

const CHAPTER_3: &str = "tests/reference/tables_3_2_to_3_7.csv";
const CHAPTER_2: &str = "tests/reference/tables_2_1_to_2_3.csv";
/// The width of the columns, m, below which no design goes.
const WIDTH_M: f64 = 1.6;

/// The printed medians of the zero-stiffness oscillator, m, by record set and scaling.
pub fn printed_medians() -> BTreeMap<(String, String), f64> {
    let text = std::fs::read_to_string(repository().join(CHAPTER_3)).unwrap();
    let rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    rows.filter(|cells| cells[0] == "ED" && cells[3] == "u_dem_rule_m")
        .map(|cells| ((cells[1].to_owned(), cells[2].to_owned()), cells[4].parse().unwrap()))
        .collect()
}

/// A printed value beside ours.
struct Row {
    /// `ED`, `EE` or `block`.
    rule: String,
    by: String,
    quantity: String,
    /// Set and scaling, as the documents write them.
    place: String,
    printed: f64,
    value: f64,
    /// Lowest and highest within one percent.
    ends: [f64; 2],
    held: bool,
}

/// The rows of `uplift table` with a reference: what differs of a study's `settings` leaves the designs as they are.
fn rows(config: &str, settings: &[&str], reference: &str) -> Option<Vec<Row>> {
    let manifest = format!("records.manifest={}", real_records()?.join("manifest.csv").display());
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join(config).to_str().unwrap().to_owned();
    let mut run = vec!["run", &study, "-o", "r.h5", "-q", "--set", &manifest];
    run.extend(settings.iter().flat_map(|setting| ["--set", setting]));
    uplift(folder.path(), &run).ok();
    let reference = repository().join(reference).to_str().unwrap().to_owned();
    let table = uplift(folder.path(), &["table", "r.h5", "--reference", &reference, "--json"]).ok().stdout;
    let table: Value = serde_json::from_str(&table).unwrap();
    let rows = table["rows"].as_array().unwrap().clone();
    let row = |row: &Value| {
        let word = |key: &str| row[key].as_str().unwrap_or("block").to_owned();
        let number = |key: &str| row[key].as_f64().unwrap_or(f64::NAN);
        let set = word("record_set");
        let scaling = word("scaling").replace("PG", " PG").replace(".0 ", " ").replace("  ", " ");
        Row {
            rule: word("rule"),
            by: word("scaled_by"),
            quantity: word("quantity"),
            place: format!("{} {scaling}", set.trim_start_matches("near-field ")),
            printed: number("reference"),
            value: number("value"),
            ends: [number("lowest"), number("highest")],
            held: row["within"] == true,
        }
    };
    Some(rows.iter().filter(|row| !row["reference"].is_null()).map(row).collect())
}

/// How many of the printed values lie in our range, by rule, way of scaling and quantity.
fn held(rows: &[Row]) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for row in rows {
        *counts.entry([&*row.rule, &*row.by, &*row.quantity].join(".")).or_default() += usize::from(row.held);
    }
    counts
}

/// Rows of both ways of scaling: the same rule, place and quantity, by component and by record.
fn both_ways(rows: &[Row]) -> Vec<[&Row; 2]> {
    let by = |by: &'static str| rows.iter().filter(move |row| row.by == by);
    by("component")
        .filter_map(|row| {
            let same =
                |other: &&Row| (&other.rule, &other.place, &other.quantity) == (&row.rule, &row.place, &row.quantity);
            Some([row, by("record").find(same)?])
        })
        .collect()
}

/// Names, each once, with commas and an `and`.
fn listed(names: impl IntoIterator<Item = String>) -> String {
    let mut once: Vec<String> = Vec::new();
    for name in names {
        if !once.contains(&name) {
            once.push(name);
        }
    }
    match &once[..] {
        [] => "none".to_owned(),
        [only] => only.clone(),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}

/// Tables 3.2 to 3.7.
#[test]
#[ignore = "minutes: make doc-figures"]
fn designs_of_chapter_3_that_hold_the_printed_ones() {
    let least = ["strengths.values=0.1", "oscillator.capacity_m=[inf]", "oscillator.uplift_displacement_m=0.0005"];
    let Some(rows) = rows("configs/chapter-3.toml", &least, CHAPTER_3) else { return };
    let mut computed: Vec<_> = held(&rows).into_iter().map(|(name, count)| (name, count.to_string())).collect();
    let capacities: Vec<[&Row; 2]> =
        both_ways(&rows).into_iter().filter(|[row, _]| row.quantity == "u_cap_m").collect();
    let above: Vec<_> = capacities.iter().filter(|[row, _]| row.printed > WIDTH_M).collect();
    let met = |way: usize| above.iter().filter(|rows| rows[way].held).count().to_string();
    let demands: Vec<[&Row; 2]> =
        both_ways(&rows).into_iter().filter(|[row, _]| row.quantity == "u_dem_TH_m").collect();
    let outside = |ways: usize| {
        let some = demands.iter().filter(move |rows| rows.iter().filter(|row| !row.held).count() == ways);
        listed(some.map(|[row, _]| format!("{} (printed {:.3})", row.place, row.printed)))
    };
    computed.extend([
        ("at-width".to_owned(), (capacities.len() - above.len()).to_string()),
        ("columns".to_owned(), capacities.len().to_string()),
        ("above-width".to_owned(), above.len().to_string()),
        ("above-width.component".to_owned(), met(0)),
        ("above-width.record".to_owned(), met(1)),
        ("outside-both".to_owned(), outside(2)),
        ("outside-one".to_owned(), outside(1)),
    ]);
    let computed: Vec<_> = computed.into_iter().map(|(name, value)| (format!("tables-3.{name}"), value)).collect();
    hold("tables-3", &computed);
}

/// Tables 2.1 to 2.3.
#[test]
#[ignore = "minutes: make doc-figures"]
fn designs_of_chapter_2_that_hold_the_printed_ones() {
    let Some(rows) = rows("configs/chapter-2.toml", &["block.height_m=10"], CHAPTER_2) else { return };
    let mut computed: Vec<_> = held(&rows).into_iter().map(|(name, count)| (name, count.to_string())).collect();
    computed.retain(|(name, _)| !name.ends_with("error_pct"));
    // the PGV columns of Table 2.1, which are not those of a design
    for by in ["component", "record"] {
        let ours = rows.iter().filter(|row| {
            row.by == by
                && row.quantity == "tan_alpha_design"
                && row.place.starts_with("pulse-like")
                && row.place.ends_with("PGV")
        });
        computed.push((format!("pulse-like.{by}"), listed(ours.map(|row| format!("{:.3}", row.value)))));
    }
    let outside = both_ways(&rows).into_iter().filter(|rows| rows.iter().all(|row| !row.held));
    let said = outside.map(|[component, record]| {
        let name = match &*component.quantity {
            "tan_alpha_design" => "tan α_D",
            "u_2H1000_m" => "u at 1000 m",
            _ => "u at 10 m",
        };
        let range = |row: &Row| format!("{:.2}–{:.2}", row.ends[0], row.ends[1]);
        let (place, printed) = (&component.place, component.printed);
        let (component, record) = (range(component), range(record));
        format!("\n  - {place}, {name}: {printed} ({component} and {record})")
    });
    computed.push(("outside-both".to_owned(), said.collect::<String>() + "\n"));
    let computed: Vec<_> = computed.into_iter().map(|(name, value)| (format!("tables-2.{name}"), value)).collect();
    hold("tables-2", &computed);
}
