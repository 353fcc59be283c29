//! The peak displacements of a result, as the file holds them.

use uplift_job::Array;
use uplift_motion::IntensityMeasure;

use super::declared::{group, measure_names};
use super::layout::axis::{RECORD, SITE, STRENGTH, STRIPE_LEVEL, THRESHOLD};
use super::stored_result::{RiskAxes, StoredResult};
use crate::error::ResultError;

group! {
    /// Peak displacements of all runs; `<not_of_level>` says what is NaN, where something is.
    pub const PEAKS: Array<3> = "/ida/<im>";
    "edp_m" [RECORD, STRENGTH, STRIPE_LEVEL] F64 "m" "peak displacement, infinite where overturned<not_of_level>"
        ("peak displacement; `inf` = overturned, NaN = the record is not of the level (`records.at_level`)")
        = |of, at| of[at];
}

group! {
    /// Impacts of the same runs.
    pub const IMPACTS: Array<3, u32> = PEAKS.path;
    "impacts" [RECORD, STRENGTH, STRIPE_LEVEL] U32 "1" "number of impacts" = |of, at| of[at];
}

group! {
    /// Scale factors, where levels have records of their own.
    pub const FACTORS: Array<2> = PEAKS.path;
    "factor" [RECORD, STRIPE_LEVEL] F64 "1" "scale factor of the record, NaN where it does not belong to the level"
        ("scale factor, NaN where the record is not of the level; only with `records.at_level`") = |of, at| of[at];
}

group! {
    /// How much each record counts, where they do not all count alike.
    pub const SHARES: Array<2> = PEAKS.path;
    "share" [STRIPE_LEVEL, RECORD] F64 "1" "how much the record counts at the level, 0 where it does not belong to it"
        ("how much the record counts at the level, 0 where it is not of it; only where records do not all count alike \
          at every level") = |of, at| of[at];
}

group! {
    /// The risk surface.
    pub const RISK_SURFACE: Array<3> = "/risk/<im>";
    "maf_per_year" [SITE, STRENGTH, THRESHOLD] F64 "1/yr" "mean annual frequency of exceeding the threshold"
        ("the risk surface (Figure 4.4a)") = |of, at| of[at];
}

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

impl StoredResult {
    /// The measures with stripes, PGV first.
    pub fn measures(&self) -> Vec<IntensityMeasure> {
        let is_there = |measure: &IntensityMeasure| PEAKS.is_in(self, &measure_names(*measure));
        self.measures_in(PEAKS.root()).into_iter().filter(is_there).collect()
    }

    /// The peak displacements by `measure`, over `axes`.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn peaks(&self, axes: &RiskAxes, measure: IntensityMeasure) -> Result<StoredPeaks, ResultError> {
        let level = STRIPE_LEVEL.for_measure(measure);
        let levels = self.reader.axis::<f64>(&level)?;
        let lengths =
            [(RECORD.name, axes.records.len()), (STRENGTH.name, axes.strengths.len()), (level.as_str(), levels.len())];
        let edp_m = PEAKS.read_array("edp_m", self, &measure_names(measure), lengths)?;
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
        let (names, level) = (measure_names(measure), STRIPE_LEVEL.for_measure(measure));
        if !FACTORS.is_in(self, &names) {
            return Ok(None);
        }
        let factors = FACTORS
            .read_array("factor", self, &names, [(RECORD.name, records), (level.as_str(), levels)])?
            .into_values();
        Ok(Some(SetsOfLevels { factors, shares: self.shares_of_levels(records, measure, levels)? }))
    }

    /// How much each record counts `[level, record]`; none where all count alike.
    fn shares_of_levels(
        &self,
        records: usize,
        measure: IntensityMeasure,
        levels: usize,
    ) -> Result<Option<Vec<f64>>, ResultError> {
        let (names, level) = (measure_names(measure), STRIPE_LEVEL.for_measure(measure));
        let lengths = [(level.as_str(), levels), (RECORD.name, records)];
        SHARES
            .is_in(self, &names)
            .then(|| Ok(SHARES.read_array("share", self, &names, lengths)?.into_values()))
            .transpose()
    }
}
