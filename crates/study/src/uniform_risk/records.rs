//! The section `[records]`: the ground motions.

use std::path::{Path, PathBuf};

use serde::{Serialize, Serializer};
use uplift_motion::{Combination, Component, Rotation};

use crate::keys::{Boolean, Choice, File, Integer, Key, SectionKeys, Text, boolean, choice, file, integer, text};
use crate::reading::{LARGEST_INTEGER, Paths, Section, optional};
use crate::sections::record_source::{self, DUPLICATES, Duplicates, MANIFEST, NO_TAG, RecordSource, Synthetic};
use crate::sections::selection::{self, RecordSelection};
use crate::uniform_risk::rotation;

pub(super) const KEYS: SectionKeys =
    SectionKeys::new("records", &[&MANIFEST, &TAG, &COMPONENT, &INTENSITY, &VERTICAL, &FIRST, &AT_LEVEL, &DUPLICATES]);
const TAG: Key<Text> = text("tag")
    .without_default("all rows")
    .meaning("use only rows of the manifest whose `set_tags` contain this")
    .note("only with `manifest`");
const COMPONENT: Key<Choice<Component>> =
    choice("component", &COMPONENTS, Component::key).with_default(Component::H1).meaning(
        "component that shakes the planar oscillator; `\"both\"` counts each as a record, `\"random\"` draws one for \
         each record, `\"rotated\"` turns the pair ([azimuths](#recordsrotation-azimuths))",
    );
const INTENSITY: Key<Choice<Combination>> =
    choice("intensity", &Combination::ALL, Combination::key).with_default(Combination::GeometricMean).meaning(
        "how the peaks of the two components make the PGV or PGA of a record: `\"geometric-mean\"` (Eq. 4.5, 4.6), \
         `\"rotd50\"` the median and `\"rotd100\"` the largest over all horizontal directions (Boore 2010; the \
         components must be synchronised)",
    );
const VERTICAL: Key<Boolean> = boolean("vertical")
    .with_default(false)
    .meaning(
        "whether the third component of the records (`file_v` of the manifest) shakes blocks and frames of structure \
         files too, scaled as the pair; oscillators do not feel it",
    )
    .note("not for synthetic records");
const FIRST: Key<Integer> = integer("first", 1, LARGEST_INTEGER)
    .without_default("all")
    .meaning("use only so many of the records that are selected, the first")
    .note("at most `pairs` of a synthetic set");
const AT_LEVEL: Key<File> = file("at_level")
    .without_default("every record at every level")
    .meaning(
        "a set of records for each level: table (CSV) of levels, records, their factors and weights ([records of their \
         own](method.md#31-levels-with-records-of-their-own))",
    )
    .note("existing file; with one measure; without `first` and `[records.select]`");

/// What `component` may be; the azimuths of a pair are those of a section of their own.
const COMPONENTS: [Component; 5] =
    [Component::H1, Component::H2, Component::Both, Component::Random, Component::Rotated(Rotation::Random)];

/// Which ground motions are used.
#[derive(Debug, Clone, PartialEq)]
pub struct Records {
    /// Where they come from.
    pub source: RecordSource,
    /// The component that shakes the planar oscillator.
    pub component: Component,
    /// How the peaks of the two components make the intensity of a pair.
    pub intensity: Combination,
    /// Whether the third component shakes what feels it.
    pub vertical: bool,
    /// Which of them are used.
    pub select: RecordSelection,
    /// Use only so many of these records, the first; all if none.
    pub first: Option<u64>,
    /// Table of the records of each level; every record at every level if none.
    pub at_level: Option<PathBuf>,
    /// What is done where two of them are the same motion.
    pub duplicates: Duplicates,
}

impl Records {
    /// Files that are read.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        self.source.manifest().into_iter().chain(self.at_level.as_deref())
    }
}

/// As the section of a study file.
impl Serialize for Records {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'a> {
            #[serde(skip_serializing_if = "Option::is_none")]
            manifest: Option<&'a Path>,
            #[serde(skip_serializing_if = "Option::is_none")]
            tag: Option<&'a str>,
            component: &'static str,
            intensity: &'static str,
            #[serde(skip_serializing_if = "std::ops::Not::not")]
            vertical: bool,
            #[serde(skip_serializing_if = "Option::is_none")]
            first: Option<u64>,
            #[serde(skip_serializing_if = "Option::is_none")]
            at_level: Option<&'a Path>,
            #[serde(skip_serializing_if = "Duplicates::is_default")]
            duplicates: Duplicates,
            #[serde(skip_serializing_if = "RecordSelection::is_empty")]
            select: &'a RecordSelection,
            #[serde(skip_serializing_if = "Option::is_none")]
            synthetic: Option<Synthetic>,
            #[serde(skip_serializing_if = "Option::is_none")]
            rotation: Option<Rotation>,
        }
        let written = Written {
            manifest: self.source.manifest(),
            tag: self.source.tag(),
            component: self.component.key(),
            intensity: self.intensity.key(),
            vertical: self.vertical,
            first: self.first,
            at_level: self.at_level.as_deref(),
            duplicates: self.duplicates,
            select: &self.select,
            synthetic: self.source.synthetic(),
            rotation: match self.component {
                Component::Rotated(rotation) => Some(rotation),
                _ => None,
            },
        };
        written.serialize(serializer)
    }
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>, paths: &Paths) -> Option<Records> {
    let manifest_field = section.given(&MANIFEST);
    let tag_field = section.given(&TAG);
    let chosen = section.read(&COMPONENT);
    let rotation_section = section.section("rotation");
    if let (true, Some(component)) =
        (rotation_section.is_present(), chosen.filter(|chosen| !matches!(chosen, Component::Rotated(_))))
    {
        section.mistake(
            "rotation",
            format!("azimuths are given, and component = \"{component}\" has none"),
            "write component = \"rotated\" in [records], or leave the section out; percentile with azimuths = 1 is h1",
        );
    }
    let rotation = rotation::read(rotation_section);
    let intensity = section.read(&INTENSITY);
    let vertical_field = section.given(&VERTICAL);
    let vertical = section.read(&VERTICAL);
    record_source::vertical_is_recorded(vertical_field.as_ref(), vertical, manifest_field.is_some());
    let select = selection::read(section.section("select"));
    let first_field = section.given(&FIRST);
    let first = optional(first_field.as_ref(), |field| FIRST.read(field));
    let at_level_field = section.given(&AT_LEVEL);
    let at_level = optional(at_level_field.as_ref(), |field| paths.input(field));
    let duplicates = section.read(&DUPLICATES);
    if let (Some(field), Some(select)) = (&at_level_field, &select)
        && (first_field.is_some() || !select.is_empty())
    {
        field.mistake(
            "the table says which records are used, and `first` or `[records.select]` as well",
            "leave these out, or the rows of the table that they are to leave out",
        );
    }
    if let (Some(field), Some(Component::Rotated(_)), Some(Rotation::Each { .. })) = (&at_level_field, chosen, rotation)
    {
        field.mistake(
            "the table names pairs, and each azimuth of a pair is a record of its own",
            "take one azimuth of each pair (take = \"random\"), or a percentile over them (take = \"percentile\")",
        );
    }
    let synthetic = record_source::synthetic(section.section("synthetic"));
    // a manifest goes before: so one `--set records.manifest=…` turns a study of synthetic records into one of real
    // ones
    let source = if let Some(field) = manifest_field {
        let manifest = paths.input(&field);
        let tag = optional(tag_field.as_ref(), |field| field.filled_text().map(str::to_owned));
        (|| Some(RecordSource::Manifest { manifest: manifest?, tag: tag? }))()
    } else {
        if let Some(field) = tag_field {
            field.mistake("a tag chooses rows of a manifest: add records.manifest", NO_TAG);
        }
        record_source::enough(first_field.as_ref(), first, synthetic);
        synthetic.map(RecordSource::from)
    };
    section.finish();
    Some(Records {
        source: source?,
        component: match chosen? {
            Component::Rotated(_) => Component::Rotated(rotation?),
            component => component,
        },
        intensity: intensity?,
        vertical: vertical?,
        select: select?,
        first: first?,
        at_level: at_level?,
        duplicates: duplicates?,
    })
}
