//! The study file: what a user writes, checked as a whole before anything is computed.
//!
//! A study file is TOML. It is parsed into a [`Study`], in which every key and value knows its place in the file, and
//! resolved into a [`UniformRiskStudy`] or a [`DisplacementStudy`], or an [`AnyStudy`] where either will do: every
//! default filled in, every path found, every unit checked. All mistakes are reported at once, each with its line, its
//! value and what to do ([`StudyError`]).
//!
//! ```no_run
//! use std::path::Path;
//! use uplift_study::Study;
//!
//! let study = Study::load(Path::new("configs/europe.toml"), &["risk.years=100".to_owned()])?;
//! assert_eq!(study.risk.years, 100.0);
//! # Ok::<(), uplift_study::StudyError>(())
//! ```
//!
//! | to | call |
//! |---|---|
//! | load a study of uniform risk, with `--set` | [`Study::load`] |
//! | load one of any kind | [`Study::load_any`] |
//! | take text that is in no file | [`Study::parse`], then [`Study::resolve`] or [`Study::resolve_any`] |
//! | write a resolved study, complete | [`AnyStudy::to_toml`] |
//! | read that again, when its files may be gone | [`Study::stored`] |
//! | have editors complete and check keys | [`study_schema`], [`structure_schema`], [`library_schema`] |
//! | load a structure file | [`Structure::load`] |
//! | load the file of a library of rocking response | [`LibraryStudy::load`] |
//! | load a file of a restrainer alone | [`RestrainerFile::load`] |
//!
//! # Where things are
//!
//! A section of a study file is one module: its keys, its resolved type, the reading and the writing. `sections` has
//! those of every kind, `uniform_risk`, `displacement` and `shake_table` those of their kind, `structure` those of
//! structure files; `keys` is what keys are declared with, `reading` what all of them read with, `grid` the notation of
//! grids, `schema` makes JSON Schemas of the keys.
//!
//! **A new key** is declared once in the module of its section, and listed in its `KEYS`:
//!
//! ```text
//! const WITHIN_KM: Key<Number> = number("within_km", "km", Rule::Within(DISTANCE))
//!     .with_default(1.0)
//!     .meaning("farthest distance between a site and its point of the export, km");
//! ```
//!
//! It becomes a field of the section's type by `section.read(&WITHIN_KM)`; without a default by `section.optional`. A
//! rule that takes several keys stands in `read`, and in words in the key's `note`. Tests say when a part is missing;
//! `UPDATE_DOCS=1 cargo test -p uplift-study` writes the tables of the documentation and the schemas of `configs`.
//!
//! **A new kind of study** is a module and folder beside `uniform_risk` and `displacement`, with the type of the study,
//! `read` and `KEYS`; a variant of [`Kind`] and of [`AnyStudy`] in `kind.rs`; and its page in `tests/reference.rs`. The
//! compiler names the rest.

mod displacement;
mod error;
mod grid;
mod keys;
mod kind;
mod library;
mod reading;
mod schema;
mod sections;
mod shake_table;
mod structure;
mod study;
mod uniform_risk;
mod warning;

#[cfg(test)]
mod tests;

pub use displacement::{
    BlockFamily, DesignPlan, Designed, DisplacementStudy, OscillatorFamily, ScaledTo, ScalingPlan, SetPlan, SetRecords,
    Structures,
};
pub use error::{Place, StudyError, StudyMistake, Unreadable};
pub use grid::{Grid, GridError, MOST_GRID_VALUES};
pub use kind::{AnyStudy, Kind};
pub use library::{BlockGrid, LibraryStudy};
pub use reading::{did_you_mean, did_you_mean_file};
pub use schema::{library_schema, structure_schema, study_schema};
pub use sections::output::Output;
pub use sections::record_source::{DEFAULT_SYNTHETIC_PAIRS, DEFAULT_SYNTHETIC_SEED, Duplicates, RecordSource};
pub use sections::selection::{CRITERIA, Criterion, Range, RecordSelection};
pub use sections::uncertainty::{Uncertainty, UncertaintyKind};
pub use shake_table::{DesignSpectrumPlan, FrameModel, LevelPlan, ShakeTableStudy, SpectraPlan};
pub use structure::{ColumnShape, RestrainerFile, Structure};
pub use study::Study;
pub use uniform_risk::{
    Bootstrap, Branch, Consistency, Contour, Conversion, CurveFile, CurveKind, ExportFiles, Hazard, MeasurePlan,
    Oscillator, Records, Regression, Repair, Risk, Site, SiteSlice, SiteTable, UniformRiskStudy, definition_of,
    levels_key, levels_place, lower_starts, usual_top_level,
};
pub use warning::Warning;
