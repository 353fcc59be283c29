//! Where ground motions come from: the key `manifest` of `[records]`, or the section `[records.synthetic]`.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::keys::{Choice, File, Integer, Key, SectionKeys, choice, file, integer};
use crate::reading::{Field, Section};
use crate::sections::top;

pub(crate) const MANIFEST: Key<File> = file("manifest")
    .without_default("none: the synthetic set")
    .meaning("table of record files (CSV)")
    .note("existing file");
pub(crate) const DUPLICATES: Key<Choice<Duplicates>> =
    choice("duplicates", &Duplicates::ALL, Duplicates::key).with_default(Duplicates::Refuse).meaning(
        "records that are the same motion, sample by sample, under two names: `\"refuse\"` or `\"keep\"`, so that it \
         counts twice",
    );
pub(crate) const SYNTHETIC_KEYS: SectionKeys = SectionKeys::new("records.synthetic", &[&PAIRS, &SEED]);
const PAIRS: Key<Integer> = integer("pairs", 1, MOST_PAIRS)
    .with_default(DEFAULT_SYNTHETIC_PAIRS)
    .meaning("number of pairs of horizontal components");
const SEED: Key<Integer> = top::seed(DEFAULT_SYNTHETIC_SEED).meaning("seed of the generator");

/// Pairs of horizontal components in the synthetic record set, unless a study says otherwise.
pub const DEFAULT_SYNTHETIC_PAIRS: u64 = 105;
/// Seed of the synthetic record set that comes with the program.
pub const DEFAULT_SYNTHETIC_SEED: u64 = 1;
/// Most synthetic pairs: beyond it memory is out of proportion.
const MOST_PAIRS: u64 = 10_000;

/// What to do about a tag where there is no manifest.
pub(crate) const NO_TAG: &str = "give `manifest`, or leave `tag` out";

/// Where ground motions come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RecordSource {
    /// Record files listed in a manifest.
    Manifest {
        /// The manifest, absolute.
        manifest: PathBuf,
        /// Only rows whose `set_tags` contain it; all rows if none.
        tag: Option<String>,
    },
    /// Synthetic motions, made by the program.
    Synthetic {
        /// Number of pairs of horizontal components.
        pairs: u64,
        /// Seed of the generator.
        seed: u64,
    },
}

impl RecordSource {
    /// The manifest, if the records are of one.
    pub fn manifest(&self) -> Option<&Path> {
        match self {
            Self::Manifest { manifest, .. } => Some(manifest),
            Self::Synthetic { .. } => None,
        }
    }

    /// The tag, if only records with it are used.
    pub fn tag(&self) -> Option<&str> {
        match self {
            Self::Manifest { tag, .. } => tag.as_deref(),
            Self::Synthetic { .. } => None,
        }
    }

    /// The same records, to be found by another `manifest`; what was synthetic becomes all of its records.
    #[must_use]
    pub fn by_manifest(&self, manifest: PathBuf) -> Self {
        Self::Manifest { manifest, tag: self.tag().map(str::to_owned) }
    }

    /// The section `[records.synthetic]`, if the records are that.
    pub(crate) fn synthetic(&self) -> Option<Synthetic> {
        match self {
            Self::Manifest { .. } => None,
            &Self::Synthetic { pairs, seed } => Some(Synthetic { pairs, seed }),
        }
    }
}

/// What is done where two records are the same motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Duplicates {
    /// They are a mistake.
    Refuse,
    /// Both are used.
    Keep,
}

impl Duplicates {
    /// Every way.
    pub const ALL: [Self; 2] = [Self::Refuse, Self::Keep];

    /// Its word in files and keys: refuse, keep.
    pub fn key(self) -> &'static str {
        match self {
            Self::Refuse => "refuse",
            Self::Keep => "keep",
        }
    }

    /// Whether nothing is said: it is then left out where the study is kept, as it was before there was such a key.
    #[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
    pub(crate) fn is_default(&self) -> bool {
        *self == Self::Refuse
    }
}

/// The section `[records.synthetic]`.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Synthetic {
    pairs: u64,
    seed: u64,
}

impl From<Synthetic> for RecordSource {
    fn from(Synthetic { pairs, seed }: Synthetic) -> Self {
        Self::Synthetic { pairs, seed }
    }
}

/// Reads the section `[records.synthetic]`.
pub(crate) fn synthetic(mut section: Section<'_>) -> Option<Synthetic> {
    let pairs = section.read(&PAIRS);
    let seed = section.read(&SEED);
    section.finish();
    Some(Synthetic { pairs: pairs?, seed: seed? })
}

/// Whether there are as many synthetic pairs as the key `first` asks for; a mistake if not.
#[allow(clippy::option_option)] // wrong and absent are different things
pub(crate) fn enough(field: Option<&Field<'_>>, first: Option<Option<u64>>, synthetic: Option<Synthetic>) {
    if let (Some(field), Some(Some(first)), Some(Synthetic { pairs, .. })) = (field, first, synthetic)
        && first > pairs
    {
        field.mistake(
            format!("{first} is more than the {pairs} records there are"),
            format!("use at most {pairs}, or raise records.synthetic.pairs"),
        );
    }
}

/// Refuses the vertical motion of synthetic records, which have none.
pub(crate) fn vertical_is_recorded(vertical_field: Option<&Field<'_>>, vertical: Option<bool>, is_recorded: bool) {
    if let (Some(field), Some(true), false) = (vertical_field, vertical, is_recorded) {
        field.mistake(
            "synthetic records have no third component",
            "give a manifest of records with the column file_v, or leave it out",
        );
    }
}
