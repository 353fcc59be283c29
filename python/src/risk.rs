//! Fragility, risk curves, uniform risk spectra.

use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_fragility::{EmpiricalFragility, check_threshold};
use uplift_hazard::rate_from_probability;
use uplift_risk::{Ordinate, PooledDemand, RiskCurve, RunWeights, StripeWeights, ThresholdGrid};

use crate::demand::Demand;
use crate::errors::refused;
use crate::floats::{array, count, floats, room};
use crate::hazard::extrapolation;
use crate::sites::Sites;

/// Empirical fragility: the share of the records that exceed thresholds, level by level (Eq. 4.7).
///
/// Parameters
/// ----------
/// edp_m : array_like, shape (records, levels) or (records, strengths, levels)
///     Peak displacements, m, as `ida` returns them; `inf` where overturned.
/// levels : array_like, shape (levels,)
///     Levels of the intensity measure, ascending.
/// thresholds_m : float or array_like
///     Displacements, m, 0 or above.
///
/// Returns
/// -------
/// ndarray of float64, shape ([strengths,] *thresholds_m.shape, levels)
///     P(EDP > threshold | level).
///
/// Raises
/// ------
/// ValueError
///     For arrays that do not fit together, levels that do not ascend, displacements that are negative or NaN,
///     thresholds that are negative or not finite.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 4.3.3.
#[pyfunction]
pub(crate) fn fragility<'py>(
    py: Python<'py>,
    edp_m: &Bound<'py, PyAny>,
    levels: &Bound<'py, PyAny>,
    thresholds_m: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let demand = Demand::new(edp_m, levels)?;
    let thresholds = floats("thresholds_m", thresholds_m)?;
    let of_each: Vec<usize> = thresholds.shape().iter().copied().chain([demand.levels().len()]).collect();
    let shape = demand.shape_with(&of_each);
    let mut surface = room(count(&shape)?)?;
    let thresholds = thresholds.into_raw_vec_and_offset().0;
    py.detach(|| {
        for system in 0..demand.systems() {
            let fragility = EmpiricalFragility::new(&demand.stripes(system)?);
            surface.extend(fragility.surface(&thresholds).map_err(refused)?);
        }
        PyResult::Ok(())
    })?;
    array(py, &shape, surface)
}

/// Risk curve: the mean annual frequency of exceeding displacements, λ(c) (Eq. 4.4), both tails of the hazard included.
///
/// Parameters
/// ----------
/// edp_m : array_like, shape (records, levels) or (records, strengths, levels)
///     Peak displacements, m, as `ida` returns them.
/// levels : array_like, shape (levels,)
///     Levels of the intensity measure, ascending, in cm/s, g or cm.
/// hazard : HazardCurve, or sequence of HazardCurve
///     Hazard of the same measure at a site, or at several; in any unit, which is converted.
/// thresholds_m : float or array_like, optional
///     Displacements, m; without it the 3002 of the studies, 0 to 3 m.
/// extrapolate : {"refuse", "loglog"}, default "refuse"
///     What happens to a level outside a hazard curve.
/// gravity_m_s2 : float, default 9.80665
///     What 1 g stands for, m/s².
///
/// Returns
/// -------
/// ndarray of float64, shape ([sites,] [strengths,] *thresholds_m.shape)
///     Mean annual frequencies, 1/yr; the axis of sites where `hazard` is a sequence.
///
/// Raises
/// ------
/// ValueError
///     As `fragility`; for levels outside a hazard curve.
/// TypeError
///     If `hazard` is not a hazard curve.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 4.3.3.
#[pyfunction]
#[pyo3(signature = (
    edp_m, levels, hazard, thresholds_m = None, *, extrapolate = "refuse", gravity_m_s2 = 9.806_65
))]
pub(crate) fn risk_curve<'py>(
    py: Python<'py>,
    edp_m: &Bound<'py, PyAny>,
    levels: &Bound<'py, PyAny>,
    hazard: &Bound<'py, PyAny>,
    thresholds_m: Option<&Bound<'py, PyAny>>,
    extrapolate: &str,
    gravity_m_s2: f64,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let demand = Demand::new(edp_m, levels)?;
    let sites = Sites::new(hazard, demand.levels(), extrapolation(extrapolate)?, gravity_m_s2)?;
    let (thresholds, of_each) = match thresholds_m {
        None => {
            let usual = ThresholdGrid::default().thresholds_m().to_vec();
            let shape = vec![usual.len()];
            (usual, shape)
        }
        Some(given) => {
            let given = floats("thresholds_m", given)?;
            let shape = given.shape().to_vec();
            (given.into_raw_vec_and_offset().0, shape)
        }
    };
    let shape = sites.shape_with(&demand.shape_with(&of_each));
    let total = count(&shape)?;
    // one sweep needs the thresholds in order, from 0
    for threshold in &thresholds {
        check_threshold(*threshold).map_err(refused)?;
    }
    let mut ascending: Vec<f64> = [0.0, 1.0].into_iter().chain(thresholds.iter().map(|m| m + 0.0)).collect();
    ascending.sort_unstable_by(f64::total_cmp);
    ascending.dedup();
    let grid = ThresholdGrid::new(ascending).map_err(refused)?;
    let place = |threshold: &f64| grid.thresholds_m().partition_point(|of_grid| of_grid < threshold);
    let places: Vec<usize> = thresholds.iter().map(place).collect();
    let row = |demand: &PooledDemand, weights: &StripeWeights| {
        let of_grid = RiskCurve::new(demand, weights).map_err(refused)?.mean_annual_frequencies(&grid);
        Ok(places.iter().map(|place| of_grid[*place]).collect::<Vec<_>>())
    };
    let mut rates = room(total)?;
    for site in sites.map_each(py, &demand, row)? {
        rates.extend(site.into_iter().flatten());
    }
    array(py, &shape, rates)
}

/// Uniform risk spectra: the displacements whose annual risk is what the engineer chose (Eq. 4.4, 4.8).
///
/// Parameters
/// ----------
/// edp_m : array_like, shape (records, levels) or (records, strengths, levels)
///     Peak displacements, m, as `ida` returns them.
/// levels : array_like, shape (levels,)
///     Levels of the intensity measure, ascending, in cm/s, g or cm.
/// hazard : HazardCurve, or sequence of HazardCurve
///     Hazard of the same measure at a site, or at several; in any unit, which is converted.
/// poe : float or array_like, default (0.02, 0.10, 0.50)
///     Probabilities of exceedance in `years`.
/// years : float, default 50
///     Time that they refer to, yr.
/// contour : {"exact", "grid"}, default "exact"
///     How ordinates are read: the smallest displacement whose annual frequency meets the target, or log-linear between
///     the thresholds of the studies, 0 to 3 m.
/// weights : array_like, shape (levels, records), optional
///     Share of each record at each level, as `consistency` finds them; each level sums to 1. Without it all count
///     alike.
/// extrapolate : {"refuse", "loglog"}, default "refuse"
///     What happens to a level outside a hazard curve.
/// gravity_m_s2 : float, default 9.80665
///     What 1 g stands for, m/s².
///
/// Returns
/// -------
/// Spectra
///     Arrays of shape ([sites,] *poe.shape [, strengths]).
///
/// Raises
/// ------
/// ValueError
///     As `risk_curve`; for a probability outside 0 to 1, or a time that is not above 0.
/// TypeError
///     If `hazard` is not a hazard curve.
///
/// Examples
/// --------
/// >>> hazard = HazardCurve([1, 10, 100], [0.3, 0.01, 1e-4])
/// >>> urs(edp_m, levels, hazard, poe=0.1).u_m
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 4.3.4.
#[pyfunction]
#[pyo3(signature = (
    edp_m, levels, hazard, poe = None, years = 50.0, *, contour = "exact", weights = None, extrapolate = "refuse",
    gravity_m_s2 = 9.806_65
), text_signature = "(edp_m, levels, hazard, poe=(0.02, 0.1, 0.5), years=50.0, *, contour='exact', \
weights=None, extrapolate='refuse', gravity_m_s2=9.80665)")]
#[expect(clippy::too_many_arguments, reason = "they are Python's, by name")]
pub(crate) fn urs(
    py: Python<'_>,
    edp_m: &Bound<'_, PyAny>,
    levels: &Bound<'_, PyAny>,
    hazard: &Bound<'_, PyAny>,
    poe: Option<&Bound<'_, PyAny>>,
    years: f64,
    contour: &str,
    weights: Option<&Bound<'_, PyAny>>,
    extrapolate: &str,
    gravity_m_s2: f64,
) -> PyResult<Spectra> {
    let demand = Demand::new(edp_m, levels)?;
    let sites = Sites::new(hazard, demand.levels(), extrapolation(extrapolate)?, gravity_m_s2)?;
    let (targets, of_poe) = targets(poe, years)?;
    let grid = ThresholdGrid::default();
    let is_exact = match contour {
        "exact" => true,
        "grid" => false,
        _ => return Err(PyValueError::new_err(format!("contour is {contour:?}: it must be \"exact\" or \"grid\""))),
    };
    let shares = weights.map(|given| shares(given, &demand)).transpose()?;
    let ordinates = |demand: &PooledDemand, weights: &StripeWeights| {
        let runs = shares.as_ref().map(|shares| RunWeights::new(weights, shares)).transpose().map_err(refused)?;
        let curve = match &runs {
            Some(runs) => RiskCurve::weighted(demand, runs),
            None => RiskCurve::new(demand, weights),
        };
        let curve = curve.map_err(refused)?;
        let ordinates: Result<Vec<_>, _> = if is_exact {
            curve.exact_ordinates(&targets)
        } else {
            targets.iter().map(|target| curve.grid_ordinate(&grid, *target)).collect()
        };
        ordinates.map_err(refused)
    };
    let shape = sites.shape_with(&demand.shape_after(&of_poe));
    let mut all = room(count(&shape)?)?;
    for site in sites.map_each(py, &demand, ordinates)? {
        // strengths vary fastest in a spectrum
        all.extend((0..targets.len()).flat_map(|target| site.iter().map(move |of_strength| of_strength[target])));
    }
    Spectra::new(py, &shape, &all)
}

/// The share of each record at each level, `[level, record]`.
fn shares(given: &Bound<'_, PyAny>, demand: &Demand) -> PyResult<Vec<f64>> {
    let (given, wanted) = (floats("weights", given)?, [demand.levels().len(), demand.records()]);
    if *given.shape() != wanted {
        let message = format!("weights has the shape {:?}: it must be (levels, records), {wanted:?}", given.shape());
        return Err(PyValueError::new_err(message));
    }
    Ok(given.into_raw_vec_and_offset().0)
}

/// Target rates, 1/yr, of probabilities in `years`, and the shape in which these are given; those of the studies where
/// they are not.
pub(crate) fn targets(poe: Option<&Bound<'_, PyAny>>, years: f64) -> PyResult<(Vec<f64>, Vec<usize>)> {
    let (poe, shape) = match poe {
        None => (vec![0.02, 0.10, 0.50], vec![3]),
        Some(given) => {
            let given = floats("poe", given)?;
            let shape = given.shape().to_vec();
            (given.into_raw_vec_and_offset().0, shape)
        }
    };
    let rate = |poe: &f64| rate_from_probability(*poe, years).map_err(refused);
    Ok((poe.iter().map(rate).collect::<PyResult<_>>()?, shape))
}

/// Uniform risk spectra, in the axes site, probability and strength; without those of which there is only one thing
/// given.
///
/// Attributes
/// ----------
/// u_m : ndarray of float64
///     Displacements, m; `inf` where censored.
/// flag : ndarray of uint8
///     0 regular; 1 no exceedance, ordinate 0; 2 censored: every displacement is exceeded more often than the target.
/// lower_tail_share, upper_tail_share : ndarray of float64
///     Share of the risk from below the first and above the last level; more than 0.01 asks for further levels.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Spectra {
    u_m: Py<PyArrayDyn<f64>>,
    flag: Py<PyArrayDyn<u8>>,
    lower_tail_share: Py<PyArrayDyn<f64>>,
    upper_tail_share: Py<PyArrayDyn<f64>>,
}

impl Spectra {
    fn new(py: Python<'_>, shape: &[usize], ordinates: &[Ordinate]) -> PyResult<Self> {
        let of = |value: fn(&Ordinate) -> f64| {
            PyResult::Ok(array(py, shape, ordinates.iter().map(value).collect())?.unbind())
        };
        Ok(Self {
            u_m: of(|ordinate| ordinate.displacement_m)?,
            flag: array(py, shape, ordinates.iter().map(|ordinate| ordinate.flag.number()).collect())?.unbind(),
            lower_tail_share: of(|ordinate| ordinate.lower_tail_share)?,
            upper_tail_share: of(|ordinate| ordinate.upper_tail_share)?,
        })
    }
}

#[pymethods]
impl Spectra {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<Spectra of the shape {}>", self.u_m.bind(py).getattr("shape")?))
    }
}
