//! The figures of the documents that come from runs of the program: computed again, and compared as they are printed.
//!
//! A figure stands between `<!-- figure: NAME -->` and `<!-- end -->`. Its name begins with the source that computes
//! it; `UPDATE_DOCS=1` writes what a source found. What takes seconds is part of `make test-long`, what
//! takes minutes of `make doc-figures`. Times and sizes are no figures of this kind: they name their machine and day.
//!
//! Last digits belong to a machine's mathematical functions: other machines than the one below skip all of it.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

mod base_widths;
mod conditioning;
mod consistency;
mod coverage;
mod design_tables;
mod designs;
mod embedded_set;
mod fixed_step;
mod frames;
mod hazard_curves;
mod images;
mod influence;
mod level_grids;
mod marks;
mod newmark;
mod published_criteria;
mod record_sets;
mod rounding_of_ordinates;
mod shake_table;
mod table_4_1;
mod table_4_2;
mod two_solvers;
mod uplift_and_impacts;
mod validation;
mod worked_pier;

use std::path::Path;

use uplift::events::Silent;
use uplift::inputs::{RecordSets, read_record_sets};
use uplift_motion::RecordPair;
use uplift_study::{AnyStudy, Study};

use crate::common::{command, python, real_records, repository};

/// The options that make a study run on the 105 real records.
fn with_real_records() -> Option<[String; 4]> {
    let manifest = real_records()?.join("manifest.csv");
    let set = |key: &str| ["--set".to_owned(), key.to_owned()];
    let [[a, b], [c, d]] = [set(&format!("records.manifest={}", manifest.display())), set("records.tag=ord105")];
    Some([a, b, c, d])
}

/// The record sets of Chapter 3 (configs/chapter-3.toml) of the real records.
fn real_record_sets() -> Option<RecordSets> {
    record_sets(&[])
}

/// The pairs of the 105 real records.
fn real_pairs() -> Option<Vec<RecordPair>> {
    let sets = record_sets(&["record_sets=[{ name = \"real\", tag = \"ord105\" }]".to_owned()])?;
    Some(sets.records_of(&sets.sets[0]).map(|record| record.pair.clone()).collect())
}

fn record_sets(settings: &[String]) -> Option<RecordSets> {
    let manifest = format!("records.manifest={}", real_records()?.join("manifest.csv").display());
    let file = repository().join("configs/chapter-3.toml");
    match Study::load_any(&file, &[&[manifest], settings].concat()).unwrap() {
        AnyStudy::Displacement(study) => Some(read_record_sets(&study, &Silent).unwrap()),
        _ => panic!("{} is of another kind", file.display()),
    }
}

#[test]
#[ignore = "long: make test-long"]
fn the_gallery_shows_what_is_printed() {
    let Some(python) = python() else { return };
    let program = command(repository()).get_program().to_owned();
    let mut compared = std::process::Command::new(python);
    compared.arg(repository().join("tests/outputs")).arg("--program").arg(program).arg("docs/gallery.md");
    let output = compared.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}

/// A spectrum's ordinates as a `.urs.csv` has them: site, measure, probability, strength, displacement in m.
struct Ordinate {
    site: String,
    im: String,
    poe: f64,
    strength: f64,
    u_m: f64,
}

fn ordinates(csv: &Path) -> Vec<Ordinate> {
    let text = std::fs::read_to_string(csv).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |cell: usize| cells[cell].parse::<f64>().unwrap();
        Ordinate {
            site: cells[0].to_owned(),
            im: cells[1].to_owned(),
            poe: number(2),
            strength: number(4),
            u_m: number(5),
        }
    };
    text.lines().skip(1).map(row).collect()
}

/// The quantile of values, linear between order statistics.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
fn quantile(values: &[f64], level: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = level * (sorted.len() - 1) as f64;
    let below = sorted[place.floor() as usize];
    below + place.fract() * (sorted[place.ceil() as usize] - below)
}

/// Smallest and largest.
fn range(values: impl IntoIterator<Item = f64>) -> [f64; 2] {
    values.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

/// A percentage with its sign, `−3` or `+9`.
fn signed(relative: f64) -> String {
    match (100.0 * relative).round() {
        0.0 => "0".to_owned(),
        percent if percent < 0.0 => format!("−{}", -percent),
        percent => format!("+{percent}"),
    }
}
