//! What a result knows of the consistency of its records with the hazard.

use uplift_job::Array;
use uplift_motion::IntensityMeasure;

use super::declared::{Group, Quantity, of_measure};
use super::file::ResultFile;
use super::layout::{axis, consistency};
use super::spectra::{Fit, Fits, regression};
use crate::error::ResultError;

/// The consistency of the records scaled to one measure; NaN at sites that were not looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredConsistency {
    /// The measure that records are scaled to.
    pub scaled_to: IntensityMeasure,
    /// The measure whose hazard is compared.
    pub other: IntensityMeasure,
    /// Rates at which it is, 1/yr, `[site, rate]`.
    pub rate_per_year: Array<2>,
    /// Levels of the site's own curve `[site, rate]`.
    pub site_level: Array<2>,
    /// Levels that the records bring `[site, rate]`.
    pub implied_level: Array<2>,
    /// Levels that weighted records bring `[site, rate]`; none before a repair.
    pub repaired_level: Option<Array<2>>,
    /// How many times the site's level the records bring, mean of the range `[site]`.
    pub bias: Vec<f64>,
    /// Largest |ln(implied/site)| `[site]`.
    pub max: Vec<f64>,
    /// `consistent`, `off`, `inconsistent`, or empty `[site]`.
    pub verdict: Vec<String>,
    /// Probabilities that ratios and repaired spectra are of.
    pub poes: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// Level that the records bring over the site's `[site, poe]`.
    pub ratio: Array<2>,
    /// Effective records under the weights `[site, level]`; none before a repair.
    pub effective_records: Option<Array<2>>,
    /// Fewest effective records at a level within the rates compared `[site]`; NaN where there is no repair. None
    /// before one.
    pub least_effective: Option<Vec<f64>>,
    /// Displacements of weighted records `[site, poe, strength]`, m; NaN where there is no repair. None before one.
    pub u_m: Option<Array<3>>,
    /// Coefficients of these spectra `[site, poe]`; NaN where there is no fit. None before a repair.
    pub fits: Option<Fits>,
}

/// Coefficients of the spectra of weighted records.
pub const REPAIRED_FITS: Group<Fits> = Group {
    path: "/consistency/<im>/regression",
    quantities: &[
        Quantity { long_name: "c0 of u = c0 exp(c1 strength) + c2, weighted records", ..regression::C0_M },
        regression::C1,
        regression::C2_M,
        regression::RMSE_M,
    ],
};

impl StoredConsistency {
    /// Whether there are spectra of weighted records at a site.
    pub fn is_repaired(&self, site: usize) -> bool {
        self.u_m.as_ref().is_some_and(|u_m| u_m.block([site]).iter().any(|u_m| !u_m.is_nan()))
    }

    /// Whether these are to be shown beside the plain spectra: there are some, and the plain ones are of records that
    /// do not bring the site's hazard.
    pub fn stands_beside(&self, site: usize) -> bool {
        self.verdict[site] == "inconsistent" && self.is_repaired(site)
    }
}

impl ResultFile {
    /// The consistency of the records with the hazard of another measure, at the risks asked for: one for each measure
    /// that they are scaled to; none where no site has curves of two measures, and in results of versions that did not
    /// ask.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn consistency(&self) -> Result<Vec<StoredConsistency>, ResultError> {
        if let Some(asked) = &self.asked {
            return Ok(asked.consistency.clone());
        }
        let mut found = Vec::new();
        for scaled_to in self.measures() {
            let arrays = self.reader.children(&consistency::group(scaled_to)).unwrap_or_default();
            for other in arrays.iter().filter_map(|name| consistency::other_of_site(name)) {
                found.push(self.consistency_of(scaled_to, other)?);
            }
        }
        Ok(found)
    }

    /// Whether there are spectra of weighted records.
    pub fn has_repair(&self) -> bool {
        self.measures().iter().any(|&own| self.reader.exists(&consistency::array(own, "u_m")))
    }

    fn consistency_of(
        &self,
        scaled_to: IntensityMeasure,
        other: IntensityMeasure,
    ) -> Result<StoredConsistency, ResultError> {
        let axes = self.stored_axes()?;
        let (sites, poes, strengths) = (axes.sites.len(), axes.poes.len(), axes.strengths.len());
        let by_poe = [(axis::SITE, sites), (axis::POE, poes)];
        let rates = self.reader.axis_u32(axis::RATE)?.len();
        let level = axis::level(scaled_to);
        let levels = self.reader.axis_f64(&level)?.len();
        let array = |name: &str| consistency::array(scaled_to, name);
        let of_other = |name: &str| array(&consistency::of_other(other, name));
        let by_rate = |path: &str| self.array(path, [(axis::SITE, sites), (axis::RATE, rates)]);
        let by_site = |path: &str| self.array(path, [(axis::SITE, sites)]).map(Array::into_values);
        let verdict = of_other("verdict");
        let is_repaired = self.reader.exists(&array("u_m"));
        let spectrum = [(axis::SITE, sites), (axis::POE, poes), (axis::STRENGTH, strengths)];
        let effective = [(axis::SITE, sites), (level.as_str(), levels)];
        let rate_per_year = by_rate(&array("rate_per_year"))?;
        let effective_records = is_repaired.then(|| self.array(&array("effective_records"), effective)).transpose()?;
        let least = |records| self.least_effective(scaled_to, &axes.sites, &rate_per_year, records);
        let least_effective = effective_records.as_ref().map(least).transpose()?;
        Ok(StoredConsistency {
            scaled_to,
            other,
            rate_per_year,
            site_level: by_rate(&of_other("site"))?,
            implied_level: by_rate(&of_other("implied"))?,
            repaired_level: is_repaired.then(|| by_rate(&of_other("repaired"))).transpose()?,
            bias: by_site(&of_other("bias"))?,
            max: by_site(&of_other("max"))?,
            verdict: self.checked(&verdict, self.reader.array_text(&verdict)?, &[(axis::SITE, sites)])?,
            poes: axes.poes,
            years: axes.years,
            ratio: self.array(&of_other("ratio"), by_poe)?,
            effective_records,
            least_effective,
            u_m: is_repaired.then(|| self.array(&array("u_m"), spectrum)).transpose()?,
            fits: is_repaired.then(|| self.repaired_fits(scaled_to, by_poe)).transpose()?,
        })
    }

    /// The fewest of the effective `records` `[site, level]` at the levels whose rates are within those compared.
    fn least_effective(
        &self,
        scaled_to: IntensityMeasure,
        sites: &[String],
        rate_per_year: &Array<2>,
        records: &Array<2>,
    ) -> Result<Vec<f64>, ResultError> {
        let levels = self.reader.axis_f64(&axis::level(scaled_to))?;
        let extrapolation = self.stored_study()?.risk.extrapolate;
        let of_site = |(site, name): (usize, &String)| {
            let Some(curve) = self.mean_curve(name, scaled_to)? else { return Ok(f64::NAN) };
            let [high, .., low] = rate_per_year.block([site]) else { return Ok(f64::NAN) };
            let is_compared = |level: f64| {
                let rate = curve.rate_at_extrapolated(level, extrapolation);
                rate.is_ok_and(|rate| *low <= rate && rate <= *high)
            };
            let compared = levels.iter().zip(records.block([site])).filter(|(level, _)| is_compared(**level));
            // the least of none, and of numbers that are none, is none
            Ok(compared.map(|(_, records)| *records).fold(f64::NAN, f64::min))
        };
        sites.iter().enumerate().map(of_site).collect()
    }

    /// The coefficients of the repaired spectra.
    fn repaired_fits(&self, scaled_to: IntensityMeasure, by_poe: [(&str, usize); 2]) -> Result<Fits, ResultError> {
        let mut fits = Fits::from_fn(by_poe.map(|(_, length)| length), |_| Fit::NONE);
        REPAIRED_FITS.read(self, &of_measure(scaled_to), &by_poe, &mut fits)?;
        // it is nowhere below: where it is held it is exactly there
        Ok(fits.map(|fit| Fit { bound_active: fit.c2_m <= 0.0, ..*fit }))
    }
}
