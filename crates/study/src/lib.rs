//! The study file: what a user writes, checked as a whole before anything is computed.
//!
//! A study file is TOML. It is parsed into a [`Study`], in which every key and value knows its
//! place in the file, and resolved into a [`ResolvedStudy`]: every default filled in, every path
//! found, every unit checked. All mistakes are reported at once, each with its line, its value
//! and what to do ([`StudyError`]).
//!
//! ```no_run
//! use std::path::Path;
//! use uplift_study::Study;
//!
//! let study = Study::load(Path::new("configs/europe.toml"), &["risk.years=100".to_owned()])?;
//! assert_eq!(study.risk.years, 100.0);
//! # Ok::<(), uplift_study::StudyError>(())
//! ```

mod bootstrap;
mod branches;
mod displacement;
mod document;
mod error;
mod form;
mod grid;
mod hazard;
mod measures;
mod notation;
mod overrides;
mod paths;
mod reader;
mod records;
mod resolve;
mod resolved;
mod selection;
mod site_table;
mod sites;
mod source;
mod structure;
mod suggestion;
mod warnings;

#[cfg(test)]
mod tests;

pub use displacement::{
    BlockFamily, DesignPlan, Designed, DisplacementStudy, OscillatorFamily, ScaledTo, ScalingPlan, SetPlan, SetRecords,
    Structures,
};
pub use error::{Place, StudyError, StudyMistake};
pub use grid::{Grid, GridError};
pub use hazard::{Conversion, Hazard, definition_of, definition_word};
pub use measures::levels_within;
pub use notation::MOST_GRID_VALUES;
pub use resolve::DISPLACEMENT_SPECTRA;
pub use resolved::{
    Bootstrap, Branch, Contour, CurveFile, CurveKind, CurveUnit, DEFAULT_SYNTHETIC_PAIRS, DEFAULT_SYNTHETIC_SEED,
    Extrapolate, IntervalKind, MeasurePlan, Oscillator, Output, RecordSource, Records, Regression, ResolvedStudy, Risk,
    Site, Uplifted,
};
pub use selection::{CRITERIA, Criterion, Range, RecordSelection};
pub use site_table::SiteTable;
pub use source::{AnyStudy, Study};
pub use structure::Structure;
