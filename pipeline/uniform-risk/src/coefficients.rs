//! The coefficients of Table 4.2: each spectrum fitted by `u = c0 exp(c1 η) + c2` (Eq. 4.11).

use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_regression::{ExponentialFit, fit};
use uplift_result::{Fit, MeasureSpectra};
use uplift_risk::Ordinate;
use uplift_study::UniformRiskStudy;

use super::Spectra;

/// The fits of one measure.
#[derive(Debug, Clone)]
pub struct Coefficients {
    /// The measure.
    pub measure: IntensityMeasure,
    /// A fit, or why there is none, `[site, poe]`.
    pub fits: Array<2, Result<ExponentialFit, String>>,
}

/// Fit every spectrum over the strengths above `regression.strength_above`.
pub fn fit_spectra(study: &UniformRiskStudy, spectra: &Spectra) -> Coefficients {
    let [sites, poes, _] = spectra.ordinates.shape();
    let fits = Array::from_fn([sites, poes], |[site, poe]| fit_spectrum(study, spectra.spectrum(site, poe)));
    Coefficients { measure: spectra.measure, fits }
}

/// Fit one spectrum over the strengths above `regression.strength_above`, or say why there is no fit.
///
/// # Errors
/// A spectrum that has no fit: why.
pub(crate) fn fit_spectrum(study: &UniformRiskStudy, spectrum: &[Ordinate]) -> Result<ExponentialFit, String> {
    let u_m: Vec<f64> = spectrum.iter().map(|ordinate| ordinate.displacement_m).collect();
    fit_ordinates(&study.strengths, &u_m, study.regression.strength_above)
}

/// Fit the ordinates `u_m`, m, over the `strengths` above `above`, or say why there is no fit.
///
/// # Errors
/// A spectrum that has no fit: why.
pub fn fit_ordinates(strengths: &[f64], u_m: &[f64], above: f64) -> Result<ExponentialFit, String> {
    let from = strengths.partition_point(|&strength| strength <= above);
    let (strengths, displacements) = (&strengths[from..], &u_m[from..]);
    if let Some(position) = displacements.iter().position(|u| u.is_infinite()) {
        return Err(format!("the spectrum is censored at strength {}", strengths[position]));
    }
    fit(strengths, displacements).map_err(|error| error.to_string())
}

/// Spectra and their coefficients as a result holds them.
pub fn stored_spectra(spectra: &Spectra, coefficients: &Coefficients) -> MeasureSpectra {
    let of = |value: fn(&Ordinate) -> f64| spectra.ordinates.map(value);
    MeasureSpectra {
        measure: spectra.measure,
        u_m: of(|ordinate| ordinate.displacement_m),
        flags: spectra.ordinates.map(|ordinate| ordinate.flag),
        lower_tail_share: of(|ordinate| ordinate.lower_tail_share),
        upper_tail_share: of(|ordinate| ordinate.upper_tail_share),
        fits: coefficients.fits.map(|fit| Fit::from_exponential(fit.as_ref().ok())),
    }
}
