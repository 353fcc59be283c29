//! Characters that no text of a study may have.

use super::{Finding, Findings, Node, Table, Value};

/// Records a mistake for every text in `table` with a null character, which no result file can hold; `above` is the key
/// of the table, with a dot.
pub(crate) fn refuse_null_characters(table: &Table, above: &str, findings: &Findings) {
    for entry in &table.entries {
        look(&entry.node, &format!("{above}{}", entry.key), findings);
    }
}

fn look(node: &Node, key: &str, findings: &Findings) {
    match &node.value {
        Value::Text(text) if text.contains('\0') => findings.add(Finding {
            key: key.to_owned(),
            origin: node.origin.clone(),
            message: "the text holds a null character".to_owned(),
            help: Some("leave \\u0000 out: no result file can hold it".to_owned()),
        }),
        Value::List(items) => {
            items.iter().enumerate().for_each(|(index, item)| look(item, &format!("{key}[{index}]"), findings));
        }
        Value::Table(table) => refuse_null_characters(table, &format!("{key}."), findings),
        _ => {}
    }
}
