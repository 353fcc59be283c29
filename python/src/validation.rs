//! Whether computed peaks are distributed as measured ones (Section 6.8).

use pyo3::prelude::*;
use uplift_validation::{
    AndersonDarling, CramerVonMises, Evidence, KolmogorovSmirnov, MannWhitney, Pairs, Sample, wasserstein_distance,
};

use crate::errors::refused;
use crate::floats::list;

/// Compares the distributions of measured and computed peaks (Section 6.8); collapses are `inf`.
///
/// Parameters
/// ----------
/// measured, computed : array_like of one dimension
///     Values of one kind, in any number; never NaN.
///
/// Returns
/// -------
/// Validation
///
/// Raises
/// ------
/// ValueError
///     For no values, or NaN.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 6.8 and Table 6.1. `uplift validate` compares tables class by class.
#[pyfunction]
pub(crate) fn validate(
    py: Python<'_>,
    measured: &Bound<'_, PyAny>,
    computed: &Bound<'_, PyAny>,
) -> PyResult<Validation> {
    let (measured, computed) = (list("measured", measured)?, list("computed", computed)?);
    py.detach(|| {
        let pairs = (measured.len() == computed.len()).then(|| Pairs::from_peaks(&measured, &computed)).transpose();
        let pairs = pairs.map_err(refused)?;
        let (one, other) = (Sample::new(measured).map_err(refused)?, Sample::new(computed).map_err(refused)?);
        let kolmogorov_smirnov = KolmogorovSmirnov::from_samples(&one, &other);
        let (cramer_von_mises, mann_whitney) =
            (CramerVonMises::from_samples(&one, &other), MannWhitney::from_samples(&one, &other));
        Ok(Validation {
            ks_distance: kolmogorov_smirnov.distance,
            ks_p: kolmogorov_smirnov.p_exact,
            ks_p_is_exact: kolmogorov_smirnov.is_exact,
            ks_p_kstest2: kolmogorov_smirnov.p_kstest2,
            evidence: Evidence::from_p(kolmogorov_smirnov.p_exact).words(),
            anderson_darling: AndersonDarling::from_samples(&one, &other).midrank,
            cramer_von_mises: cramer_von_mises.statistic,
            cramer_von_mises_p: cramer_von_mises.p,
            mann_whitney: mann_whitney.statistic,
            mann_whitney_p: mann_whitney.p,
            wasserstein_distance: wasserstein_distance(&one, &other),
            median_ratio: other.median() / one.median(),
            log_bias: pairs.and_then(|pairs| pairs.log_bias),
            log_dispersion: pairs.and_then(|pairs| pairs.log_dispersion),
            within_2: pairs.map(|pairs| pairs.within_2),
        })
    })
}

/// Statistics of measured and computed peaks.
///
/// Attributes
/// ----------
/// ks_distance, ks_p, ks_p_kstest2 : float
///     Kolmogorov and Smirnov: the distance of the distributions, its p exact and as the dissertation has it.
/// ks_p_is_exact : bool
///     Whether that p is exact; beyond 10⁷ pairs of values it is Kolmogorov's.
/// evidence : str
///     What the exact p says against equal distributions, in the words of Table 6.1.
/// anderson_darling : float
///     With midranks for ties.
/// cramer_von_mises, cramer_von_mises_p : float
/// mann_whitney, mann_whitney_p : float
///     U of the measured values.
/// wasserstein_distance : float or None
///     None with collapses.
/// median_ratio : float
///     Computed over measured.
/// log_bias, log_dispersion : float or None
///     Mean and standard deviation of ln(computed/measured), motion by motion; None where they are not as many.
/// within_2 : float or None
///     Share of the motions whose ratio is within 2, either way.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Validation {
    ks_distance: f64,
    ks_p: f64,
    ks_p_is_exact: bool,
    ks_p_kstest2: f64,
    evidence: &'static str,
    anderson_darling: f64,
    cramer_von_mises: f64,
    cramer_von_mises_p: f64,
    mann_whitney: f64,
    mann_whitney_p: f64,
    wasserstein_distance: Option<f64>,
    median_ratio: f64,
    log_bias: Option<f64>,
    log_dispersion: Option<f64>,
    within_2: Option<f64>,
}

#[pymethods]
impl Validation {
    fn __repr__(&self) -> String {
        let Self { ks_distance, ks_p, evidence, .. } = self;
        format!("<Validation: distance {ks_distance:.4}, p {ks_p:.4}: {evidence}>")
    }
}
