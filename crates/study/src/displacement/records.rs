//! The section `[records]`: the ground motions that there are to choose from.

use std::path::Path;

use serde::{Serialize, Serializer};
use serde_json::json;

use crate::keys::{Boolean, File, Integer, Key, SectionKeys, Special, boolean, integer, special};
use crate::reading::{LARGEST_INTEGER, Paths, Section, optional};
use crate::sections::record_source::{self, DUPLICATES, Duplicates, NO_TAG, RecordSource, Synthetic};
use crate::sections::selection::{self, RecordSelection};

pub(crate) const KEYS: SectionKeys = SectionKeys::new("records", &[&MANIFEST, &VERTICAL, &FIRST, &DUPLICATES, &SELECT]);
const MANIFEST: Key<File> = record_source::MANIFEST.without_default("none: synthetic records");
const VERTICAL: Key<Boolean> = boolean("vertical")
    .with_default(false)
    .meaning(
        "whether the third component of the records (`file_v` of the manifest) shakes blocks and frames too, scaled as \
         the horizontal ones",
    )
    .note("not for synthetic records");
const FIRST: Key<Integer> = integer("first", 1, LARGEST_INTEGER)
    .without_default("all")
    .meaning("use only so many of the records of each set, the first");
const SELECT: Key<Special> = special("select", || json!({}))
    .without_default("all")
    .meaning("only such records, in every set; keys as in every study");

/// What to do about a tag where there are sets.
pub(super) const SETS_HAVE_TAGS: &str =
    "write a section [[record_sets]] with a name and this tag; or one for each of several sets";

/// Which ground motions there are to choose from.
#[derive(Debug, Clone, PartialEq)]
pub struct SetRecords {
    /// Where they come from; the tag is that of a set, not of them all.
    pub source: RecordSource,
    /// Whether the third component shakes what feels it.
    pub vertical: bool,
    /// Which of them are used, in every set.
    pub select: RecordSelection,
    /// Use only so many of the records of each set, the first; all if none.
    pub first: Option<u64>,
    /// What is done where two of a set are the same motion.
    pub duplicates: Duplicates,
}

impl SetRecords {
    /// The manifest, if the records are of one.
    pub fn manifest(&self) -> Option<&Path> {
        self.source.manifest()
    }
}

/// As the section of a study file.
impl Serialize for SetRecords {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a> {
            #[serde(skip_serializing_if = "Option::is_none")]
            manifest: Option<&'a Path>,
            #[serde(skip_serializing_if = "std::ops::Not::not")]
            vertical: bool,
            #[serde(skip_serializing_if = "Option::is_none")]
            first: Option<u64>,
            #[serde(skip_serializing_if = "Duplicates::is_default")]
            duplicates: Duplicates,
            #[serde(skip_serializing_if = "RecordSelection::is_empty")]
            select: &'a RecordSelection,
            #[serde(skip_serializing_if = "Option::is_none")]
            synthetic: Option<Synthetic>,
        }
        let written = Written {
            manifest: self.source.manifest(),
            vertical: self.vertical,
            first: self.first,
            duplicates: self.duplicates,
            select: &self.select,
            synthetic: self.source.synthetic(),
        };
        written.serialize(serializer)
    }
}

/// Reads the section; `instead_of_tag` is what to do where a tag is given.
pub(crate) fn read(mut section: Section<'_>, paths: &Paths, instead_of_tag: &str) -> Option<SetRecords> {
    let manifest_field = section.given(&MANIFEST);
    let tag_field = section.field("tag");
    let vertical_field = section.given(&VERTICAL);
    let vertical = section.read(&VERTICAL);
    record_source::vertical_is_recorded(vertical_field.as_ref(), vertical, manifest_field.is_some());
    let first_field = section.given(&FIRST);
    let duplicates = section.read(&DUPLICATES);
    let select = selection::read(section.section("select"));
    let synthetic = record_source::synthetic(section.section("synthetic"));
    section.finish();
    if let Some(field) = tag_field {
        let help = if manifest_field.is_some() { instead_of_tag } else { NO_TAG };
        field.mistake("tags are given set by set", help);
    }
    let first = optional(first_field.as_ref(), |field| FIRST.read(field));
    let source = if let Some(field) = manifest_field {
        paths.input(&field).map(|manifest| RecordSource::Manifest { manifest, tag: None })
    } else {
        record_source::enough(first_field.as_ref(), first, synthetic);
        synthetic.map(RecordSource::from)
    };
    Some(SetRecords { source: source?, vertical: vertical?, select: select?, first: first?, duplicates: duplicates? })
}
