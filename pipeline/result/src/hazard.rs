//! The hazard curves of a result, as used.

use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;

use super::declared::group;
use super::file::ResultFile;
use super::layout::attribute::curve::{NAME, WEIGHT};
use super::layout::axis;
use crate::error::ResultError;

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
    /// Weighted alternatives; none where there is but one curve.
    pub branches: Vec<StoredBranch>,
}

/// One of the weighted curves of a site.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredBranch {
    /// Its name.
    pub name: String,
    /// Its weight; those of a site add up to 1.
    pub weight: f64,
    /// The curve.
    pub curve: HazardCurve,
}

group! {
    /// A curve as used, of the name `<curve>`, over levels of its own.
    pub const HAZARD_CURVE: HazardCurve = "/hazard/<curve>";
    "maf_per_year" ["<axis>"] Made "1/yr" "mean annual frequency of exceedance"
        ("mean annual frequency of exceedance; of the n-th weighted curve in `branches/<n>`, over \
          `hazard_<site>_pgv_<n>`")
        = |of, at| of.maf()[at];
}

/// The name of the curve of a site: of its mean where it has branches.
pub fn curve_name(site: &str, measure: IntensityMeasure) -> String {
    format!("{site}/{}", measure.key())
}

/// The name of the weighted curve of a site at `index`.
pub fn branch_curve_name(site: &str, measure: IntensityMeasure, index: usize) -> String {
    format!("{}/branches/{}", curve_name(site, measure), index + 1)
}

impl ResultFile {
    /// The hazard curves of every measure, in units of the measures.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn hazard(&self) -> Result<Vec<StoredHazard>, ResultError> {
        self.hazard_with_branches(|_| true)
    }

    /// The same, with the weighted curves of the sites alone that `wanted` says of their positions: reading those of
    /// many sites takes seconds.
    ///
    /// # Errors
    /// As those of [`hazard`](Self::hazard).
    pub fn hazard_with_branches(&self, wanted: impl Fn(usize) -> bool) -> Result<Vec<StoredHazard>, ResultError> {
        let axes = self.axes_with_sites()?;
        let of_measure = |measure| {
            let of_site = |(position, site): (usize, &String)| {
                let branches = if wanted(position) { self.branches(site, measure)? } else { Vec::new() };
                Ok(StoredCurves { curve: self.site_curve(site, measure)?, branches })
            };
            let sites = axes.sites.iter().enumerate().map(of_site).collect::<Result<_, ResultError>>()?;
            Ok(StoredHazard { measure, sites })
        };
        self.measures().into_iter().map(of_measure).collect()
    }

    /// The curve of a site by any measure, whether the study is analysed by it or not; none where it has none.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn mean_curve(&self, site: &str, measure: IntensityMeasure) -> Result<Option<HazardCurve>, ResultError> {
        let name = curve_name(site, measure);
        let is_there = self.reader.exists(&HAZARD_CURVE.group(&[("<curve>", &name)]));
        is_there.then(|| self.curve(&name, measure)).transpose()
    }

    /// The levels of every measure with stripes.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn levels(&self) -> Result<Vec<(IntensityMeasure, Vec<f64>)>, ResultError> {
        let of = |measure| Ok((measure, self.reader.axis::<f64>(&axis::STRIPE_LEVEL.for_measure(measure))?));
        self.measures().into_iter().map(of).collect()
    }

    /// The weighted curves of a site; none where it has but one curve.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn branches(&self, site: &str, measure: IntensityMeasure) -> Result<Vec<StoredBranch>, ResultError> {
        let of_curve = |curve: String| {
            let names = [("<curve>", &*curve)];
            let (name, weight) = (NAME.read(&self.reader, &names)?, WEIGHT.read(&self.reader, &names)?);
            Ok(StoredBranch { name, weight, curve: self.curve(&curve, measure)? })
        };
        let names = (0..).map(|index| branch_curve_name(site, measure, index));
        names.take_while(|curve| HAZARD_CURVE.is_in(self, &[("<curve>", curve)])).map(of_curve).collect()
    }

    /// The curve of a site; the mean where it has several.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn site_curve(&self, site: &str, measure: IntensityMeasure) -> Result<HazardCurve, ResultError> {
        self.curve(&curve_name(site, measure), measure)
    }

    /// The curve of this name.
    fn curve(&self, name: &str, measure: IntensityMeasure) -> Result<HazardCurve, ResultError> {
        let path = HAZARD_CURVE.first_path(&[("<curve>", name)]);
        let maf = self.reader.array::<f64>(&path)?;
        let [axis] = &maf.dims[..] else { return Err(self.damaged(format!("{path} is not a curve"))) };
        let im = self.reader.axis::<f64>(axis)?;
        HazardCurve::new(measure.label(), measure.unit(), "", im, maf.values)
            .map_err(|error| self.fail(format!("{path}: {error}")))
    }
}
