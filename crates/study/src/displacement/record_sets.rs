//! The sections `[[record_sets]]`: the sets that the ground motions make.

use serde::Serialize;
use serde_json::json;

use crate::keys::{Key, SectionKeys, Shape, Special, Text, special, text};
use crate::reading::{Field, LARGEST_INTEGER, Value, optional};
use crate::sections::name;

pub(super) const KEYS: SectionKeys = SectionKeys::new("record_sets", &[&NAME, &TAG, &LEAVE_OUT]).shape(Shape::List);
const NAME: Key<Text> = name::KEY.meaning("name of the set").note("each once, as names of sites");
const TAG: Key<Text> = text("tag").without_default("all rows").meaning("only rows whose `set_tags` contain it");
const LEAVE_OUT: Key<Special> = special("leave_out", records)
    .without_default("none")
    .meaning("records that do not belong to the set: identifiers or record sequence numbers, `829` or `\"RSN829\"`")
    .note("one that is not in the set is noted");

/// Records as a JSON Schema.
fn records() -> serde_json::Value {
    let each = json!({ "type": ["string", "integer"], "minLength": 1, "minimum": 0 });
    json!({ "anyOf": [each, { "type": "array", "items": each }] })
}

/// A record set.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SetPlan {
    /// Its name, of no other set.
    pub name: String,
    /// Only rows of the manifest whose `set_tags` contain it; all rows if none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tag: Option<String>,
    /// Records that do not belong to it, by identifier or record sequence number.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub leave_out: Vec<String>,
}

/// Most sets in one study.
const MOST_SETS: usize = 100;

/// Reads the sections `[[record_sets]]`.
pub(super) fn read(field: Option<Field<'_>>) -> Option<Vec<SetPlan>> {
    let Some(field) = field else { return Some(Vec::new()) };
    let mut names = Vec::new();
    field.sections("set", 0..=MOST_SETS, |item| set(&item, &mut names))
}

fn set(item: &Field<'_>, names: &mut Vec<String>) -> Option<SetPlan> {
    let mut section = item.section();
    if !section.is_present() {
        return None;
    }
    let name = name::read(&mut section, "record set", "far-field", names);
    let tag_field = section.given(&TAG);
    let tag = optional(tag_field.as_ref(), |field| field.filled_text().map(str::to_owned));
    let leave_out = section.given(&LEAVE_OUT).map_or(Some(Vec::new()), |field| {
        let records: Vec<Option<String>> = field.items().iter().map(record).collect();
        records.into_iter().collect()
    });
    section.finish();
    Some(SetPlan { name: name?, tag: tag?, leave_out: leave_out? })
}

/// An identifier, or a record sequence number with or without RSN before it.
fn record(item: &Field<'_>) -> Option<String> {
    match item.node.value {
        Value::Integer(_) => item.integer(0, LARGEST_INTEGER).map(|number| number.to_string()),
        Value::Text(_) => item.filled_text().map(|text| text.trim().to_owned()),
        _ => item.wrong_type("a record", "write its identifier in double quotes, or its sequence number (RSN)"),
    }
}
