//! Our order of the tests of Chapter 6 beside the printed one (docs/shake-table.md), real records.

use super::marks::hold;
use crate::shake_table::order_of_chapter_6;

#[test]
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
