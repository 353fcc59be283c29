//! The result of a study: one HDF5 file, and tidy tables beside it; how both are opened, extended and read.
//!
//! [`ResultFile`] opens a result and reads it part by part; [`layout`] knows where everything is.

mod bands;
mod design;
mod displacements;
mod extend;
mod file;
mod hazard;
mod head;
mod influence;
pub mod layout;
mod provenance;
mod records;
mod spectra;
mod stripes;
mod study;
mod table;
mod tails;
mod target;

pub use bands::{MeasureBands, StoredBands};
pub(crate) use design::{BOUNDS, rule_names};
pub use design::{DesignRow, RULES, StoredDesign, StoredDesigned};
pub use displacements::{SpectrumPlace, StoredDisplacements, StoredMotions, StoredSet, StoredStructures};
pub(crate) use extend::{Addition, line, sign};
pub use file::{ResultFile, RiskAxes};
pub use hazard::{StoredCurves, StoredHazard};
pub use head::{Head, Overview};
pub use influence::StoredInfluence;
pub(crate) use provenance::Origin;
pub use provenance::Provenance;
pub use records::StoredRecords;
pub use spectra::{Fit, MeasureSpectra, Spectrum, StoredSpectra};
pub use stripes::{StoredMeasure, StoredStripes};
pub use study::{SpectraOfResult, StudyOfResult};
pub(crate) use table::{neutral, plain, table_text};
pub use table::{write_atomically, write_table};
pub use tails::TailShares;
pub(crate) use target::check_place;
pub use target::{check_target, is_hdf5};
pub use uplift_study::Kind;
