//! The result of a study: one HDF5 file, and tidy tables beside it; how both are opened, extended and read.
//!
//! [`ResultFile`] opens a result and reads it part by part; arrays are [`declared`] beside the values that they hold,
//! and [`layout`] has axes and attributes.

mod band_kind;
mod bands;
mod consistency;
pub mod declared;
mod design;
pub mod digest;
mod displacements;
pub mod earlier;
mod efficiency;
mod error;
mod extend;
mod file;
mod findings;
mod hazard;
mod head;
mod influence;
mod kept_groups;
pub mod layout;
mod other_file;
mod peaks;
mod provenance;
mod records;
mod shake_table;
mod site_arrays;
mod site_ranges;
mod spectra;
mod spread;
mod stored_result;
mod study;
mod target;

pub use band_kind::{BandKind, BandsOfKind, before_unit};
pub use bands::{
    BANDS, DRAWS, FAILED_PAIRS, FAILED_SAMPLES, INFERRED_BANDS, JOINT_BANDS, REPAIRED_BANDS, SIMULTANEOUS_BANDS,
};
pub use bands::{
    BandMethod, InferredBands, MeasureBands, SiteJointBands, StoredBands, StoredDraws, StoredJointBands,
    StoredRepairedBands, StoredSpectraBands, WidestInferred, band_lengths, band_names,
};
pub use consistency::{CONSISTENCY, DIAGNOSES, REPAIRED_FITS, REPAIRED_LEVELS, REPAIRED_SPECTRA, REPAIRS, WEIGHTS};
pub use consistency::{ConsistencyGroup, MeasureConsistency, StoredConsistency};
pub use declared::NO_ORDINATE;
pub use design::{BOUNDS, RESTRAINED_DESIGN, ROUNDING, SOLITARY_CAPACITY, SOLITARY_DESIGN, VALUES, bounds, rule_names};
pub use design::{DesignRow, RULES, StoredDesign, StoredDesigned};
pub use displacements::{MOTIONS, ROUNDED_SPECTRA, SET_SPECTRA, SPECTRA};
pub use displacements::{
    SetSpectra, SpectrumPlace, StoredDisplacements, StoredMotion, StoredMotions, StoredRounding, StoredSet,
    StoredStructures,
};
pub use efficiency::{EFFICIENCY, EFFICIENCY_OF_STRIPES, TRENDS};
pub use efficiency::{StoredEfficiency, StoredTrend};
pub use error::ResultError;
pub use extend::LockedResult;
pub use file::ResultFile;
pub use findings::{FINDINGS, Finding, FindingRow, Inquiry, StoredFinding};
pub use hazard::{HAZARD_CURVE, branch_curve_name, curve_name};
pub use hazard::{StoredBranch, StoredCurves, StoredHazard};
pub use head::{Head, Overview};
pub use influence::{DISAGGREGATION, DISAGGREGATION_REPAIRED, INFLUENCE, INFLUENCE_REPAIRED, StoredInfluence};
pub use kept_groups::KeptGroups;
pub use layout::attribute::sign;
pub use peaks::{FACTORS, IMPACTS, PEAKS, RISK_SURFACE, SHARES};
pub use peaks::{SetsOfLevels, StoredPeaks};
pub use provenance::Provenance;
pub use records::{DRAWN_QUANTITY, DRAWN_STRUCTURE, INTENSITY, MOTION_KEYS, RECORDS};
pub use records::{StoredRecords, drawn_names, intensity_names};
pub use shake_table::{DESIGN_SPECTRUM, TABLE_EXCITATIONS, TABLE_ORDER, TABLE_SPECTRA, TABLE_TESTS};
pub use shake_table::{DIRECTIONS, Excitation, ShakeTable, TableLevel, TableSpectra, TableTest};
pub use site_arrays::{
    REPAIRED_SITE_NAMES, SITE_BANDS, SITE_CONSISTENCY, SITE_FITS, SITE_FLAGS, SITE_NAMES, SITE_PLACES, SITE_PROBLEMS,
    SITE_SPECTRA, SITE_SPREADS,
};
pub use site_arrays::{SiteArrays, SiteConsistency, SiteSpectrum, SiteSpread};
pub use site_ranges::{MeasureRanges, SiteRanges};
pub use spectra::{Fit, Fits, MeasureSpectra, Spectrum, StoredSpectra, regression, urs};
pub use spread::{
    BRANCH_WEIGHTS, EPISTEMIC, EPISTEMIC_SPECTRA, REPAIRED_EPISTEMIC, REPAIRED_EPISTEMIC_SPECTRA, UNCERTAINTY,
    UNCERTAINTY_SPECTRA,
};
pub use spread::{BranchSpectra, FRACTILES, Spread, SpreadOver, StoredSpread};
pub use stored_result::{RiskAxes, StoredResult};
pub use target::{check_place, replaces_another};
pub use target::{check_target, is_hdf5};
pub use uplift_study::Kind;

pub use digest::what_counts;
