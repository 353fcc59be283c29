//! Real record pairs against the peak values of their manifest.
//!
//! The records may not be redistributed: the test looks for them where the variable
//! `UPLIFT_RECORDS` points, else beside the repository, and is skipped where they are absent.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::collections::BTreeMap;
use std::path::PathBuf;

use uplift_motion::{
    Accelerogram, IntensityMeasure, ReadOptions, RecordPair, STANDARD_GRAVITY_M_S2, read_at2, read_path,
};

pub(crate) fn records_folder() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/records");
    let folder = std::env::var_os("UPLIFT_RECORDS").map_or_else(|| beside.into(), PathBuf::from);
    folder.join("manifest.csv").is_file().then_some(folder)
}

/// Cells of a line of CSV; a quoted cell may hold commas and doubled quotes.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    let mut chars = line.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '"' if quoted && chars.next_if_eq(&'"').is_some() => cells.last_mut().unwrap().push('"'),
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().unwrap().push(c),
        }
    }
    cells
}

pub(crate) fn rows(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut lines = text.lines();
    let names = cells(lines.next().unwrap());
    lines
        .map(|line| {
            let cells = cells(line);
            assert_eq!(cells.len(), names.len(), "{line}");
            names.iter().cloned().zip(cells).collect()
        })
        .collect()
}

/// The printed value, and half a unit of its last digit.
fn printed(text: &str) -> (f64, f64) {
    let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    (text.parse().unwrap(), 0.5 * 0.1_f64.powi(i32::try_from(decimals).unwrap()))
}

/// Deviation of `found` from a printed value, in units of the rounding of its last digit.
fn roundings(found: f64, text: &str) -> f64 {
    let (value, rounding) = printed(text);
    (found - value).abs() / rounding
}

#[test]
fn quoted_cells() {
    assert_eq!(cells(r#"a,"b, ""c""",,d"#), ["a", "b, \"c\"", "", "d"]);
}

#[test]
fn peaks_of_the_manifest() {
    let Some(folder) = records_folder() else {
        println!("skipped: no record folder (set UPLIFT_RECORDS)");
        return;
    };
    let rows = rows(&std::fs::read_to_string(folder.join("manifest.csv")).unwrap());
    assert_eq!(rows.len(), 138);

    let g = STANDARD_GRAVITY_M_S2;
    let options = ReadOptions::default();
    let mut worst = BTreeMap::<&str, (f64, String)>::new();
    let mut note = |what, deviation: f64, id: &str| {
        let entry = worst.entry(what).or_insert((0.0, String::new()));
        if deviation >= entry.0 {
            *entry = (deviation, id.to_owned());
        }
    };
    for row in &rows {
        let id = row["record_id"].as_str();
        let component = |h: &str| -> Accelerogram {
            let path = folder.join(&row[&format!("file_h{h}")]);
            let record = read_at2(&std::fs::read(&path).unwrap(), id, &options).unwrap();
            assert_eq!(read_path(&path, &options).unwrap(), record.accelerogram);
            let motion = record.accelerogram;
            assert_eq!(motion.len().to_string(), row[&format!("npts{h}")], "{id}");
            assert_eq!(motion.dt_s(), row[&format!("dt{h}")].parse::<f64>().unwrap(), "{id}");
            assert_eq!(record.header.lines.len(), 4, "{id}");
            motion
        };
        let pair = RecordPair { id: id.to_owned(), h1: component("1"), h2: component("2"), metadata: row.clone() };
        note("PGA h1", roundings(pair.h1.pga_m_s2() / g, &row["pga1_g"]), id);
        note("PGA h2", roundings(pair.h2.pga_m_s2() / g, &row["pga2_g"]), id);
        note("PGV h1", roundings(100.0 * pair.h1.pgv_m_s(), &row["pgv1_cms"]), id);
        note("PGV h2", roundings(100.0 * pair.h2.pgv_m_s(), &row["pgv2_cms"]), id);
        let pga = IntensityMeasure::Pga.pair_value(&pair, g);
        let pgv = IntensityMeasure::Pgv.pair_value(&pair, g);
        note("PGA geomean", roundings(pga, &row["geomean_pga_g"]), id);
        note("PGV geomean", roundings(pgv, &row["geomean_pgv_cms"]), id);
        // The manifest gives the longer of the two components, and counts in whole samples: each
        // of the two moments may lie one step beside ours.
        let step_s = pair.h1.dt_s().max(pair.h2.dt_s());
        let longer = |f: fn(&Accelerogram) -> f64| f(&pair.h1).max(f(&pair.h2));
        for (what, found_s, text) in [
            ("D5-75 [2 time steps]", longer(Accelerogram::d5_75_s), &row["ds5_75_s"]),
            ("D5-95 [2 time steps]", longer(Accelerogram::d5_95_s), &row["ds5_95_s"]),
        ] {
            let (value_s, rounding_s) = printed(text);
            note(what, ((found_s - value_s).abs() - rounding_s).max(0.0) / (2.0 * step_s), id);
        }
    }
    for (what, (deviation, id)) in &worst {
        println!("{what}: deviates by at most {deviation:.4} ({id})");
        // 1 is half a unit of the last printed digit, the rounding of a correct value (or two
        // time steps, see above); the rest is for the binary representation of a half.
        assert!(*deviation <= 1.0 + 1e-6, "{what}: {deviation} ({id})");
    }
    assert_eq!(worst.len(), 8);
}
