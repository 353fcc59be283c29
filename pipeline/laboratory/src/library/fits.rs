//! Fits of the shares that rock and overturn, with what they miss of the counted shares.

use serde::Serialize;
use uplift_fragility::{
    FragilityError, Goodness, Stripes, SurfaceTrial, fit_lognormal, fit_surface, lognormal_spread, stripe_counts,
};

use crate::error::LaboratoryError;

/// Every finite displacement is below it.
pub(super) const OVERTURNING_M: f64 = f64::MAX;

/// The lognormal function of an event over a normalised intensity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitReport {
    /// `rocking` or `overturning`.
    pub of: &'static str,
    /// Median intensity; none where there is no fit.
    pub median: Option<f64>,
    /// Standard deviation of the logarithm of the intensity.
    pub dispersion: Option<f64>,
    /// Standard error of the logarithm of the median, by the jackknife over earthquakes; none where the fit fails
    /// without one of them.
    pub log_median_standard_error: Option<f64>,
    /// Standard error of the dispersion.
    pub dispersion_standard_error: Option<f64>,
    /// Largest difference from the counted share at any level.
    pub largest_error: Option<f64>,
    /// Why there is no fit; empty where there is.
    pub problem: String,
}

impl FitReport {
    /// Fits the exceedance of `threshold_m`.
    pub(super) fn fit(
        of: &'static str,
        stripes: &Stripes<'_>,
        threshold_m: f64,
        units: &[Vec<usize>],
    ) -> Result<Self, LaboratoryError> {
        let counts = stripe_counts(stripes, threshold_m)?;
        let fit = fit_lognormal(&counts);
        let fragility = fit.as_ref().ok().map(|fit| fit.fragility);
        let spread = fragility.and_then(|_| lognormal_spread(stripes, threshold_m, units).ok());
        Ok(Self {
            of,
            median: fragility.map(|own| own.median()),
            dispersion: fragility.map(|own| own.dispersion()),
            log_median_standard_error: spread.map(|spread| spread.log_median),
            dispersion_standard_error: spread.map(|spread| spread.dispersion),
            largest_error: fragility
                .map(|own| Goodness::from_counts(&counts, |level| own.probability(level)).largest_error),
            problem: problem(fit),
        })
    }
}

/// P(overturning) = Φ(a + b ln x + c ln y) over x = PGA/(g tan α) and y = p PGV/(g tan α).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SurfaceReport {
    /// a, b and c; none where there is no fit.
    pub coefficients: Option<[f64; 3]>,
    /// Their standard errors, robust against dependence within an earthquake.
    pub standard_errors: Option<[f64; 3]>,
    /// Largest difference between predicted and counted share in any tenth of the analyses.
    pub largest_error: Option<f64>,
    /// Why there is no fit; empty where there is.
    pub problem: String,
}

impl SurfaceReport {
    pub(super) fn fit(trials: &[SurfaceTrial]) -> Self {
        let fit = fit_surface(trials);
        let own = fit.as_ref().ok();
        Self {
            coefficients: own.map(|fit| fit.surface.coefficients),
            standard_errors: own.map(|fit| fit.standard_errors),
            largest_error: own.map(|fit| fit.largest_error),
            problem: problem(fit),
        }
    }
}

fn problem<T>(fit: Result<T, FragilityError>) -> String {
    fit.err().map_or_else(String::new, |error| error.to_string())
}
