//! What a result knows of the consistency of its records with the hazard.

use uplift_motion::IntensityMeasure;

use super::file::ResultFile;
use super::layout::{axis, consistency};
use crate::array::Array;
use crate::consistency::consistency_of_asked;
use crate::error::UpliftError;

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
    /// Level that the records bring over the site's `[site, poe]`.
    pub ratio: Array<2>,
    /// Effective records under the weights `[site, level]`; none before a repair.
    pub effective_records: Option<Array<2>>,
    /// Displacements of weighted records `[site, poe, strength]`, m; NaN where there is no repair. None before one.
    pub u_m: Option<Array<3>>,
}

impl ResultFile {
    /// The consistency of the records with the hazard of another measure, at the risks asked for: one for each measure
    /// that they are scaled to; none where no site has curves of two measures, and in results of versions that did not
    /// ask.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn consistency(&self) -> Result<Vec<StoredConsistency>, UpliftError> {
        if self.asked.is_some() {
            let is_repaired = self.measures().iter().any(|&own| self.reader.exists(&consistency::array(own, "u_m")));
            return consistency_of_asked(self, is_repaired);
        }
        let mut found = Vec::new();
        for scaled_to in self.measures() {
            for other in IntensityMeasure::ALL {
                let path = consistency::array(scaled_to, &consistency::of_other(other, "site"));
                if self.reader.exists(&path) {
                    found.push(self.consistency_of(scaled_to, other)?);
                }
            }
        }
        Ok(found)
    }

    fn consistency_of(
        &self,
        scaled_to: IntensityMeasure,
        other: IntensityMeasure,
    ) -> Result<StoredConsistency, UpliftError> {
        let axes = self.stored_axes()?;
        let (sites, poes, strengths) = (axes.sites.len(), axes.poes.len(), axes.strengths.len());
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
        Ok(StoredConsistency {
            scaled_to,
            other,
            rate_per_year: by_rate(&array("rate_per_year"))?,
            site_level: by_rate(&of_other("site"))?,
            implied_level: by_rate(&of_other("implied"))?,
            repaired_level: is_repaired.then(|| by_rate(&of_other("repaired"))).transpose()?,
            bias: by_site(&of_other("bias"))?,
            max: by_site(&of_other("max"))?,
            verdict: self.checked(&verdict, self.reader.array_text(&verdict)?, &[(axis::SITE, sites)])?,
            ratio: self.array(&of_other("ratio"), [(axis::SITE, sites), (axis::POE, poes)])?,
            effective_records: is_repaired.then(|| self.array(&array("effective_records"), effective)).transpose()?,
            u_m: is_repaired.then(|| self.array(&array("u_m"), spectrum)).transpose()?,
        })
    }
}
