//! A study of displacement spectra: what record sets ask of rocking structures, without any hazard (Sections 2.4, 3.4
//! and 3.5 of Reggiani Manzo's dissertation).
//!
//! | module | section |
//! |---|---|
//! | `records` | `[records]` |
//! | `record_sets` | `[[record_sets]]` |
//! | `scaling` | `[scaling]` |
//! | `spectrum` | `[spectrum]` |
//! | `structures` | which of the following two there are |
//! | `oscillators` | `[oscillator]`, with `[strengths]` |
//! | `blocks` | `[block]`, with `[slenderness]` |
//! | `design` | `[design]` |

mod blocks;
mod design;
mod oscillators;
mod record_sets;
mod records;
mod scaling;
mod spectrum;
mod structures;
mod warnings;

use serde::Serialize;

use crate::grid::Grid;
use crate::keys::SectionKeys;
use crate::reading::{Paths, Section};
use crate::sections::output::{self, Output};
use crate::sections::{record_source, selection, strengths, top};
use crate::warning::Warning;

pub use blocks::BlockFamily;
pub use design::{DesignPlan, Designed};
pub use oscillators::OscillatorFamily;
pub(crate) use oscillators::{KEYS as OSCILLATOR_KEYS, check_stiffness, read as read_oscillators};
pub use record_sets::SetPlan;
pub use records::SetRecords;
pub(crate) use records::{KEYS as RECORDS_KEYS, read as read_records};
pub use scaling::{ScaledTo, ScalingPlan};
pub use structures::Structures;

/// Every key.
pub(crate) const KEYS: [SectionKeys; 13] = [
    SectionKeys::new("", &[&top::KIND, &top::TITLE, &top::GRAVITY]),
    records::KEYS,
    selection::KEYS,
    record_source::SYNTHETIC_KEYS,
    record_sets::KEYS,
    scaling::KEYS,
    spectrum::KEYS,
    oscillators::KEYS,
    strengths::KEYS,
    blocks::KEYS,
    blocks::SLENDERNESS_KEYS,
    design::KEYS,
    output::KEYS,
];

/// A study of displacement spectra with every default filled in, every path found and every unit checked.
///
/// It is serialised as a study file that loads to an equal value, wherever it is stored.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename = "displacement spectra")]
pub struct DisplacementStudy {
    /// Free text.
    pub title: String,
    /// Acceleration of gravity \[m/s²\].
    pub gravity_m_s2: f64,
    /// Which ground motions there are to choose from.
    pub records: SetRecords,
    /// The record sets; where none is named, all records are one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub record_sets: Vec<SetPlan>,
    /// How the motions of a set are scaled.
    pub scaling: ScalingPlan,
    /// Percentiles of the displacements of a set \[%\].
    #[serde(rename = "spectrum", serialize_with = "spectrum::write")]
    pub percentiles: Grid,
    /// What is shaken.
    #[serde(flatten)]
    pub structures: Structures,
    /// The design example, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design: Option<DesignPlan>,
    /// What is written where.
    pub output: Output,
    /// What is allowed but probably not meant.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

/// Reads the whole study but for its `kind`; none where something is wrong.
pub(crate) fn read(mut root: Section<'_>, paths: &Paths) -> Option<DisplacementStudy> {
    let title = root.read(&top::TITLE);
    let gravity = root.read(&top::GRAVITY);
    let records = records::read(root.section("records"), paths, records::SETS_HAVE_TAGS);
    let record_sets = record_sets::read(root.field("record_sets"));
    let scaling = scaling::read(root.section("scaling"));
    let percentiles = spectrum::read(root.section("spectrum"));
    let structures = structures::read(&mut root);
    let of_blocks = root.field("block").is_some() && root.field("oscillator").is_none();
    let design = design::read(root.section("design"), of_blocks, structures.as_ref());
    let manifest = records.as_ref().and_then(|records| records.source.manifest());
    let output = output::read(root.section("output"), paths, manifest.into_iter());
    if let (Some(Structures::Oscillators(family)), Some(gravity)) = (&structures, gravity) {
        oscillators::check_stiffness(&root, family, gravity);
    }
    if let (Some(Structures::Oscillators(_)), Some(true)) = (&structures, records.as_ref().map(|found| found.vertical))
    {
        root.mistake(
            "records.vertical",
            "oscillators do not feel the vertical motion",
            "leave it out, or shake blocks: a section [block] in place of [oscillator]",
        );
    }
    root.finish();
    let mut study = DisplacementStudy {
        title: title?,
        gravity_m_s2: gravity?,
        records: records?,
        record_sets: record_sets?,
        scaling: scaling?,
        percentiles: percentiles?,
        structures: structures?,
        design: design?,
        output: output?,
        warnings: Vec::new(),
    };
    study.warnings = warnings::from_study(&study);
    Some(study)
}
