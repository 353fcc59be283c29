//! The result of a study: one HDF5 file, and tidy tables beside it.

mod bands;
mod checkpoint;
mod csv;
mod displacement;
mod extend;
mod hazard;
mod influence;
mod predictors;
mod provenance;
mod read;
mod site_table;
mod stored;
mod study_of;
mod target;
mod write;

pub use bands::{BandsFile, band_paths, write_bands};
pub use checkpoint::{Checkpoint, Finished};
pub use csv::{csv_paths, write_csv};
pub(crate) use csv::{write_aside, write_table};
pub use displacement::{
    DesignRow, DisplacementOutcome, SpectrumPlace, StoredDisplacements, StoredMotions, StoredSet, StoredStructures,
    displacement_csv_paths, read_design, write_displacement_csv, write_displacements,
};
pub(crate) use hazard::{axis_part, unique_axis};
pub use influence::{RecordInfluence, influence_path, record_influence, write_influence};
pub use predictors::{predictors_path, write_predictors};
pub use provenance::Provenance;
pub use read::{Fit, Spectrum, StoredResult};
pub(crate) use read::{holds_displacement_spectra, open_any_result, open_result};
pub use site_table::{SiteTableFiles, SiteTableLayout, SiteText, site_table_paths};
pub use stored::{StoredMeasure, StoredStripes, covariates};
pub use study_of::{SpectraOfResult, StudyOfResult};
pub use target::check_target;
pub(crate) use target::is_hdf5;
pub(crate) use write::level_axis;
pub use write::write_result;

use crate::inputs::{RecordSet, SiteHazard};
use crate::stages::{Coefficients, Spectra, Stripes};
use crate::study::ResolvedStudy;

/// Version of the layout of the result file (docs/hdf5-layout.md).
pub const LAYOUT: i64 = 1;

/// All that a study computed, by measure where it depends on it.
#[derive(Debug)]
pub struct Outcome<'a> {
    /// The study.
    pub study: &'a ResolvedStudy,
    /// Its records.
    pub records: &'a RecordSet,
    /// Its hazard, `[measure][site]`.
    pub hazard: &'a [Vec<SiteHazard>],
    /// Its stripes, `[measure]`.
    pub stripes: &'a [Stripes],
    /// Its spectra, `[measure]`.
    pub spectra: &'a [Spectra],
    /// Its coefficients, `[measure]`.
    pub coefficients: &'a [Coefficients],
    /// What a reader should know before using the numbers.
    pub warnings: &'a [String],
    /// Where the numbers come from.
    pub provenance: &'a Provenance,
}
