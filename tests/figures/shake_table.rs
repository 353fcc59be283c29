//! Our order of the tests of Chapter 6 beside the printed one (docs/comparison.md), real records.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::marks::hold;
use super::quantile;
use crate::common::repository;
use crate::shake_table::{order_of_chapter_6, tests_of_chapter_6};

#[test]
#[ignore = "long: make test-long"]
fn the_printed_order() {
    let Some(agreement) = order_of_chapter_6() else { return };
    let name = |what: &str| format!("shake-table.{what}");
    let correlation = |value: &serde_json::Value| format!("{:.2}", value.as_f64().unwrap());
    let mut computed =
        vec![(name("tests"), agreement["tests"].to_string()), (name("all"), correlation(&agreement["spearman"]))];
    for level in agreement["by_level"].as_array().unwrap() {
        let of = level[0].as_str().unwrap();
        computed.push((name(&format!("{of}-tests")), level[1].to_string()));
        computed.push((name(of), correlation(&level[2])));
    }
    hold("shake-table", &computed);
}

/// PGA on the table at the high level beside the printed column of Table A1.1.
#[test]
#[ignore = "long: make test-long"]
fn the_printed_peaks() {
    let Some(tests) = tests_of_chapter_6() else { return };
    let printed = std::fs::read_to_string(repository().join("tests/reference/table_a1_1_pga.csv")).unwrap();
    let rows = printed.lines().filter(|line| !line.starts_with('#')).skip(1);
    let printed: BTreeMap<&str, f64> =
        rows.map(|row| row.split_once(',').unwrap()).map(|(id, pga)| (id, pga.parse().unwrap())).collect();
    let high = tests.iter().filter(|test| test["level"] == "high");
    let found: Vec<(&str, &str, f64, f64)> = high
        .map(|test| {
            let pga_g = test["pga_srss_m_s2"].parse::<f64>().unwrap() / 9.806_65;
            (test["exc_id"].as_str(), test["rsn"].as_str(), printed[test["exc_id"].as_str()], pga_g)
        })
        .collect();
    let ratios: Vec<f64> = found.iter().map(|(_, _, printed, ours)| ours / printed).collect();
    let near = ratios.iter().filter(|ratio| (**ratio - 1.0).abs() <= 0.05).count();
    // the median says that the definition is the printed one: a geometric mean would be 0.7 of it
    assert!(found.len() >= 55 && (quantile(&ratios, 0.5) - 1.0).abs() < 0.03, "{ratios:?}");
    let mut table = format!("\n{0}{0}|\n{1}|\n", "| exc. | RSN | printed, g | ours, g ", "|---".repeat(8));
    for pair in found.chunks(2) {
        for (id, rsn, printed, ours) in pair {
            write!(table, "| {id} | {rsn} | {printed:.2} | {ours:.2} ").unwrap();
        }
        table.push_str(if pair.len() == 2 { "|\n" } else { "| | | | |\n" });
    }
    let two = |value: f64| format!("{value:.2}");
    hold(
        "shake-table-pga",
        &[
            ("shake-table-pga.pairs".to_owned(), found.len().to_string()),
            ("shake-table-pga.median".to_owned(), two(quantile(&ratios, 0.5))),
            ("shake-table-pga.low".to_owned(), two(quantile(&ratios, 0.16))),
            ("shake-table-pga.high".to_owned(), two(quantile(&ratios, 0.84))),
            ("shake-table-pga.near".to_owned(), near.to_string()),
            ("shake-table-pga.table".to_owned(), table),
        ],
    );
}
