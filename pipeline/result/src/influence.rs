//! The influence of records and intensities as `uplift influence` left it in a result.

use uplift_job::Array;
use uplift_motion::IntensityMeasure;

use super::file::ResultFile;
use super::layout::{axis, disaggregation, influence};
use crate::error::ResultError;

/// Influence on the spectra of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredInfluence {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Exact ordinates without each record `[site, poe, record, strength]`, m; none for a single record.
    pub without_m: Option<Array<4>>,
    /// Levels from which the bins of the shares reach up, the last without end, in the unit of the measure.
    pub bins: Vec<f64>,
    /// Shares of the risk at each exact ordinate `[site, poe, strength, bin]`; NaN where there is no ordinate.
    pub shares: Array<4>,
}

impl ResultFile {
    /// Whether `uplift influence` left something, of the probabilities of the study.
    pub fn has_influence(&self) -> bool {
        self.measures().iter().any(|measure| self.reader.exists(&disaggregation::share(*measure)))
    }

    /// The influence on the spectra of each measure of a result of uniform risk; none before `uplift influence`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn influence(&self) -> Result<Vec<StoredInfluence>, ResultError> {
        let axes = self.axes()?;
        let (site, poe) = ((axis::SITE, axes.sites.len()), (axis::POE, axes.poes.len()));
        let (record, strength) = ((axis::RECORD, axes.records.len()), (axis::STRENGTH, axes.strengths.len()));
        let of = |measure: IntensityMeasure| {
            let bin = axis::bin(measure);
            let bins = self.reader.axis_f64(&bin)?;
            let shares = self.array(&disaggregation::share(measure), [site, poe, strength, (&bin, bins.len())])?;
            let path = influence::u_without_m(measure);
            let without_m =
                self.reader.exists(&path).then(|| self.array(&path, [site, poe, record, strength])).transpose()?;
            Ok(StoredInfluence { measure, without_m, bins, shares })
        };
        let has = |measure: &IntensityMeasure| self.reader.exists(&disaggregation::share(*measure));
        self.measures().into_iter().filter(has).map(of).collect()
    }
}
