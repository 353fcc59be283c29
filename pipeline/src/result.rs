//! The result of a study: one HDF5 file, and tidy tables beside it.

mod csv;
mod provenance;
mod read;
mod target;
mod write;

pub(crate) use csv::write_table;
pub use csv::{csv_paths, write_csv};
pub use provenance::Provenance;
pub use read::{Fit, Spectrum, StoredResult};
pub use target::check_target;
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
