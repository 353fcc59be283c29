//! Efficiency and sufficiency as `uplift measures` left them in a result.

use uplift_fragility::Dispersion;
use uplift_motion::IntensityMeasure;
use uplift_regression::Line;

use super::declared::{group, measure_names};
use super::file::ResultFile;
use super::layout::attribute::efficiency::SCALED_TO;
use super::layout::axis::STRENGTH;
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
    /// Records whose level at first uplift is known.
    pub initiation_records: Vec<u32>,
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
    /// Standard error of the slope.
    pub slope_error: Vec<f64>,
    /// Probability of such a slope if there were none.
    pub p_value: Vec<f64>,
    /// Share of the variance explained.
    pub r_squared: Vec<f64>,
}

group! {
    /// Scatter of the demand; `<levels>` are those of the measure, or common ones where records are scaled to another.
    pub const EFFICIENCY_OF_STRIPES: Vec<Dispersion> = EFFICIENCY.path;
    "median_m" [STRENGTH, "<levels>"] Made "m" "median demand"
        ("median demand; of a measure that records were not scaled to the second axis is `<measure>_common_level`, and \
          the attribute `scaled_to` names the one that they were") = |of, at| of[at].median_m;
    "dispersion" [STRENGTH, "<levels>"] Made "1" "half the logarithm of the 84th over the 16th percentile"
        ("by percentiles; NaN where zeros or overturning forbid it, as the next one") = |of, at| of[at].by_percentiles;
    "ln_deviation" [STRENGTH, "<levels>"] Made "1" "standard deviation of the logarithm of the demand"
        = |of, at| of[at].of_logarithm;
    "zeros" [STRENGTH, "<levels>"] Made "1" "demands of zero" = |of, at| of[at].zeros as f64;
    "overturned" [STRENGTH, "<levels>"] Made "1" "overturned runs" = |of, at| of[at].overturned as f64;
}

group! {
    /// How efficient a measure is.
    pub const EFFICIENCY: StoredEfficiency = "/efficiency/<im>";
    later "reaching" [STRENGTH] F64 "1"
        "deviation of the logarithm of the level at which a displacement is reached, median over displacements"
        as "dispersion_level" "dispersion of the level" = |of, at| of.reaching[at];
    "rocking" [STRENGTH] F64 "1" "median dispersion of the stripes whose median rocks"
        as "dispersion_rocking" "dispersion, rocking" = |of, at| of.rocking[at];
    "undefined" [STRENGTH] F64 "1" "share of these stripes that have none, for zeros or overturning"
        as "undefined_share" "share undefined" = |of, at| of.undefined[at];
    "initiation" [STRENGTH] F64 "1" "deviation of the logarithm of the level at first uplift"
        as "dispersion_initiation" "dispersion, first uplift" = |of, at| of.initiation[at];
    "initiation_records" [STRENGTH] U32 "1" "records whose level at first uplift is known"
        = |of, at| of.initiation_records[at];
}

group! {
    /// Trends of the residuals with a covariate: `<covariate>`, in words `<with>`.
    pub const TRENDS: StoredTrend = "/sufficiency/<im>/<covariate>";
    "slope" [STRENGTH] F64 "1" "<with>: change of the mean logarithmic residual with it"
        ("change of the mean logarithmic residual with the covariate: `magnitude`, `ln_rrup`, `ln_duration`")
        as "slope" "slope over" = |of, at| of.slope[at];
    "slope_error" [STRENGTH] F64 "1" "<with>: standard error of the slope" = |of, at| of.slope_error[at];
    "p_value" [STRENGTH] F64 "1" "<with>: probability of such a slope if there were none"
        as "p_value" "p value of" = |of, at| of.p_value[at];
    "r_squared" [STRENGTH] F64 "1" "<with>: share of the variance explained" = |of, at| of.r_squared[at];
}

impl StoredTrend {
    /// The trends of the `lines` with a covariate, a line a strength.
    pub fn new(covariate: &str, lines: &[Option<Line>]) -> Self {
        let of = |value: fn(&Line) -> f64| lines.iter().map(|line| line.as_ref().map_or(f64::NAN, value)).collect();
        Self {
            covariate: covariate.to_owned(),
            slope: of(|line| line.slope),
            slope_error: of(|line| line.slope_error),
            p_value: of(|line| line.p_value),
            r_squared: of(|line| line.r_squared),
        }
    }
}

impl ResultFile {
    /// Efficiency and sufficiency of each measure of a result of uniform risk; none before `uplift measures`.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn efficiency(&self) -> Result<Vec<StoredEfficiency>, ResultError> {
        let strengths = self.axes()?.strengths.len();
        let lengths = &[(STRENGTH.name, strengths)];
        let of = |measure: IntensityMeasure| {
            let names = measure_names(measure);
            let trend = |covariate: String| {
                let mut trend = StoredTrend::new(&covariate, &vec![None; strengths]);
                TRENDS.read(self, &[names[0], ("<covariate>", &covariate)], lengths, &mut trend)?;
                Ok(trend)
            };
            let group = format!("{}/{}", TRENDS.root(), measure.key());
            let covariates = if self.reader.exists(&group) { self.reader.children(&group)? } else { Vec::new() };
            // results of earlier versions have no others
            let said = SCALED_TO.read(&self.reader, &names).ok();
            let nan = vec![f64::NAN; strengths];
            let mut found = StoredEfficiency {
                measure,
                scaled_to: said.and_then(|key| key.parse().ok()).unwrap_or(measure),
                reaching: nan.clone(),
                rocking: nan.clone(),
                undefined: nan.clone(),
                initiation: nan,
                initiation_records: vec![0; strengths],
                trends: covariates.into_iter().map(trend).collect::<Result<_, ResultError>>()?,
            };
            EFFICIENCY.read(self, &names, lengths, &mut found)?;
            Ok(found)
        };
        self.measures_in(EFFICIENCY.root()).into_iter().map(of).collect()
    }
}
