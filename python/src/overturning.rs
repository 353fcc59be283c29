//! How often a structure overturns, from the peaks of its analyses.

use numpy::PyArrayDyn;
use pyo3::prelude::*;
use uplift_fragility::{StripeCount, fit_lognormal, stripe_counts};
use uplift_hazard::probability_from_rate;
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};

use crate::demand::Demand;
use crate::errors::refused;
use crate::floats::{array, count, room};
use crate::hazard::extrapolation;
use crate::sites::Sites;

/// A threshold that nothing but overturning exceeds.
const OVERTURNING_M: f64 = f64::MAX;

/// Overturning: counts and fragility by strength, frequencies by site and strength; without the axes of which there is
/// only one thing given.
///
/// Attributes
/// ----------
/// overturned : ndarray of float64, shape ([strengths,] levels)
///     Share of the records that overturn at each level.
/// median, dispersion : ndarray of float64, shape ([strengths])
///     The lognormal fragility of maximum likelihood: median in the unit of the levels; NaN where the counts have none.
/// maf_per_year : ndarray of float64, shape ([sites,] [strengths])
///     Mean annual frequency of overturning, 1/yr (Eq. 4.4), from the counts.
/// probability : ndarray of float64
///     Probability that it happens in `years`, in the same shape.
/// upper_tail_share : ndarray of float64
///     Share of the frequency from above the last level, in the same shape.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Overturning {
    overturned: Py<PyArrayDyn<f64>>,
    median: Py<PyArrayDyn<f64>>,
    dispersion: Py<PyArrayDyn<f64>>,
    maf_per_year: Py<PyArrayDyn<f64>>,
    probability: Py<PyArrayDyn<f64>>,
    upper_tail_share: Py<PyArrayDyn<f64>>,
}

#[pymethods]
impl Overturning {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<Overturning: {} per year>", self.maf_per_year.bind(py).str()?))
    }
}

/// How often what was analysed overturns, and at which intensity.
///
/// Parameters
/// ----------
/// edp_m : array_like, shape (records, levels) or (records, strengths, levels)
///     Peak displacements, m, as `ida` returns them for oscillators with a `capacity_m`; `inf` where overturned.
/// levels : array_like, shape (levels,)
///     Levels of the intensity measure, ascending, in cm/s, g or cm.
/// hazard : HazardCurve, or sequence of HazardCurve
///     Hazard of the same measure at a site, or at several.
/// years : float, default 50
///     Time of the probabilities, yr.
/// extrapolate : {"refuse", "loglog"}, default "refuse"
///     What happens to a level outside a hazard curve.
/// gravity_m_s2 : float, default 9.80665
///     What 1 g stands for, m/s².
///
/// Returns
/// -------
/// Overturning
///
/// Raises
/// ------
/// ValueError
///     As `risk_curve`; for a time that is not above 0.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 2.4.3; J. W. Baker, Earthquake Spectra 31 (2015), for the fit.
#[pyfunction]
#[pyo3(signature = (edp_m, levels, hazard, years = 50.0, *, extrapolate = "refuse", gravity_m_s2 = 9.806_65))]
pub(crate) fn overturning(
    py: Python<'_>,
    edp_m: &Bound<'_, PyAny>,
    levels: &Bound<'_, PyAny>,
    hazard: &Bound<'_, PyAny>,
    years: f64,
    extrapolate: &str,
    gravity_m_s2: f64,
) -> PyResult<Overturning> {
    let demand = Demand::new(edp_m, levels)?;
    let sites = Sites::new(hazard, demand.levels(), extrapolation(extrapolate)?, gravity_m_s2)?;
    let of_levels = demand.shape_with(&[demand.levels().len()]);
    let (mut overturned, mut medians, mut dispersions) = (room(count(&of_levels)?)?, Vec::new(), Vec::new());
    for system in 0..demand.systems() {
        let counts = stripe_counts(&demand.stripes(system)?, OVERTURNING_M).map_err(refused)?;
        let share = |count: &StripeCount| f64::from(count.exceedances) / f64::from(count.trials);
        overturned.extend(counts.iter().map(share));
        let fit = fit_lognormal(&counts).ok().map(|fit| fit.fragility);
        medians.push(fit.map_or(f64::NAN, |fragility| fragility.median()));
        dispersions.push(fit.map_or(f64::NAN, |fragility| fragility.dispersion()));
    }
    let risk = |demand: &PooledDemand, weights: &StripeWeights| {
        let curve = RiskCurve::new(demand, weights).map_err(refused)?;
        let per_year = curve.mean_annual_frequency(OVERTURNING_M).map_err(refused)?;
        let upper_per_year = curve.disaggregation(OVERTURNING_M).map_err(refused)?.upper_tail_per_year;
        let upper_share = if per_year > 0.0 { (upper_per_year / per_year).min(1.0) } else { 0.0 };
        Ok(vec![per_year, probability_from_rate(per_year, years).map_err(refused)?, upper_share])
    };
    let of_each: Vec<Vec<f64>> = sites.map_each(py, &demand, risk)?.into_iter().flatten().collect();
    let shape = sites.shape_with(&demand.shape_with(&[]));
    let of = |place: usize| PyResult::Ok(array(py, &shape, of_each.iter().map(|of| of[place]).collect())?.unbind());
    Ok(Overturning {
        overturned: array(py, &of_levels, overturned)?.unbind(),
        median: array(py, &demand.shape_with(&[]), medians)?.unbind(),
        dispersion: array(py, &demand.shape_with(&[]), dispersions)?.unbind(),
        maf_per_year: of(0)?,
        probability: of(1)?,
        upper_tail_share: of(2)?,
    })
}
