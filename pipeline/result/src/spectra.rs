//! The uniform risk spectra of a result, and what was fitted to them.

use serde::{Serialize, Serializer};
use uplift_job::Array;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::IntensityMeasure;
use uplift_regression::{Exponential, ExponentialFit};
use uplift_risk::OrdinateFlag;

use super::declared::{Group, Quantity, measure_names, quantity};
use super::layout::attribute::{Attribute, precision as attribute};
use super::layout::axis;
use super::stored_result::{RiskAxes, StoredResult};
use crate::error::ResultError;

/// The spectra of a result, read as its study says (`risk.contour`), with their coefficients.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredSpectra {
    /// Uplift strengths.
    pub strengths: Vec<f64>,
    /// Probabilities of exceedance.
    pub poes: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// Names of the sites; none in a study that ends with the stripes.
    pub sites: Vec<String>,
    /// The measures, PGV first; none in a study that ends with the stripes.
    pub measures: Vec<MeasureSpectra>,
}

/// The spectra of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureSpectra {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Displacements `[site, poe, strength]`, m; infinite where censored.
    pub u_m: Array<3>,
    /// What kind of ordinate each is `[site, poe, strength]`.
    pub flags: Array<3, OrdinateFlag>,
    /// Shares of the risk of each that come from below the first stripe `[site, poe, strength]`, 0 to 1.
    pub lower_tail_share: Array<3>,
    /// Shares of the risk of each that come from above the last stripe `[site, poe, strength]`, 0 to 1.
    pub upper_tail_share: Array<3>,
    /// Their coefficients `[site, poe]`.
    pub fits: Fits,
}

/// Uniform risk spectra: the arrays of `/urs/<im>`.
pub mod urs {
    use super::axis::{POE, SITE, STRENGTH};
    use super::{Group, MeasureSpectra, Quantity, quantity};

    /// The group.
    pub const GROUP: Group<MeasureSpectra> =
        Group { path: "/urs/<im>", quantities: &[U_M, FLAG, LOWER_TAIL_SHARE, UPPER_TAIL_SHARE] };
    /// The spectra.
    pub const U_M: Quantity<MeasureSpectra> = quantity!("u_m" [SITE, POE, STRENGTH] F64 "m"
        "uniform risk displacement" ("the spectra; `inf` where censored")
        as "u_m" "u, m" = |of, at| of.u_m[at]);
    /// What kind of ordinate each is.
    pub const FLAG: Quantity<MeasureSpectra> = quantity!("flag" [SITE, POE, STRENGTH] Flag "1"
        "0 regular, 1 no exceedance so that the ordinate is 0, 2 censored"
        ("0 regular; 1 no exceedance, ordinate 0; 2 censored") as "flag" = |of, at| of.flags[at]);
    /// The risk from below the first level.
    pub const LOWER_TAIL_SHARE: Quantity<MeasureSpectra> = quantity!("lower_tail_share" [SITE, POE, STRENGTH] F64 "1"
        "share of the risk from below the first level"
        as "lower_tail_share" "share from below" = |of, at| of.lower_tail_share[at]);
    /// The risk from above the last level.
    pub const UPPER_TAIL_SHARE: Quantity<MeasureSpectra> = quantity!("upper_tail_share" [SITE, POE, STRENGTH] F64 "1"
        "share of the risk from above the last level"
        as "upper_tail_share" "share from above" = |of, at| of.upper_tail_share[at]);
}

/// Coefficients of Eq. 4.11: the arrays of `/regression/<im>`.
pub mod regression {
    use super::axis::{POE, SITE};
    use super::{Fits, Group, Quantity, quantity};

    /// The group.
    pub const GROUP: Group<Fits> = Group {
        path: "/regression/<im>",
        quantities: &[C0_M, C1, C2_M, RMSE_M, RMSE_PLAIN_M, MAX_ABS_RESIDUAL_M, BOUND_ACTIVE, POINTS],
    };
    /// The numbers among those that are exported.
    pub const COEFFICIENTS: &[Quantity<Fits>] = &[C0_M, C1, C2_M, RMSE_M];
    /// Amplitude.
    pub const C0_M: Quantity<Fits> = quantity!("c0_m" [SITE, POE] F64 "m" "c0 of u = c0 exp(c1 strength) + c2"
        ("coefficient of Eq. 4.11; NaN where there is no fit, here and below")
        as "c0_m" "c0, m" = |of, at| of[at].c0_m);
    /// Exponent.
    pub const C1: Quantity<Fits> = quantity!("c1" [SITE, POE] F64 "1" "c1" as "c1" "c1, -" = |of, at| of[at].c1);
    /// Constant.
    pub const C2_M: Quantity<Fits> = quantity!("c2_m" [SITE, POE] F64 "m" "c2, not negative"
        as "c2_m" "c2, m" = |of, at| of[at].c2_m);
    /// Root mean square error.
    pub const RMSE_M: Quantity<Fits> = quantity!("rmse_m" [SITE, POE] F64 "m"
        "root mean square error with n - 3 degrees of freedom" as "rmse_m" "RMSE, m" = |of, at| of[at].rmse_m);
    /// Root mean square error over n points.
    pub const RMSE_PLAIN_M: Quantity<Fits> = quantity!("rmse_plain_m" [SITE, POE] F64 "m"
        "root mean square error over n points" = |of, at| of[at].rmse_plain_m);
    /// Largest residual.
    pub const MAX_ABS_RESIDUAL_M: Quantity<Fits> = quantity!("max_abs_residual_m" [SITE, POE] F64 "m"
        "largest residual" = |of, at| of[at].max_abs_residual_m);
    /// Whether c2 is held at 0.
    pub const BOUND_ACTIVE: Quantity<Fits> = quantity!("bound_active" [SITE, POE] Bool "1"
        "1 where c2 is held at 0" as "bound_active" "c2 held at 0" = |of, at| of[at].bound_active);
    /// Strengths fitted.
    pub const POINTS: Quantity<Fits> = quantity!("points" [SITE, POE] U32 "1"
        "strengths fitted, 0 where there is no fit" ("strengths fitted, n; 0 where there is no fit")
        = |of, at| of[at].points);
}

/// Coefficients of spectra `[site, poe]`.
pub type Fits = Array<2, Fit>;

/// Coefficients of Eq. 4.11; NaN where there is no fit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Fit {
    /// c0, m.
    #[serde(rename = "c0")]
    pub c0_m: f64,
    /// c1.
    pub c1: f64,
    /// c2, m.
    #[serde(rename = "c2")]
    pub c2_m: f64,
    /// Root mean square error with n − 3 degrees of freedom, m.
    #[serde(rename = "rmse")]
    pub rmse_m: f64,
    /// Root mean square error over n points, m; NaN of repaired spectra that are read from a file.
    #[serde(skip)]
    pub rmse_plain_m: f64,
    /// Largest residual, m; NaN of repaired spectra that are read from a file.
    #[serde(skip)]
    pub max_abs_residual_m: f64,
    /// True where c2 is held at 0.
    #[serde(skip)]
    pub bound_active: bool,
    /// Strengths fitted; 0 where there is no fit, and of repaired spectra that are read from a file.
    #[serde(skip)]
    pub points: u32,
}

impl Fit {
    /// No fit.
    pub const NONE: Self = Self {
        c0_m: f64::NAN,
        c1: f64::NAN,
        c2_m: f64::NAN,
        rmse_m: f64::NAN,
        rmse_plain_m: f64::NAN,
        max_abs_residual_m: f64::NAN,
        bound_active: false,
        points: 0,
    };

    /// What a fit found, if there is one.
    pub fn from_exponential(fit: Option<&ExponentialFit>) -> Self {
        fit.map_or(Self::NONE, |fit| Self {
            c0_m: fit.c0,
            c1: fit.c1,
            c2_m: fit.c2,
            rmse_m: fit.rmse,
            rmse_plain_m: fit.rmse_plain,
            max_abs_residual_m: fit.max_abs_residual,
            bound_active: fit.bound_active,
            points: u32::try_from(fit.points).unwrap_or(u32::MAX),
        })
    }

    /// The curve; none where there is no fit.
    pub fn curve(&self) -> Option<Exponential> {
        self.c0_m.is_finite().then_some(Exponential { c0: self.c0_m, c1: self.c1, c2: self.c2_m })
    }
}

/// One spectrum, named by what it is of.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spectrum<'a> {
    /// Site.
    pub site: &'a str,
    /// Measure, by its label where it is serialized.
    #[serde(rename = "im", serialize_with = "label")]
    pub measure: IntensityMeasure,
    /// Probability of exceedance in the years of the study.
    pub poe: f64,
    /// Displacements over the strengths of the result, m; infinite where censored.
    pub u_m: &'a [f64],
    /// What kind of ordinate each is, in a word where it is serialized.
    #[serde(serialize_with = "words")]
    pub flags: &'a [OrdinateFlag],
    /// Share of the risk of each that comes from below the first stripe, 0 to 1.
    pub lower_tail_share: &'a [f64],
    /// Share of the risk of each that comes from above the last stripe, 0 to 1.
    pub upper_tail_share: &'a [f64],
    /// Its coefficients.
    #[serde(skip)]
    pub fit: Fit,
}

fn label<S: Serializer>(measure: &IntensityMeasure, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(measure.label())
}

fn words<S: Serializer>(flags: &[OrdinateFlag], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(flags.iter().map(|flag| flag.word()))
}

impl StoredSpectra {
    /// Every spectrum, by measure, then site, then probability.
    pub fn rows(&self) -> impl Iterator<Item = Spectrum<'_>> {
        self.measures.iter().flat_map(|measure| {
            measure.u_m.blocks().map(|([site, poe], u_m)| Spectrum {
                site: &self.sites[site],
                measure: measure.measure,
                poe: self.poes[poe],
                u_m,
                flags: measure.flags.block([site, poe]),
                lower_tail_share: measure.lower_tail_share.block([site, poe]),
                upper_tail_share: measure.upper_tail_share.block([site, poe]),
                fit: measure.fits[[site, poe]],
            })
        })
    }
}

impl MeasureSpectra {
    /// Room for the spectra of a measure, `[site, poe, strength]`.
    fn empty(measure: IntensityMeasure, [sites, poes, strengths]: [usize; 3]) -> Self {
        let nan = Array::from_fn([sites, poes, strengths], |_| f64::NAN);
        Self {
            measure,
            flags: nan.map(|_| OrdinateFlag::Regular),
            lower_tail_share: nan.clone(),
            upper_tail_share: nan.clone(),
            u_m: nan,
            fits: Array::from_fn([sites, poes], |_| Fit::NONE),
        }
    }

    /// Lengths of the axes of its arrays.
    fn lengths(&self) -> [(&'static str, usize); 3] {
        let [sites, poes, strengths] = self.u_m.shape();
        [(axis::SITE.name, sites), (axis::POE.name, poes), (axis::STRENGTH.name, strengths)]
    }

    /// Writes the spectra into the group of their measure.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_spectra(&self, writer: &mut LabelledWriter) -> Result<(), LabelledError> {
        urs::GROUP.write(writer, &measure_names(self.measure), &self.lengths(), self)
    }

    /// Writes their coefficients into the group of their measure.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_coefficients(&self, writer: &mut LabelledWriter) -> Result<(), LabelledError> {
        regression::GROUP.write(writer, &measure_names(self.measure), &self.lengths(), &self.fits)
    }
}

impl StoredResult {
    /// How well the records know the spectra, a sentence a measure; none in older results, and where nothing can be
    /// said.
    pub fn precision(&self) -> Vec<String> {
        let words = |measure: IntensityMeasure| attribute::PRECISION.read(&self.reader, &measure_names(measure)).ok();
        self.measures().into_iter().filter_map(words).collect()
    }

    /// Half of the 90 % confidence band over the ordinate by `measure`, the middle one of sites and some strengths: as
    /// the records tell it one by one, and as their earthquakes tell it. None where no two pairs are known to share an
    /// earthquake, and in older results.
    pub fn half_widths(&self, measure: IntensityMeasure) -> Option<[f64; 2]> {
        let width = |attribute: &Attribute<f64>| attribute.read(&self.reader, &measure_names(measure)).ok();
        Some([width(&attribute::HALF_WIDTH)?, width(&attribute::HALF_WIDTH_BY_EVENT)?])
    }

    /// The spectra and coefficients of a result of uniform risk, at the study's risks.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn stored_spectra(&self) -> Result<StoredSpectra, ResultError> {
        let axes = self.stored_axes()?;
        let shape = [axes.sites.len(), axes.poes.len(), axes.strengths.len()];
        let mut measures = Vec::new();
        for measure in self.measures_in(urs::GROUP.root()) {
            let mut spectra = MeasureSpectra::empty(measure, shape);
            let lengths = spectra.lengths();
            regression::GROUP.read(self, &measure_names(measure), &lengths, &mut spectra.fits)?;
            urs::GROUP.read(self, &measure_names(measure), &lengths, &mut spectra)?;
            measures.push(spectra);
        }
        let RiskAxes { strengths, poes, years, sites, .. } = axes;
        Ok(StoredSpectra { strengths, poes, years, sites, measures })
    }
}
