//! All that a study computed, from which its files are written.

use uplift_inputs::{OtherHazard, RecordSet, SiteHazard};
use uplift_result::{Provenance, StoredSpectra};
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::consistency::Answer;
use uplift_uniform_risk::{Coefficients, Precision, Spectra, Stripes, stored_spectra};

/// All that a study computed, by measure where it depends on it.
#[derive(Debug)]
pub struct ComputedStudy<'a> {
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
    /// How well its records know them; by no measure where nothing can be said.
    pub precision: &'a [Precision],
    /// Its hazard in measures that it is not analysed by.
    pub other_hazard: &'a [OtherHazard],
    /// Whether the records bring the hazard of other measures.
    pub(crate) consistency: &'a Answer,
    /// What was noticed about the inputs; what the numbers themselves give cause for, [`alarms`](uplift_alarms) says.
    pub warnings: &'a [String],
    /// Where the numbers come from.
    pub provenance: &'a Provenance,
}

impl ComputedStudy<'_> {
    /// Its spectra and coefficients as the result file has them.
    pub(super) fn stored_spectra(&self) -> StoredSpectra {
        let stored = |(spectra, coefficients)| stored_spectra(spectra, coefficients);
        StoredSpectra {
            strengths: self.study.strengths.to_vec(),
            poes: self.study.risk.poe.clone(),
            years: self.study.risk.years,
            sites: self.study.sites.iter().map(|site| site.name.clone()).collect(),
            measures: self.spectra.iter().zip(self.coefficients).map(stored).collect(),
        }
    }
}
