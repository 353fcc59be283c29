//! The spectra of a repaired set, beside the plain ones.

use rayon::prelude::*;
use uplift_motion::IntensityMeasure;
use uplift_regression::ExponentialFit;
use uplift_risk::{Ordinate, PooledDemand, RiskCurve, RunWeights};
use uplift_study::UniformRiskStudy;

use super::Finding;
use crate::array::Array;
use crate::error::UpliftError;
use crate::uniform_risk::{Reading, fit_ordinates};

/// The repaired spectra of one measure.
#[derive(Debug, Clone)]
pub(crate) struct Repairs {
    /// The measure that the records are scaled to.
    pub(crate) measure: IntensityMeasure,
    /// Ordinates `[site, poe, strength]`; none where the set could not be repaired.
    pub(crate) ordinates: Array<3, Option<Ordinate>>,
    /// Fits of Eq. 4.11 `[site, poe]`, or why there is none.
    pub(crate) fits: Array<2, Result<ExponentialFit, String>>,
}

/// The spectra of the weights in `findings` of the analysis by `measure`, read as `study` says; `demand` pools that of
/// a strength.
///
/// # Errors
/// Demands that are not demands, in a file that was changed.
pub(crate) fn repaired_spectra(
    study: &UniformRiskStudy,
    measure: IntensityMeasure,
    findings: &[Finding],
    demand: impl Fn(usize) -> Result<PooledDemand, UpliftError> + Sync,
) -> Result<Repairs, UpliftError> {
    let reading = Reading::of(study)?;
    let (sites, targets, strengths) = (study.sites.len(), reading.targets.len(), study.strengths.len());
    let of_site = |site: usize| findings.iter().find(|own| own.site == site && own.scaled_to == measure);
    let weights: Vec<Option<&RunWeights>> = (0..sites).map(|site| Some(&of_site(site)?.repaired()?.weights)).collect();
    let of_strength = |strength: usize| -> Result<Vec<Option<Vec<Ordinate>>>, UpliftError> {
        let demand = demand(strength)?;
        let read = |weights: &RunWeights| Ok(reading.ordinates(&RiskCurve::weighted(&demand, weights)?)?);
        weights.iter().map(|weights| weights.map(read).transpose()).collect()
    };
    let by_strength = (0..strengths).into_par_iter().map(of_strength).collect::<Result<Vec<_>, UpliftError>>()?;
    let ordinates = Array::from_fn([sites, targets, strengths], |[site, poe, strength]| {
        by_strength[strength][site].as_ref().map(|of| of[poe])
    });
    let fits = Array::from_fn([sites, targets], |at| {
        let u_m: Option<Vec<f64>> =
            ordinates.block(at).iter().map(|ordinate| ordinate.map(|ordinate| ordinate.displacement_m)).collect();
        let u_m = u_m.ok_or_else(|| "the set could not be repaired".to_owned())?;
        fit_ordinates(&study.strengths, &u_m, study.regression.strength_above)
    });
    Ok(Repairs { measure, ordinates, fits })
}
