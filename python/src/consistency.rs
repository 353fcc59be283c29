//! Whether scaled records bring the site's hazard of another measure, and weights by which they do.

use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_consistency::{
    ConsistencyError, Diagnosis, Powers, RecordSet, RepairOptions, ScaledAnalysis, Seismology, SetRecord, Words,
};
use uplift_motion::IntensityMeasure;

use crate::errors::{from_motion, refused};
use crate::floats::{array, list};
use crate::hazard::{HazardCurve, extrapolation};
use crate::risk::targets;

/// Holds records against the hazard of a measure that they are not scaled to.
///
/// Parameters
/// ----------
/// scaled_to : array_like, shape (records,)
///     The measure that the records are scaled to, of each unscaled record, in cm/s, g or cm.
/// other : array_like, shape (records,)
///     The other measure, likewise.
/// levels : array_like, shape (levels,)
///     Levels that the records are scaled to, ascending.
/// hazard, other_hazard : HazardCurve
///     Hazard of the site by both measures, in any unit.
/// poe : float or array_like, default (0.02, 0.10, 0.50)
///     Probabilities of exceedance in `years`.
/// years : float, default 50
///     Time that they refer to, yr.
/// event : array_like of int, optional
///     A number for the earthquake of each record.
/// repair : bool, default False
///     Whether weights are sought by which the records bring both hazards.
/// smoothness : float, optional
///     Weight of the second differences of the exponents in the fit; without it the studies'.
/// least_effective : float, default 20
///     Fewer effective records than this at a level are a warning.
/// scale_factors : (float, float), default (0.2, 5)
///     Factors outside these are counted.
/// extrapolate : {"refuse", "loglog"}, default "refuse"
///     What happens to a level outside the curve that the records are scaled to.
/// gravity_m_s2 : float, default 9.80665
///     What 1 g stands for, m/s².
///
/// Returns
/// -------
/// Consistency
///
/// Raises
/// ------
/// ValueError
///     For arrays that do not fit together, measures that are not above 0, levels outside the curve.
///
/// Notes
/// -----
/// docs/method.md, Section 18; W. E. Deming and F. F. Stephan, Ann. Math. Statist. 11, 427–444 (1940).
#[pyfunction]
#[pyo3(signature = (
    scaled_to, other, levels, hazard, other_hazard, poe = None, years = 50.0, *, event = None, repair = false,
    smoothness = None, least_effective = 20.0, scale_factors = (0.2, 5.0), extrapolate = "refuse",
    gravity_m_s2 = 9.806_65
), text_signature = "(scaled_to, other, levels, hazard, other_hazard, poe=(0.02, 0.1, 0.5), years=50.0, *, \
event=None, repair=False, smoothness=None, least_effective=20.0, scale_factors=(0.2, 5.0), extrapolate='refuse', \
gravity_m_s2=9.80665)")]
#[expect(clippy::too_many_arguments, reason = "they are Python's, by name")]
pub(crate) fn consistency(
    py: Python<'_>,
    scaled_to: &Bound<'_, PyAny>,
    other: &Bound<'_, PyAny>,
    levels: &Bound<'_, PyAny>,
    hazard: &Bound<'_, HazardCurve>,
    other_hazard: &Bound<'_, HazardCurve>,
    poe: Option<&Bound<'_, PyAny>>,
    years: f64,
    event: Option<Vec<usize>>,
    repair: bool,
    smoothness: Option<f64>,
    least_effective: f64,
    scale_factors: (f64, f64),
    extrapolate: &str,
    gravity_m_s2: f64,
) -> PyResult<Consistency> {
    let (scaled_to, other) = (list("scaled_to", scaled_to)?, list("other", other)?);
    let levels = list("levels", levels)?;
    let events = event.map_or_else(|| vec![None; scaled_to.len()], |known| known.into_iter().map(Some).collect());
    if other.len() != scaled_to.len() || events.len() != scaled_to.len() {
        let (of_each, of_event) = (other.len(), events.len());
        let message = format!(
            "scaled_to has {} records, other {of_each} and event {of_event}: give one for each record",
            scaled_to.len()
        );
        return Err(PyValueError::new_err(message));
    }
    let (targets, of_poe) = targets(poe, years)?;
    let curve = |of: &Bound<'_, HazardCurve>| of.get().curve.in_field_units(gravity_m_s2).map_err(refused);
    let (hazard, other_hazard) = (curve(hazard)?, curve(other_hazard)?);
    let power = |of: &uplift_hazard::HazardCurve| {
        PyResult::Ok(f64::from(of.measure().parse::<IntensityMeasure>().map_err(from_motion)?.power()))
    };
    let powers = Powers { scaled_to: power(&hazard)?, other: power(&other_hazard)? };
    let record = |(pair, ((scaled_to, other), event)): (usize, ((f64, f64), Option<usize>))| SetRecord {
        scaled_to,
        other,
        pair,
        event,
        seismology: Seismology::default(),
    };
    let rows = scaled_to.into_iter().zip(other).zip(events).enumerate().map(record).collect();
    let extrapolation = extrapolation(extrapolate)?;
    let limits = [scale_factors.0, scale_factors.1];
    let usual = RepairOptions::default();
    let options = RepairOptions {
        smoothness: smoothness.unwrap_or(usual.smoothness),
        least_effective,
        scale_factor_limits: limits,
    };
    let found = py.detach(|| {
        let set = RecordSet::with_powers(rows, powers)?;
        let analysis = ScaledAnalysis::new(&set, &levels, &hazard, &other_hazard, &targets, extrapolation)?;
        let diagnosis = analysis.diagnose(None, limits)?;
        let words = Words {
            scaled_to: hazard.measure(),
            scaled_to_unit: hazard.unit(),
            other: other_hazard.measure(),
            other_unit: other_hazard.unit(),
            levels: &levels,
            has_level_sets: false,
            record: &|record| format!("{record} (from 0)"),
            event: &|event| event.to_string(),
            target: &|target| format!("target {target} (from 0)"),
        };
        let repaired = match repair.then(|| analysis.repair(&options)) {
            None => (None, None),
            Some(Ok(repaired)) => {
                let warnings = repaired.warnings.iter().map(|warning| warning.sentence(&words)).collect();
                let shares = repaired.weights.shares().to_vec();
                (Some((repaired.diagnosis, shares, repaired.fit.exponents, warnings)), None)
            }
            Some(Err(ConsistencyError::NoRepair(reason))) => (None, Some(reason.sentence(&words))),
            Some(Err(error)) => return Err(error),
        };
        Ok((diagnosis, analysis.own_shares(), repaired))
    });
    let (diagnosis, even, (repaired, no_repair)) = found.map_err(refused)?;
    let repaired = repaired
        .map(|(diagnosis, shares, exponents, warnings)| {
            let told = Told { exponents: exponents.to_vec(), warnings, ..Told::default() };
            Py::new(py, Consistency::new(py, &of_poe, &levels, &diagnosis, shares, told)?)
        })
        .transpose()?;
    Consistency::new(py, &of_poe, &levels, &diagnosis, even, Told { repaired, no_repair, ..Told::default() })
}

/// What records that count alike, or by weights, bring of the other measure.
///
/// Attributes
/// ----------
/// verdict : {"consistent", "off", "inconsistent"} or None
///     None where both hazards share too few rates.
/// bias, rms, max : float
///     exp of the mean of ln(implied/site), its root mean square, the largest without sign; NaN without a verdict.
/// rate_per_year, site_level, implied_level : ndarray of float64, shape (21,)
///     Rates at which the levels are compared; empty without a verdict.
/// ratio, times_as_often : ndarray of float64, in the shape of `poe`
///     Implied level over the site's, and how many times as often as it should the site's level is reached; NaN where
///     the curve does not reach the rate.
/// effective_records : ndarray of float64, shape (levels,)
/// weights : ndarray of float64, shape (levels, records)
///     Share of each record at each level; what `urs` takes.
/// exponents : list of float
///     Of the weights; empty of records that count alike.
/// warnings : list of str
/// repaired : Consistency or None
///     The same under weights by which the records bring both hazards.
/// no_repair : str or None
///     Why there are none, where they were sought.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Consistency {
    verdict: Option<&'static str>,
    bias: f64,
    rms: f64,
    max: f64,
    rate_per_year: Py<PyArrayDyn<f64>>,
    site_level: Py<PyArrayDyn<f64>>,
    implied_level: Py<PyArrayDyn<f64>>,
    ratio: Py<PyArrayDyn<f64>>,
    times_as_often: Py<PyArrayDyn<f64>>,
    effective_records: Py<PyArrayDyn<f64>>,
    weights: Py<PyArrayDyn<f64>>,
    exponents: Vec<f64>,
    warnings: Vec<String>,
    repaired: Option<Py<Consistency>>,
    no_repair: Option<String>,
}

/// What a repair has to say.
#[derive(Default)]
struct Told {
    exponents: Vec<f64>,
    warnings: Vec<String>,
    repaired: Option<Py<Consistency>>,
    no_repair: Option<String>,
}

impl Consistency {
    fn new(
        py: Python<'_>,
        of_poe: &[usize],
        levels: &[f64],
        diagnosis: &Diagnosis,
        shares: Vec<f64>,
        told: Told,
    ) -> PyResult<Self> {
        let deviation = diagnosis.deviation.as_ref();
        let vector = |values: Vec<f64>| PyResult::Ok(array(py, &[values.len()], values)?.unbind());
        let known = |values: Option<&[f64]>| vector(values.unwrap_or_default().to_vec());
        let of_targets = |value: fn(&uplift_consistency::TargetDiagnosis) -> Option<f64>| {
            let values = diagnosis.targets.iter().map(|target| value(target).unwrap_or(f64::NAN)).collect();
            PyResult::Ok(array(py, of_poe, values)?.unbind())
        };
        let records = shares.len().checked_div(levels.len()).unwrap_or(0);
        Ok(Self {
            verdict: diagnosis.verdict().map(uplift_consistency::Verdict::key),
            bias: deviation.map_or(f64::NAN, |deviation| deviation.bias),
            rms: deviation.map_or(f64::NAN, |deviation| deviation.rms),
            max: deviation.map_or(f64::NAN, |deviation| deviation.max),
            rate_per_year: known(deviation.map(|deviation| &deviation.rates_per_year[..]))?,
            site_level: known(deviation.map(|deviation| &deviation.site_levels[..]))?,
            implied_level: known(deviation.map(|deviation| &deviation.implied_levels[..]))?,
            ratio: of_targets(|target| target.ratio)?,
            times_as_often: of_targets(|target| target.times_as_often)?,
            effective_records: vector(diagnosis.stripes.iter().map(|stripe| stripe.effective_records).collect())?,
            weights: array(py, &[levels.len(), records], shares)?.unbind(),
            exponents: told.exponents,
            warnings: told.warnings,
            repaired: told.repaired,
            no_repair: told.no_repair,
        })
    }
}

#[pymethods]
impl Consistency {
    fn __repr__(&self) -> String {
        let Self { bias, max, .. } = self;
        format!("<Consistency: {}, bias {bias:.3}, largest deviation {max:.3}>", self.verdict.unwrap_or("no verdict"))
    }
}
