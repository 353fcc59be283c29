//! The hazard curves of a result, as used.

use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;

use super::file::ResultFile;
use super::layout::{axis, hazard, ida};
use crate::error::UpliftError;

/// The hazard of one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredHazard {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Its curves `[site]`.
    pub sites: Vec<StoredCurves>,
}

/// The curves of one site.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredCurves {
    /// The curve; the mean where there are branches.
    pub curve: HazardCurve,
    /// Weighted alternatives, each its weight and curve; none where there is but one curve.
    pub branches: Vec<(f64, HazardCurve)>,
}

impl ResultFile {
    /// The hazard curves of every measure, in units of the measures.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn hazard(&self) -> Result<Vec<StoredHazard>, UpliftError> {
        let axes = self.axes_with_sites()?;
        let of_measure = |measure| {
            let sites = axes.sites.iter().map(|site| self.curves(site, measure)).collect::<Result<_, _>>()?;
            Ok(StoredHazard { measure, sites })
        };
        self.measures().into_iter().map(of_measure).collect()
    }

    /// The measures with stripes, PGV first.
    pub(super) fn measures(&self) -> Vec<IntensityMeasure> {
        let is_there = |measure: &IntensityMeasure| self.reader.exists(&ida::edp_m(*measure));
        self.measures_in(ida::ROOT).into_iter().filter(is_there).collect()
    }

    /// The measures with a group of their own in `group`, PGV first; none where there is no such group.
    pub(super) fn measures_in(&self, group: &str) -> Vec<IntensityMeasure> {
        let children = self.reader.children(group).unwrap_or_default();
        let mut measures: Vec<IntensityMeasure> = children.iter().filter_map(|name| name.parse().ok()).collect();
        measures.sort_unstable();
        measures
    }

    /// The curve of a site by any measure, whether the study is analysed by it or not; none where it has none.
    pub(crate) fn mean_curve(&self, site: &str, measure: IntensityMeasure) -> Result<Option<HazardCurve>, UpliftError> {
        let group = hazard::group(site, measure);
        self.reader.exists(&group).then(|| self.curve(&group, measure)).transpose()
    }

    /// The levels of every measure with stripes.
    pub(crate) fn levels(&self) -> Result<Vec<(IntensityMeasure, Vec<f64>)>, UpliftError> {
        let of = |measure| Ok((measure, self.reader.axis_f64(&axis::level(measure))?));
        self.measures().into_iter().map(of).collect()
    }

    /// The weighted curves of a site, each with its name and weight; none where it has but one curve.
    pub(crate) fn branches(
        &self,
        site: &str,
        measure: IntensityMeasure,
    ) -> Result<Vec<(String, f64, HazardCurve)>, UpliftError> {
        let of_group = |group: String| {
            let (name, weight) =
                (self.reader.attribute_text(&group, "name")?, self.reader.attribute_f64(&group, "weight")?);
            Ok((name, weight, self.curve(&group, measure)?))
        };
        (0..)
            .map(|index| hazard::branch(site, measure, index))
            .take_while(|group| self.reader.exists(group))
            .map(of_group)
            .collect()
    }

    /// The curves of one site and measure.
    pub(super) fn curves(&self, site: &str, measure: IntensityMeasure) -> Result<StoredCurves, UpliftError> {
        let branches = self.branches(site, measure)?;
        Ok(StoredCurves {
            curve: self.curve(&hazard::group(site, measure), measure)?,
            branches: branches.into_iter().map(|(_, weight, curve)| (weight, curve)).collect(),
        })
    }

    /// The curve in the group `group`.
    fn curve(&self, group: &str, measure: IntensityMeasure) -> Result<HazardCurve, UpliftError> {
        let path = hazard::maf_per_year(group);
        let maf = self.reader.array_f64(&path)?;
        let [axis] = &maf.dims[..] else { return Err(self.damaged(format!("{path} is not a curve"))) };
        let im = self.reader.axis_f64(axis)?;
        HazardCurve::new(measure.label(), measure.unit(), "", im, maf.values)
            .map_err(|error| self.fail(format!("{group}: {error}")))
    }
}
