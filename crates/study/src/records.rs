//! The ground motions of a study: a manifest of record files, or the synthetic set.

use uplift_motion::{Combination, Component};

use super::form::{COMBINATIONS, COMPONENTS};
use super::paths::Folders;
use super::reader::{Field, LARGEST_INTEGER, Section, optional};
use super::resolved::{DEFAULT_SYNTHETIC_PAIRS, DEFAULT_SYNTHETIC_SEED, RecordSource, Records};
use super::selection;

/// Most synthetic pairs: beyond it memory is out of proportion.
const MOST_PAIRS: u64 = 10_000;

/// What to do about a tag where there is no manifest.
pub(super) const NO_TAG: &str = "give `manifest`, or leave `tag` out";

/// Reads which ground motions are used.
pub(super) fn read(mut section: Section<'_>, folders: &Folders) -> Option<Records> {
    let manifest_field = section.field("manifest");
    let tag_field = section.field("tag");
    let component = section.field("component").map_or(Some(Component::H1), |field| field.choice(&COMPONENTS));
    let intensity =
        section.field("intensity").map_or(Some(Combination::default()), |field| field.choice(&COMBINATIONS));
    let select = selection::read(section.section("select"));
    let first_field = section.field("first");
    let first = optional(first_field.as_ref(), |field| field.integer(1, LARGEST_INTEGER));
    let synthetic = synthetic(section.section("synthetic"));
    // a manifest goes before: so one `--set records.manifest=…` turns a study of synthetic records into one of real ones
    let source = if let Some(field) = manifest_field {
        let manifest = folders.input(&field);
        let tag = optional(tag_field.as_ref(), |field| field.filled_text().map(str::to_owned));
        (|| Some(RecordSource::Manifest { manifest: manifest?, tag: tag? }))()
    } else {
        if let Some(field) = tag_field {
            field.mistake("a tag chooses rows of a manifest, and there is none", NO_TAG);
        }
        enough(first_field.as_ref(), first, synthetic);
        synthetic.map(|(pairs, seed)| RecordSource::Synthetic { pairs, seed })
    };
    section.finish();
    Some(Records { source: source?, component: component?, intensity: intensity?, select: select?, first: first? })
}

/// Reads the section `[records.synthetic]`: pairs and seed.
pub(super) fn synthetic(mut section: Section<'_>) -> Option<(u64, u64)> {
    let pairs = section.field("pairs").map_or(Some(DEFAULT_SYNTHETIC_PAIRS), |field| field.integer(1, MOST_PAIRS));
    let seed = section.seed_or(DEFAULT_SYNTHETIC_SEED);
    section.finish();
    Some((pairs?, seed?))
}

/// Whether there are as many synthetic pairs as the key `first` asks for; a mistake if not.
#[allow(clippy::option_option)] // wrong and absent are different things
pub(super) fn enough(field: Option<&Field<'_>>, first: Option<Option<u64>>, synthetic: Option<(u64, u64)>) {
    if let (Some(field), Some(Some(first)), Some((pairs, _))) = (field, first, synthetic)
        && first > pairs
    {
        field.mistake(
            format!("the first {first} records are asked for, and there are {pairs}"),
            format!("use at most {pairs}, or raise records.synthetic.pairs"),
        );
    }
}
