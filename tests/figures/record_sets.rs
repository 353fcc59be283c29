//! The embedded set beside real records, and the dissertation's design tables beside ours.

use serde_json::Value;

use super::marks::hold;
use super::{ordinates, range, with_real_records};
use crate::common::{real_records, repository, uplift};

/// Ordinates of 2 % in 50 years, embedded set over real set, over the six sites (docs/synthetic-motions.md).
#[test]
fn spectra_of_the_embedded_set_over_real_ones() {
    let Some(real) = with_real_records() else { return };
    let folder = tempfile::tempdir().unwrap();
    let study = repository().join("configs/europe.toml").to_str().unwrap().to_owned();
    let spectra = |records: &[String]| {
        let run = ["run", &study, "-o", "r.h5", "-q", "--set", "risk.maf_surface=false", "--set"].map(str::to_owned);
        let strengths = ["strengths.values=[0.05, 0.1, 0.2, 0.3, 0.5]".to_owned()];
        uplift(folder.path(), &[&run[..], &strengths, records].concat()).ok();
        ordinates(&folder.path().join("r.urs.csv"))
    };
    let (embedded, real) = (spectra(&[]), spectra(&real));
    let mut computed = Vec::new();
    for (im, strength) in ["PGV", "PGA"].into_iter().flat_map(|im| [0.05, 0.1, 0.2, 0.3, 0.5].map(|eta| (im, eta))) {
        let both = embedded
            .iter()
            .zip(&real)
            .filter(|(row, _)| row.im == im && (row.strength - strength).abs() < 1e-9 && (row.poe - 0.02).abs() < 1e-9);
        let [low, high] = range(both.map(|(ours, real)| ours.u_m / real.u_m));
        computed.push((format!("embedded-set.{im}.{strength}"), format!("{low:.2}–{high:.2}")));
    }
    hold("embedded-set", &computed);
}

/// How many of the printed values lie in our range, by rule, way of scaling and quantity: what differs of a study's
/// `settings` leaves the designs as they are.
fn held(config: &str, settings: &[&str], reference: &str) -> Option<Vec<(String, String)>> {
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
    let mut counts: Vec<(String, usize)> = Vec::new();
    for row in rows.iter().filter(|row| !row["reference"].is_null()) {
        let word = |key: &str| row[key].as_str().unwrap_or("block").to_owned();
        let name = [word("rule"), word("scaled_by"), word("quantity")].join(".");
        let place = counts.iter().position(|(known, _)| *known == name).unwrap_or_else(|| {
            counts.push((name, 0));
            counts.len() - 1
        });
        counts[place].1 += usize::from(row["within"] == true);
    }
    Some(counts.into_iter().map(|(name, count)| (name, count.to_string())).collect())
}

/// Tables 3.2 to 3.7 (docs/displacement-spectra.md).
#[test]
fn designs_of_chapter_3_that_hold_the_printed_ones() {
    let least = ["strengths.values=0.1", "oscillator.capacity_m=[inf]", "oscillator.uplift_displacement_m=0.0005"];
    let reference = "tests/reference/tables_3_2_to_3_7.csv";
    let Some(held) = held("configs/chapter-3.toml", &least, reference) else { return };
    let computed: Vec<_> = held.into_iter().map(|(name, count)| (format!("tables-3.{name}"), count)).collect();
    hold("tables-3", &computed);
}

/// Tables 2.1 to 2.3 (docs/displacement-spectra.md).
#[test]
#[ignore = "minutes: make doc-figures"]
fn designs_of_chapter_2_that_hold_the_printed_ones() {
    let reference = "tests/reference/tables_2_1_to_2_3.csv";
    let Some(held) = held("configs/chapter-2.toml", &["block.height_m=10"], reference) else { return };
    let computed = held.into_iter().filter(|(name, _)| !name.ends_with("error_pct"));
    let computed: Vec<_> = computed.map(|(name, count)| (format!("tables-2.{name}"), count)).collect();
    hold("tables-2", &computed);
}
