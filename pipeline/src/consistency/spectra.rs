//! The spectra of a repaired set, beside the plain ones.

use rayon::prelude::*;
use uplift_motion::IntensityMeasure;
use uplift_regression::ExponentialFit;
use uplift_risk::{Ordinate, PooledDemand, RiskCurve, RunWeights};

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

/// What spectra are read of, whether of a run or of a result.
pub(crate) struct Spectral<'a> {
    /// Strengths.
    pub(crate) strengths: &'a [f64],
    /// Only strengths above this are fitted.
    pub(crate) fitted_above: f64,
    /// How ordinates are read.
    pub(crate) reading: &'a Reading,
    /// Number of sites.
    pub(crate) sites: usize,
}

/// The spectra of the weights in `findings` of the analysis by `measure`; `demand` pools that of a strength.
///
/// # Errors
/// Demands that are not demands, in a file that was changed.
pub(crate) fn repaired_spectra(
    measure: IntensityMeasure,
    findings: &[Finding],
    spectral: &Spectral<'_>,
    demand: impl Fn(usize) -> Result<PooledDemand, UpliftError> + Sync,
) -> Result<Repairs, UpliftError> {
    let weights: Vec<Option<&RunWeights>> = (0..spectral.sites)
        .map(|site| {
            let own = findings.iter().find(|finding| finding.site == site && finding.scaled_to == measure)?;
            own.repair.as_ref()?.as_ref().ok().map(|repaired| &repaired.weights)
        })
        .collect();
    let targets = spectral.reading.targets.len();
    let of_strength = |strength: usize| -> Result<Vec<Option<Vec<Ordinate>>>, UpliftError> {
        let demand = demand(strength)?;
        let read = |weights: &RunWeights| Ok(spectral.reading.ordinates(&RiskCurve::weighted(&demand, weights)?)?);
        weights.iter().map(|weights| weights.map(read).transpose()).collect()
    };
    let by_strength: Result<Vec<_>, UpliftError> =
        (0..spectral.strengths.len()).into_par_iter().map(of_strength).collect();
    let by_strength = by_strength?;
    let shape = [spectral.sites, targets, spectral.strengths.len()];
    let ordinates =
        Array::from_fn(shape, |[site, poe, strength]| by_strength[strength][site].as_ref().map(|of| of[poe]));
    let fits = Array::from_fn([spectral.sites, targets], |at| {
        let u_m: Option<Vec<f64>> =
            ordinates.block(at).iter().map(|ordinate| ordinate.map(|ordinate| ordinate.displacement_m)).collect();
        let u_m = u_m.ok_or_else(|| "the set could not be repaired".to_owned())?;
        fit_ordinates(spectral.strengths, &u_m, spectral.fitted_above)
    });
    Ok(Repairs { measure, ordinates, fits })
}
