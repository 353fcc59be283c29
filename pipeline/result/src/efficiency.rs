//! Efficiency and sufficiency as `uplift measures` left them in a result.

use uplift_motion::IntensityMeasure;

use super::file::ResultFile;
use super::layout::{axis, efficiency, sufficiency};
use crate::error::ResultError;

/// How efficient and sufficient a measure is, over the strengths; NaN where that is not known.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredEfficiency {
    /// The measure.
    pub measure: IntensityMeasure,
    /// The measure that the records of the runs were scaled to.
    pub scaled_to: IntensityMeasure,
    /// Deviation of the logarithm of the level at which a displacement is reached, median over displacements: what
    /// ranks measures. NaN in results of versions that did not ask.
    pub reaching: Vec<f64>,
    /// Median dispersion of the stripes whose median rocks.
    pub rocking: Vec<f64>,
    /// Share of these stripes that have none, for zeros or overturning.
    pub undefined: Vec<f64>,
    /// Deviation of the logarithm of the level at first uplift.
    pub initiation: Vec<f64>,
    /// Trends of the residuals with what a record is.
    pub trends: Vec<StoredTrend>,
}

/// A trend of the residuals of a measure with one covariate, over the strengths; NaN where there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredTrend {
    /// `magnitude`, `ln_rrup`, `ln_duration`.
    pub covariate: String,
    /// Change of the mean logarithmic residual with it.
    pub slope: Vec<f64>,
    /// Probability of such a slope if there were none.
    pub p_value: Vec<f64>,
}

impl ResultFile {
    /// Efficiency and sufficiency of each measure of a result of uniform risk; none before `uplift measures`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn efficiency(&self) -> Result<Vec<StoredEfficiency>, ResultError> {
        let strengths = (axis::STRENGTH, self.axes()?.strengths.len());
        let over_strengths = |path: &str| self.checked(path, self.reader.array_f64(path)?, &[strengths]);
        let of = |measure: IntensityMeasure| {
            let group = format!("{}/{}", sufficiency::ROOT, measure.key());
            let covariates = if self.reader.exists(&group) { self.reader.children(&group)? } else { Vec::new() };
            let trend = |covariate: String| {
                let array = |name| over_strengths(&sufficiency::array(measure, &covariate, name));
                Ok(StoredTrend { slope: array("slope")?, p_value: array("p_value")?, covariate })
            };
            // results of earlier versions have no others
            let said = self.reader.attribute_text(&efficiency::group(measure), "scaled_to").ok();
            let scaled_to = said.and_then(|key| key.parse().ok()).unwrap_or(measure);
            let reaching = efficiency::reaching(measure);
            Ok(StoredEfficiency {
                measure,
                scaled_to,
                reaching: if self.reader.exists(&reaching) {
                    over_strengths(&reaching)?
                } else {
                    vec![f64::NAN; strengths.1]
                },
                rocking: over_strengths(&efficiency::rocking(measure))?,
                undefined: over_strengths(&efficiency::undefined(measure))?,
                initiation: over_strengths(&efficiency::initiation(measure))?,
                trends: covariates.into_iter().map(trend).collect::<Result<_, ResultError>>()?,
            })
        };
        self.measures_in(efficiency::ROOT).into_iter().map(of).collect()
    }
}
