//! The order of the tests on the shaking table is the model's own prediction of its time, from low to high response:
//! the only numbers of it that are printed. Ours, with real records, must put the tests in much the same order.

use std::collections::BTreeMap;
use std::path::Path;

use uplift_frame::{ColumnShape, GroundMotion, Model, Options, RockingFrame, TableLevel, respond};
use uplift_motion::{Accelerogram, ReadOptions, read_path};
use uplift_statics::{Parts, Restrainer, TendonPath};
use uplift_structure::Geometry;
use uplift_validation::pairs::spearman;

/// The specimen of Section 6.8: 2R = 1.463 m, α = 0.1359, weights of 1.22 and 94.35 kN, 1720 kN/m.
fn specimen() -> RockingFrame {
    let gravity = 9.81;
    let column = Geometry::from_slenderness_and_size(0.1359, 0.7315).unwrap();
    RockingFrame::new(column, 4, 1220.0 / gravity, 94_350.0 / gravity, ColumnShape::Cylinder, gravity)
        .unwrap()
        .with_restrainer(Restrainer::new(Parts::linear(1720e3)).unwrap(), TendonPath::Column)
        .unwrap()
}

fn lines(text: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    text.lines().filter(|line| !line.starts_with('#')).skip(1).map(|line| line.split(',').collect())
}

/// Both horizontal components of each record sequence number of a manifest.
fn records(folder: &Path) -> BTreeMap<String, [Accelerogram; 2]> {
    let manifest = std::fs::read_to_string(folder.join("manifest.csv")).unwrap();
    let wanted: Vec<&str> =
        lines(include_str!("../../../configs/shake-table/excitations.csv")).map(|row| row[2]).collect();
    let read = |file: &str| read_path(&folder.join(file), &ReadOptions::default()).unwrap();
    let mut found = BTreeMap::new();
    for line in manifest.lines().skip(1) {
        // names of stations may have commas, but the number stands before them and paths have none
        let rsn = line.split(',').nth(1).unwrap();
        let files: Vec<&str> = line.split(',').filter(|field| field.contains('/')).collect();
        if wanted.contains(&rsn) {
            found.insert(rsn.to_owned(), [read(files[0]), read(files[1])]);
        }
    }
    found
}

#[test]
fn the_predicted_order_is_that_of_the_tests() {
    let Some(folder) = std::env::var_os("UPLIFT_RECORDS") else {
        println!("skipped: no real records (set UPLIFT_RECORDS)");
        return;
    };
    let (records, frame) = (records(Path::new(&folder)), specimen());
    let mut printed: BTreeMap<(&str, &str), f64> = BTreeMap::new();
    for (place, row) in lines(include_str!("../../../tests/reference/table_a1_1.csv")).enumerate() {
        printed.entry((row[0], row[1])).or_insert(place as f64);
    }
    let (mut order, mut predicted) = (Vec::new(), Vec::new());
    for row in lines(include_str!("../../../configs/shake-table/excitations.csv")) {
        let Some([x, y]) = records.get(row[2]) else { continue };
        for (level, pgv_m_s) in [("low", 0.1675), ("high", 0.335)] {
            let Some(place) = printed.get(&(level, row[0])) else { continue };
            let ([x, y], _) = TableLevel::new(5.0, pgv_m_s).unwrap().pair([x, y]).unwrap().unwrap();
            let found = respond(&frame, &GroundMotion::pair(&x, &y), Model::Wobbling, &Options::default()).unwrap();
            order.push(*place);
            predicted.push(found.displacement.value);
        }
    }
    let overturned = predicted.iter().filter(|u| u.is_infinite()).count();
    let correlation = spearman(&order, &predicted).unwrap();
    println!("{} tests, {overturned} overturned, Spearman {correlation:.3}", order.len());
    assert!(order.len() >= 60 && correlation >= 0.87, "{correlation} of {}", order.len());
    // those that never rock stand first
    let still: Vec<f64> = order.iter().zip(&predicted).filter(|(_, u)| **u < 1e-4).map(|(place, _)| *place).collect();
    let first = order.iter().filter(|place| **place <= still.iter().fold(0.0, |a, b| a.max(*b))).count();
    assert!(still.len() >= 3 && first <= still.len() + 2, "{} still, {first} first", still.len());
}
