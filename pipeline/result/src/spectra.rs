//! The uniform risk spectra of a result, and what was fitted to them.

use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_regression::{Exponential, ExponentialFit};
use uplift_risk::OrdinateFlag;

use super::file::ResultFile;
use super::layout::{URS_PRECISION, axis, regression, urs};
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
    pub fits: Array<2, Fit>,
}

/// Coefficients of Eq. 4.11; NaN where there is no fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// c0, m.
    pub c0_m: f64,
    /// c1.
    pub c1: f64,
    /// c2, m.
    pub c2_m: f64,
    /// Root mean square error with n − 3 degrees of freedom, m.
    pub rmse_m: f64,
    /// True where c2 is held at 0.
    pub bound_active: bool,
}

impl Fit {
    /// What a fit found, if there is one.
    pub fn of(fit: Option<&ExponentialFit>) -> Self {
        fit.map_or(
            Self { c0_m: f64::NAN, c1: f64::NAN, c2_m: f64::NAN, rmse_m: f64::NAN, bound_active: false },
            |fit| Self { c0_m: fit.c0, c1: fit.c1, c2_m: fit.c2, rmse_m: fit.rmse, bound_active: fit.bound_active },
        )
    }

    /// The curve; none where there is no fit.
    pub fn curve(&self) -> Option<Exponential> {
        self.c0_m.is_finite().then_some(Exponential { c0: self.c0_m, c1: self.c1, c2: self.c2_m })
    }
}

/// One spectrum, named by what it is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spectrum<'a> {
    /// Site.
    pub site: &'a str,
    /// Measure.
    pub measure: IntensityMeasure,
    /// Probability of exceedance in the years of the study.
    pub poe: f64,
    /// Displacements over the strengths of the result, m; infinite where censored.
    pub u_m: &'a [f64],
    /// What kind of ordinate each is.
    pub flags: &'a [OrdinateFlag],
    /// Share of the risk of each that comes from below the first stripe, 0 to 1.
    pub lower_tail_share: &'a [f64],
    /// Share of the risk of each that comes from above the last stripe, 0 to 1.
    pub upper_tail_share: &'a [f64],
    /// Its coefficients.
    pub fit: Fit,
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

impl ResultFile {
    /// How well the records know the spectra, a sentence a measure; none in results of before, and where nothing can be
    /// said.
    pub fn precision(&self) -> Vec<String> {
        let words = |measure: IntensityMeasure| self.reader.attribute_text(&urs::group(measure), URS_PRECISION).ok();
        self.measures().into_iter().filter_map(words).collect()
    }

    /// The spectra and coefficients of a result of uniform risk; of the risks that it was asked for, if it was
    /// ([`with_spectra`](Self::with_spectra)).
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn spectra(&self) -> Result<StoredSpectra, ResultError> {
        if let Some(asked) = &self.asked {
            return Ok(asked.spectra.clone());
        }
        let axes = self.axes()?;
        let (sites, poes) = ((axis::SITE, axes.sites.len()), (axis::POE, axes.poes.len()));
        let mut measures = Vec::new();
        for measure in self.measures_in(urs::ROOT) {
            let column = |path: &str| self.array(path, [sites, poes]);
            let (c0_m, c1) = (column(&regression::c0_m(measure))?, column(&regression::c1(measure))?);
            let (c2_m, rmse_m) = (column(&regression::c2_m(measure))?, column(&regression::rmse_m(measure))?);
            let path = regression::bound_active(measure);
            let bound = self.over(&path, self.reader.array_u8(&path)?, [sites, poes])?;
            let lengths = [sites, poes, (axis::STRENGTH, axes.strengths.len())];
            let of_ordinates = |path: &str| self.array(path, lengths);
            measures.push(MeasureSpectra {
                measure,
                u_m: of_ordinates(&urs::u_m(measure))?,
                flags: self.flags(measure, lengths)?,
                lower_tail_share: of_ordinates(&urs::lower_tail_share(measure))?,
                upper_tail_share: of_ordinates(&urs::upper_tail_share(measure))?,
                fits: Array::from_fn([sites.1, poes.1], |at| Fit {
                    c0_m: c0_m[at],
                    c1: c1[at],
                    c2_m: c2_m[at],
                    rmse_m: rmse_m[at],
                    bound_active: bound[at] == 1,
                }),
            });
        }
        let super::RiskAxes { strengths, poes, years, sites, .. } = axes;
        Ok(StoredSpectra { strengths, poes, years, sites, measures })
    }

    /// The flags of the ordinates of `measure`.
    fn flags(
        &self,
        measure: IntensityMeasure,
        lengths: [(&str, usize); 3],
    ) -> Result<Array<3, OrdinateFlag>, ResultError> {
        let path = urs::flag(measure);
        let numbers = self.over(&path, self.reader.array_u8(&path)?, lengths)?;
        if let Some(unknown) = numbers.values().iter().find(|&&number| flag_of(number).is_none()) {
            return Err(self.damaged(format!("{path} has the unknown flag {unknown}")));
        }
        Ok(numbers.map(|&number| flag_of(number).unwrap_or(OrdinateFlag::Regular)))
    }
}

/// The flag that is written as `number`.
fn flag_of(number: u8) -> Option<OrdinateFlag> {
    [OrdinateFlag::Regular, OrdinateFlag::NoExceedance, OrdinateFlag::Censored]
        .into_iter()
        .find(|&flag| flag_number(flag) == number)
}

/// How a flag stands in the file.
pub fn flag_number(flag: OrdinateFlag) -> u8 {
    match flag {
        OrdinateFlag::Regular => 0,
        OrdinateFlag::NoExceedance => 1,
        OrdinateFlag::Censored => 2,
    }
}

/// How it stands in tables.
pub fn flag_word(flag: OrdinateFlag) -> &'static str {
    match flag {
        OrdinateFlag::Regular => "regular",
        OrdinateFlag::NoExceedance => "no exceedance",
        OrdinateFlag::Censored => "censored",
    }
}
