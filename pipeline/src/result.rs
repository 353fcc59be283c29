//! The result of a study: one HDF5 file, and tidy tables beside it; how both are opened, extended and read.
//!
//! [`ResultFile`] opens a result and reads it part by part; [`layout`] knows where everything is.

mod asked;
mod bands;
mod consistency;
pub mod declared;
mod design;
pub(crate) mod digest;
mod displacements;
pub(crate) mod earlier;
mod efficiency;
mod extend;
mod file;
mod findings;
mod hazard;
mod head;
mod influence;
pub mod layout;
mod other_file;
mod provenance;
mod records;
mod shake_table;
mod spectra;
mod spread;
mod stripes;
mod study;
mod table;
mod target;
mod units;

pub use asked::{AskedRisk, RiskTargets};
pub(crate) use bands::BandMethod;
pub use bands::{
    InferredBands, MeasureBands, StoredBands, StoredJointBands, StoredRepairedBands, StoredSpectraBands, WidestInferred,
};
pub use consistency::{REPAIRED_FITS, StoredConsistency};
pub(crate) use design::{BOUNDS, bounds, rule_names};
pub use design::{DesignRow, RULES, StoredDesign, StoredDesigned};
pub use displacements::{
    SpectrumPlace, StoredDisplacements, StoredMotions, StoredRounding, StoredSet, StoredStructures,
};
pub use efficiency::{StoredEfficiency, StoredTrend};
pub(crate) use extend::{Addition, line, sign};
pub use file::{ResultFile, RiskAxes};
pub(crate) use findings::{DOCUMENT, REQUEST, STRUCTURE_FILE, STRUCTURE_SHA256, STRUCTURE_TOML, STUDY_DIGEST};
pub use findings::{Finding, FindingRow, Inquiry, StoredFinding};
pub use hazard::{StoredBranch, StoredCurves, StoredHazard};
pub use head::{Head, Overview};
pub use influence::StoredInfluence;
pub(crate) use provenance::Origin;
pub use provenance::Provenance;
pub use records::StoredRecords;
pub use shake_table::{
    DIRECTIONS, Excitation, ShakeTable, TABLE_EXCITATIONS, TABLE_TESTS, TableLevel, TableSpectra, TableTest,
};
pub use spectra::{Fit, Fits, MeasureSpectra, Spectrum, StoredSpectra, regression, urs};
pub(crate) use spectra::{flag_number, flag_word};
pub use spread::{SpreadOver, StoredSpread};
pub use stripes::{StoredMeasure, StoredStripes};
pub use study::{SpectraOfResult, StudyOfResult};
pub(crate) use table::{neutral, plain, table_text, write_metadata};
pub use table::{write_atomically, write_table};
pub(crate) use target::{check_place, replaces_another};
pub use target::{check_target, is_hdf5};
pub use units::RecordUnits;
pub use uplift_study::Kind;
