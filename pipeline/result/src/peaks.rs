//! The peak displacements of a result, as the file holds them.

use uplift_job::Array;
use uplift_motion::IntensityMeasure;

use super::RiskAxes;
use super::file::ResultFile;
use super::layout::{axis, ida};
use crate::error::ResultError;

/// The peak displacements of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredPeaks {
    /// Levels of the measure, cm/s or g.
    pub levels: Vec<f64>,
    /// Peak displacements `[record, strength, level]`, m; NaN where a record does not belong to a level.
    pub edp_m: Array<3>,
    /// How much each record counts `[level, record]`; none where all count alike.
    pub shares: Option<Vec<f64>>,
}

/// Levels with records of their own.
pub struct SetsOfLevels {
    /// Scale factors `[record, level]`, NaN where a record does not belong to a level.
    pub factors: Vec<f64>,
    /// How much each record counts `[level, record]`; none where all count alike.
    pub shares: Option<Vec<f64>>,
}

impl ResultFile {
    /// The peak displacements by `measure`, over `axes`.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn peaks(&self, axes: &RiskAxes, measure: IntensityMeasure) -> Result<StoredPeaks, ResultError> {
        let level = axis::level(measure);
        let levels = self.reader.axis_f64(&level)?;
        let lengths = [
            (axis::RECORD, axes.records.len()),
            (axis::STRENGTH, axes.strengths.len()),
            (level.as_str(), levels.len()),
        ];
        let edp_m = self.array(&ida::edp_m(measure), lengths)?;
        let shares = self.shares_of_levels(axes.records.len(), measure, levels.len())?;
        Ok(StoredPeaks { levels, edp_m, shares })
    }

    /// The records of each level; none where they are the same at all of them.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn sets_of_levels(
        &self,
        records: usize,
        measure: IntensityMeasure,
        levels: usize,
    ) -> Result<Option<SetsOfLevels>, ResultError> {
        let (path, level) = (ida::factor(measure), axis::level(measure));
        if !self.reader.exists(&path) {
            return Ok(None);
        }
        let factors = self.array(&path, [(axis::RECORD, records), (level.as_str(), levels)])?.into_values();
        Ok(Some(SetsOfLevels { factors, shares: self.shares_of_levels(records, measure, levels)? }))
    }

    /// How much each record counts `[level, record]`; none where all count alike.
    fn shares_of_levels(
        &self,
        records: usize,
        measure: IntensityMeasure,
        levels: usize,
    ) -> Result<Option<Vec<f64>>, ResultError> {
        let (path, level) = (ida::share(measure), axis::level(measure));
        let lengths = [(level.as_str(), levels), (axis::RECORD, records)];
        self.reader.exists(&path).then(|| Ok(self.array(&path, lengths)?.into_values())).transpose()
    }
}
