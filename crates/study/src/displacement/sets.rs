//! The ground motions of a study of displacement spectra, and the sets that they make.

use super::super::document::Value;
use super::super::paths::Folders;
use super::super::reader::{Field, LARGEST_INTEGER, Section, optional};
use super::super::records::{self, NO_TAG};
use super::super::resolved::RecordSource;
use super::super::selection;
use super::super::sites::unique_name;
use super::{SetPlan, SetRecords};

/// Most sets in one study.
const MOST_SETS: usize = 100;

/// Reads the section `[records]`.
pub(super) fn records(mut section: Section<'_>, folders: &Folders) -> Option<SetRecords> {
    let manifest_field = section.field("manifest");
    let tag_field = section.field("tag");
    let first_field = section.field("first");
    let select = selection::read(section.section("select"));
    let synthetic = records::synthetic(section.section("synthetic"));
    section.finish();
    if let Some(field) = tag_field {
        let help = if manifest_field.is_some() {
            "write a section [[record_sets]] with a name and this tag; or one for each of several sets"
        } else {
            NO_TAG
        };
        field.mistake("tags are given set by set", help);
    }
    let first = optional(first_field.as_ref(), |field| field.integer(1, LARGEST_INTEGER));
    let source = if let Some(field) = manifest_field {
        folders.input(&field).map(|manifest| RecordSource::Manifest { manifest, tag: None })
    } else {
        records::enough(first_field.as_ref(), first, synthetic);
        synthetic.map(|(pairs, seed)| RecordSource::Synthetic { pairs, seed })
    };
    Some(SetRecords { source: source?, select: select?, first: first? })
}

/// Reads the sections `[[record_sets]]`.
pub(super) fn read(field: Option<Field<'_>>) -> Option<Vec<SetPlan>> {
    let Some(field) = field else {
        return Some(Vec::new());
    };
    let Value::List(_) = field.node.value else {
        return field.wrong_type("a list of sections", "head each set with [[record_sets]], in double brackets");
    };
    let items = field.items();
    if items.len() > MOST_SETS {
        field.mistake(format!("there are {} record sets", items.len()), format!("give at most {MOST_SETS}"));
        return None;
    }
    let mut names = Vec::new();
    let sets: Vec<Option<SetPlan>> = items.iter().map(|item| set(item, &mut names)).collect();
    sets.into_iter().collect()
}

fn set(item: &Field<'_>, names: &mut Vec<String>) -> Option<SetPlan> {
    let mut section = item.section();
    if !section.is_present() {
        return None;
    }
    let name = unique_name(&mut section, "record set", "far-field", names);
    let tag_field = section.field("tag");
    let tag = optional(tag_field.as_ref(), |field| field.filled_text().map(str::to_owned));
    let leave_out = section.field("leave_out").map_or(Some(Vec::new()), |field| {
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
