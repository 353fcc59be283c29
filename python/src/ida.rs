//! Records, strengths and levels.

use std::sync::Arc;

use numpy::PyArrayDyn;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rayon::prelude::*;
use uplift_ida::{Plan, StripeRecord, System, analyse};
use uplift_motion::{Accelerogram, Combination, IntensityMeasure, RecordPair};
use uplift_plausible::GRAVITY;

use crate::cores::on_all_cores;
use crate::errors::{check_plausible, from_motion, refused};
use crate::floats::{array, count, list, room};
use crate::oscillator::Numbers;
use crate::record::Record;

/// Incremental dynamic analysis: every oscillator under every record scaled to every level (Section 4.3.1).
///
/// The solver and the numbers are those of `uplift run`, to the bit, on any number of cores. Ctrl-C stops it.
///
/// Parameters
/// ----------
/// records : sequence of Record, or of pairs of Record
///     A pair is the two horizontal components of a motion: the first shakes, and the measure is that of both. Of a
///     record alone the measure is its own.
/// strengths : array_like, shape (strengths,)
///     Uplift strengths η = f_up/(m g), 0 to 100.
/// levels : array_like, shape (levels,)
///     Levels of the measure that the records are scaled to, ascending; cm/s, g or cm, as `measure` has it.
/// measure : str, default "pgv"
///     "pgv" (cm/s), "pga" (g), "sa_1s" (g, of any period), "avgsa_0p2s_2s" (g), "pgd" (cm), "cav" (cm/s), "arias"
///     (cm/s), "si" (cm).
/// uplift_displacement_m : float, default 0.0005
///     Displacement at uplift u_up, m.
/// restitution : float, default 0.95
///     Velocity after an impact divided by the one before.
/// capacity_m : float, optional
///     Displacement at which the force has fallen to zero, m: negative stiffness after uplift, which can overturn.
/// post_uplift_stiffness_per_s2 : float, optional
///     Stiffness after uplift divided by the mass, 1/s²; not beside `capacity_m`.
/// free_vibration : bool, default True
///     Whether the motion after the end of a record counts.
/// intensity : {"geometric-mean", "rotd50", "rotd100"}, default "geometric-mean"
///     How the measures of the two components of a pair make one.
/// gravity_m_s2 : float, default 9.80665
///     Acceleration of gravity, m/s².
///
/// Returns
/// -------
/// ndarray of float64, shape (records, strengths, levels)
///     Peak displacements, m; `inf` where overturned.
///
/// Raises
/// ------
/// ValueError
///     For an empty axis, levels that do not ascend, a measure that records cannot be scaled to, numbers that no
///     oscillator has, a record that cannot be scaled.
/// TypeError
///     If `records` holds something else than records and pairs of them; if a number is none.
///
/// Examples
/// --------
/// >>> edp_m = ida([(h1, h2)], strengths=[0.1, 0.2], levels=[5, 10, 20, 40])
/// >>> edp_m.shape
/// (1, 2, 4)
#[pyfunction]
#[pyo3(signature = (
    records, strengths, levels, measure = "pgv", *, uplift_displacement_m = 0.0005, restitution = 0.95,
    capacity_m = None, post_uplift_stiffness_per_s2 = None, free_vibration = true, intensity = "geometric-mean",
    gravity_m_s2 = 9.806_65
))]
#[expect(clippy::too_many_arguments, reason = "they are Python's, by name")]
pub(crate) fn ida<'py>(
    py: Python<'py>,
    records: &Bound<'py, PyAny>,
    strengths: &Bound<'py, PyAny>,
    levels: &Bound<'py, PyAny>,
    measure: &str,
    uplift_displacement_m: f64,
    restitution: f64,
    capacity_m: Option<f64>,
    post_uplift_stiffness_per_s2: Option<f64>,
    free_vibration: bool,
    intensity: &str,
    gravity_m_s2: f64,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let measure: IntensityMeasure = measure.parse().map_err(from_motion)?;
    if !measure.can_be_scaled_to() {
        let message = format!("measure {}: no factor changes a duration, so nothing is scaled to it", measure.key());
        return Err(PyValueError::new_err(message));
    }
    check_plausible(&[(GRAVITY, "gravity_m_s2", Some(gravity_m_s2))])?;
    let intensity: Combination = intensity.parse().map_err(from_motion)?;
    let motions = motions(records)?;
    let levels = list("levels", levels)?;
    let system = |strength: f64| {
        let numbers = Numbers {
            strength,
            uplift_displacement_m,
            restitution,
            capacity_m,
            post_uplift_stiffness_per_s2,
            gravity_m_s2,
        };
        numbers.oscillator().map(System::Oscillator)
    };
    let systems = list("strengths", strengths)?.into_iter().map(system).collect::<PyResult<Vec<_>>>()?;
    let shape = [motions.len(), systems.len(), levels.len()];
    // what the analysis keeps of every run: displacement, impacts, whether it is known
    room::<[u8; 13]>(count(&shape)?)?;
    let displacement_m = on_all_cores(py, |interruption| {
        let amplitudes = motions
            .par_iter()
            .map(|motion| Ok(measure.amplitude(motion.value(measure, intensity, gravity_m_s2)?)))
            .collect::<PyResult<Vec<f64>>>()?;
        let records = motions.iter().zip(amplitudes).map(Motion::with_intensity).collect();
        let levels: Vec<f64> = levels.iter().map(|level| measure.amplitude(*level)).collect();
        let plan = Plan::stripes(records, &systems, &levels, free_vibration).map_err(refused)?;
        Ok(analyse(&plan, interruption).map_err(refused)?.displacement_m().to_vec())
    })?;
    array(py, &shape, displacement_m)
}

/// A motion: the component that shakes, and the other one where there is one.
struct Motion {
    name: String,
    shaking: Arc<Accelerogram>,
    other: Option<Arc<Accelerogram>>,
}

impl Motion {
    fn with_intensity((motion, intensity): (&Self, f64)) -> StripeRecord<'_> {
        StripeRecord { id: &motion.name, accelerogram: &motion.shaking, intensity }
    }

    fn value(&self, measure: IntensityMeasure, combination: Combination, gravity_m_s2: f64) -> PyResult<f64> {
        let Some(other) = &self.other else {
            if combination == Combination::GeometricMean {
                return Ok(measure.component_value(&self.shaking, gravity_m_s2));
            }
            let name = &self.name;
            let message = format!("record {name}: {combination} needs both components: give pairs of records");
            return Err(PyValueError::new_err(message));
        };
        let (h1, h2) = ((*self.shaking).clone(), (**other).clone());
        let pair = RecordPair { id: self.name.clone(), h1, h2, metadata: std::collections::BTreeMap::new() };
        measure.combined_value(combination, &pair, gravity_m_s2).map_err(from_motion)
    }
}

/// The motions of a sequence of records and pairs of them.
fn motions(records: &Bound<'_, PyAny>) -> PyResult<Vec<Motion>> {
    let no_motion = |item: &Bound<'_, PyAny>| {
        let kind = item.get_type().name().map_or_else(|_| "unknown".to_owned(), |name| name.to_string());
        PyTypeError::new_err(format!("records holds an item of type {kind}: give records, or pairs (h1, h2) of them"))
    };
    if records.cast::<Record>().is_ok() {
        return Err(PyTypeError::new_err("records is one record: give a list, [record]"));
    }
    if records.is_instance_of::<PyTuple>() && records.extract::<(Bound<'_, Record>, Bound<'_, Record>)>().is_ok() {
        return Err(PyTypeError::new_err(
            "records is one pair of records: give a list, [(h1, h2)]; of two records that are no pair, [h1, h2]",
        ));
    }
    let motion = |item: PyResult<Bound<'_, PyAny>>| {
        let item = item?;
        if let Ok(record) = item.cast::<Record>() {
            let record = record.get();
            return Ok(Motion { name: record.name.clone(), shaking: record.accelerogram.clone(), other: None });
        }
        let (h1, h2) = item.extract::<(Bound<'_, Record>, Bound<'_, Record>)>().map_err(|_| no_motion(&item))?;
        let (h1, h2) = (h1.get(), h2.get());
        let (shaking, other) = (h1.accelerogram.clone(), Some(h2.accelerogram.clone()));
        Ok(Motion { name: h1.name.clone(), shaking, other })
    };
    records.try_iter()?.map(motion).collect()
}
