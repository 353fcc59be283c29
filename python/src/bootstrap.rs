//! Confidence bands of spectra.

use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_bootstrap::{Band, Interval, Replicates, ResamplingPlan, without_each};
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};

use crate::demand::Demand;
use crate::errors::refused;
use crate::floats::{array, count, room};
use crate::hazard::extrapolation;
use crate::risk::targets;
use crate::sites::Sites;

/// Sample sizes of Section 4.5 below the whole set.
const SIZES: [u32; 4] = [20, 40, 60, 80];
/// Records drawn at most: more take minutes, and tell nothing more.
const MOST_DRAWN: u64 = 1_000_000_000;

/// Confidence bands of uniform risk spectra from resampled records (Section 4.5).
///
/// The draws and the bands are those of `uplift bootstrap`, to the bit. One draw serves all strengths, sites and
/// probabilities. Ctrl-C stops it between two strengths.
///
/// Parameters
/// ----------
/// edp_m : array_like, shape (records, levels) or (records, strengths, levels)
///     Peak displacements, m, as `ida` returns them.
/// levels : array_like, shape (levels,)
///     Levels of the intensity measure, ascending, in cm/s, g or cm.
/// hazard : HazardCurve, or sequence of HazardCurve
///     Hazard of the same measure at a site, or at several.
/// poe : float or array_like, default (0.02, 0.10, 0.50)
///     Probabilities of exceedance in `years`.
/// years : float, default 50
///     Time that they refer to, yr.
/// sizes : sequence of int, optional
///     Records in a sample; without it 20, 40, 60 and 80 as far as the set has more, and the whole set.
/// replicates : int, default 1000
///     Samples of each size.
/// confidence : float, default 0.9
///     Share of the replicates between the limits, above 0 and below 1.
/// interval : {"percentile", "bca"}, default "percentile"
///     Quantiles of the replicates, or bias-corrected and accelerated ones.
/// seed : int, default 1
///     What the draws follow from.
/// extrapolate : {"refuse", "loglog"}, default "refuse"
///     What happens to a level outside a hazard curve.
/// gravity_m_s2 : float, default 9.80665
///     What 1 g stands for, m/s².
///
/// Returns
/// -------
/// Bands
///     Arrays of shape ([sites,] *poe.shape, sizes [, strengths]).
///
/// Raises
/// ------
/// ValueError
///     As `urs`; for a size of 0, above 100 000 or given twice, no replicates, more than 1e9 records drawn.
/// TypeError
///     If `hazard` is not a hazard curve.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 4.5; B. Efron and R. J. Tibshirani, An Introduction to the Bootstrap
/// (1993).
#[pyfunction]
#[pyo3(signature = (
    edp_m, levels, hazard, poe = None, years = 50.0, *, sizes = None, replicates = 1000, confidence = 0.9,
    interval = "percentile", seed = 1, extrapolate = "refuse", gravity_m_s2 = 9.806_65
), text_signature = "(edp_m, levels, hazard, poe=(0.02, 0.1, 0.5), years=50.0, *, sizes=None, replicates=1000, \
confidence=0.9, interval='percentile', seed=1, extrapolate='refuse', gravity_m_s2=9.80665)")]
#[expect(clippy::too_many_arguments, reason = "they are Python's, by name")]
pub(crate) fn bootstrap(
    py: Python<'_>,
    edp_m: &Bound<'_, PyAny>,
    levels: &Bound<'_, PyAny>,
    hazard: &Bound<'_, PyAny>,
    poe: Option<&Bound<'_, PyAny>>,
    years: f64,
    sizes: Option<Vec<u32>>,
    replicates: u32,
    confidence: f64,
    interval: &str,
    seed: u64,
    extrapolate: &str,
    gravity_m_s2: f64,
) -> PyResult<Bands> {
    let demand = Demand::new(edp_m, levels)?;
    let sites = Sites::new(hazard, demand.levels(), extrapolation(extrapolate)?, gravity_m_s2)?;
    let (targets, of_poe) = targets(poe, years)?;
    if !(confidence > 0.0 && confidence < 1.0) {
        return Err(PyValueError::new_err(format!("confidence is {confidence}: it must be above 0 and below 1")));
    }
    let interval = Interval::ALL.into_iter().find(|choice| choice.key() == interval).ok_or_else(|| {
        PyValueError::new_err(format!("interval is {interval:?}: it must be \"percentile\" or \"bca\""))
    })?;
    let sizes = sizes.unwrap_or_else(|| {
        let all = u32::try_from(demand.records()).unwrap_or(u32::MAX);
        SIZES.into_iter().filter(|size| *size < all).chain([all]).collect()
    });
    let drawn = sizes.iter().map(|size| u64::from(*size)).sum::<u64>().saturating_mul(u64::from(replicates));
    if drawn > MOST_DRAWN {
        let message = format!("{replicates} replicates of these sizes draw {drawn} records: at most {MOST_DRAWN:e}");
        return Err(PyValueError::new_err(message));
    }
    let of_each: Vec<usize> = of_poe.iter().copied().chain([sizes.len()]).collect();
    let shape = sites.shape_with(&demand.shape_after(&of_each));
    let mut bands = room(count(&shape)?)?;
    // the plan keeps how often each record is drawn
    let per_size = usize::try_from(replicates).unwrap_or(usize::MAX);
    room::<u32>(count(&[sizes.len(), per_size, demand.records()])?)?;
    let plan = py.detach(|| ResamplingPlan::draw(demand.records(), &sizes, per_size, seed)).map_err(refused)?;
    let left_out = interval.left_out(&plan).map_err(refused)?;
    let of_both = |demand: &PooledDemand, weights: &StripeWeights| {
        let replicates = Replicates::from_plan(demand, &[weights], &targets, &plan).map_err(refused)?;
        let estimates = RiskCurve::new(demand, weights).and_then(|curve| curve.exact_ordinates(&targets));
        let without_each = without_each(demand, weights, &targets, &left_out).map_err(refused)?;
        let mut bands = Vec::with_capacity(targets.len() * sizes.len());
        for (target, estimate) in estimates.map_err(refused)?.iter().enumerate() {
            for (index, size) in sizes.iter().enumerate() {
                let ordinates_m = replicates.ordinates_m(0, target, index);
                let of_sample = (without_each[target].as_slice(), *size);
                bands.push(interval.band(ordinates_m, confidence, estimate.displacement_m, of_sample));
            }
        }
        Ok(bands)
    };
    for site in sites.map_each(py, &demand, of_both)? {
        // strengths vary fastest
        bands.extend((0..targets.len() * sizes.len()).flat_map(|place| site.iter().map(move |of| of[place])));
    }
    Bands::new(py, &shape, sizes, &bands)
}

/// Confidence bands of spectra, in the axes site, probability, sample size and strength; without those of which there
/// is only one thing given, but for the sample sizes.
///
/// Attributes
/// ----------
/// lower_m, median_m, upper_m : ndarray of float64
///     Limits and median of the replicates, m; a limit is NaN where a BCa band does not exist.
/// sample_size : list of int
///     Records in a sample, the axis of sizes.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Bands {
    lower_m: Py<PyArrayDyn<f64>>,
    median_m: Py<PyArrayDyn<f64>>,
    upper_m: Py<PyArrayDyn<f64>>,
    sample_size: Vec<u32>,
}

impl Bands {
    fn new(py: Python<'_>, shape: &[usize], sample_size: Vec<u32>, bands: &[Band]) -> PyResult<Self> {
        let of = |value: fn(&Band) -> f64| PyResult::Ok(array(py, shape, bands.iter().map(value).collect())?.unbind());
        Ok(Self {
            lower_m: of(|band| band.lower_m)?,
            median_m: of(|band| band.median_m)?,
            upper_m: of(|band| band.upper_m)?,
            sample_size,
        })
    }
}

#[pymethods]
impl Bands {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<Bands of the shape {}>", self.median_m.bind(py).getattr("shape")?))
    }
}
