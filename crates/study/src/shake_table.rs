//! A study of a shaking table: which tests a frame would go through, and what it would do (Sections 6.4 and 6.8).
//!
//! | module | section |
//! |---|---|
//! | `levels` | `[[levels]]` |
//! | `model` | `[model]` |
//! | `spectra` | `[spectra]` |
//!
//! `[records]`, `[records.select]`, `[records.synthetic]` and `[output]` are as in other kinds.

mod levels;
mod model;
mod spectra;

use std::path::PathBuf;

use serde::Serialize;

use crate::displacement::{RECORDS_KEYS, SetRecords, read_records};
use crate::keys::{File, Key, Number, SectionKeys, file, number};
use crate::reading::{Paths, Rule, Section, optional};
use crate::sections::output::{self, Output};
use crate::sections::{record_source, selection, top};
use crate::warning::Warning;

pub use levels::LevelPlan;
pub use model::FrameModel;
pub(crate) use model::REST;
pub use spectra::{DesignSpectrumPlan, SpectraPlan};

/// Prototype over model: as `uplift-frame` takes it.
const SCALE: Rule = Rule::From(1e-3, 1e3, "from 0.001 to 1000");

/// What to do about a tag.
const TABLE_OF_EXCITATIONS: &str = "name the records in a table: excitations = \"excitations.csv\"";

/// Every key.
pub(crate) const KEYS: [SectionKeys; 9] = [
    SectionKeys::new("", &[&top::KIND, &top::TITLE, &top::GRAVITY, &STRUCTURE, &EXCITATIONS, &LENGTH_SCALE]),
    RECORDS_KEYS,
    selection::KEYS,
    record_source::SYNTHETIC_KEYS,
    levels::KEYS,
    model::KEYS,
    spectra::KEYS,
    spectra::DESIGN_KEYS,
    output::KEYS,
];

const STRUCTURE: Key<File> = file("structure")
    .meaning("the frame that stands on the table: a structure file with columns and a deck")
    .note("kind `frame` or `restrained-frame`, `column_shape = \"cylinder\"`");
const EXCITATIONS: Key<File> = file("excitations")
    .without_default("every record, of the class `all`")
    .meaning("table (CSV) of the records that are played: `exc_id`, `class`, and `rsn` or `record_id`")
    .note("those that are not among the records are told");
const LENGTH_SCALE: Key<Number> = number("length_scale", "", SCALE)
    .with_default(1.0)
    .meaning("lengths of the prototype over those of the model: time runs faster by its square root");

/// A study of a shaking table with every default filled in, every path found and every unit checked.
///
/// It is serialised as a study file that loads to an equal value, wherever it is stored.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename = "shake table")]
pub struct ShakeTableStudy {
    /// Free text.
    pub title: String,
    /// Acceleration of gravity of records in g \[m/s²\].
    pub gravity_m_s2: f64,
    /// The structure file.
    pub structure: PathBuf,
    /// The table of excitations; every record where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub excitations: Option<PathBuf>,
    /// Lengths of the prototype over those of the model.
    pub length_scale: f64,
    /// Which ground motions there are to choose from.
    pub records: SetRecords,
    /// The levels of shaking; at least one.
    pub levels: Vec<LevelPlan>,
    /// What the model leaves to choose.
    pub model: FrameModel,
    /// Of what response spectra are drawn.
    pub spectra: SpectraPlan,
    /// What is written where.
    pub output: Output,
    /// What is allowed but probably not meant.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

/// Reads the whole study but for its `kind`; none where something is wrong.
pub(crate) fn read(mut root: Section<'_>, paths: &Paths) -> Option<ShakeTableStudy> {
    let title = root.read(&top::TITLE);
    let gravity = root.read(&top::GRAVITY);
    let help = "add structure = \"frame.toml\", a structure file with columns and a deck";
    let structure =
        root.needed(&STRUCTURE, "which structure is on the table?", help).and_then(|field| paths.input(&field));
    let excitations = optional(root.given(&EXCITATIONS).as_ref(), |field| paths.input(field));
    let length_scale = root.read(&LENGTH_SCALE);
    let records = read_records(root.section("records"), paths, TABLE_OF_EXCITATIONS);
    let levels = levels::read(&mut root);
    let model = model::read(root.section("model"));
    let spectra = spectra::read(root.section("spectra"));
    let manifest = records.as_ref().and_then(SetRecords::manifest);
    let inputs = manifest.into_iter().chain(structure.as_deref());
    let inputs = inputs.chain(excitations.as_ref().and_then(Option::as_deref));
    let output = output::read(root.section("output"), paths, inputs);
    root.finish();
    let mut study = ShakeTableStudy {
        title: title?,
        gravity_m_s2: gravity?,
        structure: structure?,
        excitations: excitations?,
        length_scale: length_scale?,
        records: records?,
        levels: levels?,
        model: model?,
        spectra: spectra?,
        output: output?,
        warnings: Vec::new(),
    };
    let gravity = uplift_plausible::USUAL_GRAVITY.unlikely("gravity_m_s2", study.gravity_m_s2);
    let of_level = |level: &LevelPlan| {
        uplift_plausible::USUAL_TABLE_PGV.unlikely("pgv_srss_m_s in [[levels]]", level.pgv_srss_m_s)
    };
    let levels: Vec<_> = study.levels.iter().filter_map(of_level).collect();
    let design = study.spectra.design.and_then(|design| {
        let acceleration_g = design.ground_acceleration_g;
        uplift_plausible::USUAL_DESIGN_ACCELERATION.unlikely("spectra.design.ground_acceleration_g", acceleration_g)
    });
    let scale = uplift_plausible::USUAL_LENGTH_SCALE.unlikely("length_scale", study.length_scale);
    study.warnings = gravity.iter().chain(&scale).chain(&levels).chain(&design).map(Warning::unlikely).collect();
    Some(study)
}
