//! What one set of stripes brings at one site, and the weights that mend it.

use rayon::prelude::*;
use uplift_consistency::{
    ConsistencyError, Diagnosis, NoRepair, RateRange, RecordSet, RepairOptions, Repaired, ScaledAnalysis,
};
use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;

use super::Question;
use crate::error::UniformRiskError;

/// The answer for the stripes of one measure at one site.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Position of the site.
    pub site: usize,
    /// The measure that the records are scaled to.
    pub scaled_to: IntensityMeasure,
    /// The measure whose hazard is compared.
    pub other: IntensityMeasure,
    /// Where it can be compared.
    pub range: RateRange,
    /// What records that count alike bring.
    pub diagnosis: Diagnosis,
    /// The repair, or why there is none; none where it was not asked for.
    pub repair: Option<Result<Box<Repaired>, NoRepair>>,
}

impl Finding {
    /// The repair; none where there is none, whether it was asked for or not.
    pub fn repaired(&self) -> Option<&Repaired> {
        self.repair.as_ref()?.as_deref().ok()
    }
}

impl Question {
    /// Every analysis at every site that has both curves, in this order; with repairs where `repair`.
    ///
    /// # Errors
    /// Levels and curves that do not fit, which an analysis of the study would find as well.
    pub fn findings(&self, repair: bool) -> Result<Vec<Finding>, UniformRiskError> {
        let mut findings = Vec::new();
        for (scaled_to, levels) in &self.analyses {
            let Some(other) = self.other(*scaled_to) else { continue };
            let set = self.set(*scaled_to, other)?;
            let of_site = |site| self.finding(site, (*scaled_to, levels), other, &set, repair);
            let of_sites: Result<Vec<Option<Finding>>, UniformRiskError> =
                (0..self.sites.len()).into_par_iter().map(of_site).collect();
            findings.extend(of_sites?.into_iter().flatten());
        }
        Ok(findings)
    }

    fn finding(
        &self,
        site: usize,
        (scaled_to, levels): (IntensityMeasure, &[f64]),
        other: IntensityMeasure,
        set: &RecordSet,
        repair: bool,
    ) -> Result<Option<Finding>, UniformRiskError> {
        let (Some(own), Some(compared)) = (self.curve(scaled_to, site), self.curve(other, site)) else {
            return Ok(None);
        };
        self.finding_of(site, (scaled_to, levels), other, set, (own, compared), repair).map(Some)
    }

    /// The answer for a set scaled to `levels`, with the curves of both measures.
    ///
    /// # Errors
    /// As [`findings`](Self::findings).
    pub fn finding_of(
        &self,
        site: usize,
        (scaled_to, levels): (IntensityMeasure, &[f64]),
        other: IntensityMeasure,
        set: &RecordSet,
        curves: (&HazardCurve, &HazardCurve),
        repair: bool,
    ) -> Result<Finding, UniformRiskError> {
        let analysis = self.analysis(levels, set, curves)?;
        let options = RepairOptions {
            smoothness: self.settings.smoothness,
            least_effective: self.settings.least_effective as f64,
            scale_factor_limits: self.settings.scale_factors,
        };
        let diagnosis = analysis.diagnose(None, options.scale_factor_limits)?;
        let repair = match repair.then(|| analysis.repair(&options)) {
            None => None,
            Some(Ok(repaired)) => Some(Ok(Box::new(repaired))),
            Some(Err(ConsistencyError::NoRepair(reason))) => Some(Err(reason)),
            Some(Err(error)) => return Err(error.into()),
        };
        Ok(Finding { site, scaled_to, other, range: *analysis.range(), diagnosis, repair })
    }

    /// A set scaled to `levels`, with the hazard of the measure that it is scaled to and of the other one.
    pub(super) fn analysis<'a>(
        &self,
        levels: &[f64],
        set: &'a RecordSet,
        (own, compared): (&HazardCurve, &'a HazardCurve),
    ) -> Result<ScaledAnalysis<'a>, UniformRiskError> {
        Ok(ScaledAnalysis::new(set, levels, own, compared, &self.targets_per_year, self.extrapolation)?)
    }
}
