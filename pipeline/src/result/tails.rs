//! What of the risk behind a spectrum comes from outside the analysed levels.

use uplift_motion::IntensityMeasure;

use super::file::ResultFile;
use super::layout::{axis, urs};
use crate::array::Array;
use crate::error::UpliftError;

/// Shares of the risk at the ordinates of one measure, 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct TailShares {
    /// The measure.
    pub measure: IntensityMeasure,
    /// From below the first level `[site, poe, strength]`.
    pub lower: Array<3>,
    /// From above the last level `[site, poe, strength]`.
    pub upper: Array<3>,
}

impl ResultFile {
    /// The tail shares of each measure of a result of uniform risk.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn tail_shares(&self) -> Result<Vec<TailShares>, UpliftError> {
        let axes = self.axes()?;
        let over =
            [(axis::SITE, axes.sites.len()), (axis::POE, axes.poes.len()), (axis::STRENGTH, axes.strengths.len())];
        let has = |measure: &IntensityMeasure| self.reader.exists(&urs::lower_tail_share(*measure));
        let of = |measure| {
            let lower = self.array(&urs::lower_tail_share(measure), over)?;
            let upper = self.array(&urs::upper_tail_share(measure), over)?;
            Ok(TailShares { measure, lower, upper })
        };
        IntensityMeasure::ALL.into_iter().filter(has).map(of).collect()
    }
}
