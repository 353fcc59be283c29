//! All that a study of uniform risk computed.

use uplift_study::UniformRiskStudy;

use super::{Coefficients, Spectra, Stripes};
use crate::inputs::{RecordSet, SiteHazard};
use crate::result::Provenance;

/// All that a study computed, by measure where it depends on it.
#[derive(Debug)]
pub struct Outcome<'a> {
    /// The study.
    pub study: &'a UniformRiskStudy,
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
    /// What was noticed about the inputs; what the numbers themselves give cause for, [`alarms`](crate::alarms) says.
    pub warnings: &'a [String],
    /// Where the numbers come from.
    pub provenance: &'a Provenance,
}
