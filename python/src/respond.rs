//! One record through any number of oscillators.

use std::sync::Arc;

use numpy::ndarray::{ArrayD, IxDyn};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use rayon::prelude::*;
use uplift_ida::{IdaError, System, Watch};
use uplift_motion::Accelerogram;
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, respond as follow, respond_with_history};
use uplift_plausible::{FREE_VIBRATION, SCALE};

use crate::cores::on_all_cores;
use crate::errors::{check_plausible, refused};
use crate::floats::{count, floats, room};
use crate::oscillator::Numbers;
use crate::record::Record;
use crate::response::{History, Response, Responses};

/// Shakes oscillators that uplift with one record (Eq. 4.1 to 4.3), exactly, from event to event.
///
/// `strength`, `uplift_displacement_m`, `restitution`, `capacity_m`, `post_uplift_stiffness_per_s2` and `scale` may be
/// arrays, which are broadcast against each other by numpy's rules; all cores work on them, and Ctrl-C stops them. The
/// solver is that of `uplift response`, the same numbers to the bit; `ida` has a faster one for many scales, which
/// differs from it by rounding.
///
/// Parameters
/// ----------
/// record : Record
///     What shakes.
/// strength : float or array_like
///     Uplift strength η = f_up/(m g), 0 to 100.
/// uplift_displacement_m : float or array_like, default 0.0005
///     Displacement at uplift u_up, m.
/// restitution : float or array_like, default 0.95
///     Velocity after an impact divided by the one before, 0 to 1.
/// capacity_m : float or array_like, optional
///     Displacement at which the force has fallen to zero, m: negative stiffness after uplift, which can overturn.
/// post_uplift_stiffness_per_s2 : float or array_like, optional
///     Stiffness after uplift divided by the mass, 1/s²; not beside `capacity_m`.
/// scale : float or array_like, default 1
///     Factor on the record; a negative one reverses its sign.
/// free_vibration : bool, default True
///     Whether the first peak after the end of the record counts, as in studies.
/// free_vibration_s : float, optional
///     Follow the motion for so many seconds after the record instead; 0 to end with it, as `uplift response` does.
/// gravity_m_s2 : float, default 9.80665
///     Acceleration of gravity, m/s².
/// history : bool, default False
///     Keep the motion at every sample; for one oscillator and scale.
///
/// Returns
/// -------
/// Response
///     Where all arguments are scalars.
/// Responses
///     Else: arrays of the shape to which the arguments are broadcast.
///
/// Raises
/// ------
/// ValueError
///     For numbers that no oscillator has, all of one oscillator at once; for shapes that do not broadcast; for runs of
///     more than ten million steps.
/// TypeError
///     If an argument is not a number.
/// MemoryError
///     For more runs than fit the memory.
///
/// Examples
/// --------
/// >>> respond(record, strength=0.2, scale=1.5).peak_displacement_m
/// >>> respond(record, strength=[[0.1], [0.2]], scale=[0.5, 1, 2]).peak_displacement_m.shape
/// (2, 3)
///
/// Notes
/// -----
/// N. Reggiani Manzo, Seismic behavior of rocking bridges exhibiting negative stiffness, Sections 3.2 and 4.2.
#[pyfunction]
#[pyo3(signature = (
    record, strength, *, uplift_displacement_m = None, restitution = None, capacity_m = None,
    post_uplift_stiffness_per_s2 = None, scale = None, free_vibration = true, free_vibration_s = None,
    gravity_m_s2 = 9.806_65, history = false
), text_signature = "(record, strength, *, uplift_displacement_m=0.0005, restitution=0.95, capacity_m=None, \
post_uplift_stiffness_per_s2=None, scale=1.0, free_vibration=True, free_vibration_s=None, gravity_m_s2=9.80665, \
history=False)")]
#[expect(clippy::too_many_arguments, reason = "they are Python's, by name")]
pub(crate) fn respond(
    py: Python<'_>,
    record: &Bound<'_, Record>,
    strength: &Bound<'_, PyAny>,
    uplift_displacement_m: Option<&Bound<'_, PyAny>>,
    restitution: Option<&Bound<'_, PyAny>>,
    capacity_m: Option<&Bound<'_, PyAny>>,
    post_uplift_stiffness_per_s2: Option<&Bound<'_, PyAny>>,
    scale: Option<&Bound<'_, PyAny>>,
    free_vibration: bool,
    free_vibration_s: Option<f64>,
    gravity_m_s2: f64,
    history: bool,
) -> PyResult<Py<PyAny>> {
    let record = record.get();
    let or = |name, given: Option<&Bound<'_, PyAny>>, usual| match given {
        Some(given) => floats(name, given),
        None => Ok(ArrayD::from_elem(IxDyn(&[]), usual)),
    };
    let given = Given {
        strength: floats("strength", strength)?,
        uplift_displacement_m: or("uplift_displacement_m", uplift_displacement_m, 0.0005)?,
        restitution: or("restitution", restitution, 0.95)?,
        capacity_m: capacity_m.map(|given| floats("capacity_m", given)).transpose()?,
        post_uplift_stiffness_per_s2: post_uplift_stiffness_per_s2
            .map(|given| floats("post_uplift_stiffness_per_s2", given))
            .transpose()?,
        scale: or("scale", scale, 1.0)?,
        gravity_m_s2,
    };
    check_plausible(&[(FREE_VIBRATION, "free_vibration_s", free_vibration_s)])?;
    let free_vibration = match free_vibration_s {
        Some(0.0) => FreeVibration::None,
        Some(seconds) => FreeVibration::Seconds(seconds),
        None if free_vibration => FreeVibration::FirstPeak,
        None => FreeVibration::None,
    };
    let shaken = Shaken { record: record.name.clone(), motion: record.accelerogram.clone(), free_vibration };
    let shape = given.shape(py)?;
    if shape.is_empty() {
        let case = given.only(&shaken)?;
        let (run, history) = py.detach(|| shaken.run(&case, history))?;
        let history = history.map(|history| Py::new(py, History::new(py, &history))).transpose()?;
        return Ok(Py::new(py, Response::new(&run, history))?.into_any());
    }
    if history {
        return Err(PyValueError::new_err("history=True keeps the motion of one run: give scalars, not arrays"));
    }
    let cases = given.cases(&shape, &shaken)?;
    let runs = on_all_cores(py, |interruption| {
        let run = |case: &Case| {
            if interruption.cancelled() {
                return Err(PyKeyboardInterrupt::new_err(()));
            }
            Ok(shaken.run(case, false)?.0)
        };
        cases.par_iter().map(run).collect::<PyResult<Vec<_>>>()
    })?;
    Ok(Py::new(py, Responses::new(py, &shape, &runs)?)?.into_any())
}

/// What is given of the oscillators and the scale.
struct Given {
    strength: ArrayD<f64>,
    uplift_displacement_m: ArrayD<f64>,
    restitution: ArrayD<f64>,
    capacity_m: Option<ArrayD<f64>>,
    post_uplift_stiffness_per_s2: Option<ArrayD<f64>>,
    scale: ArrayD<f64>,
    gravity_m_s2: f64,
}

impl Given {
    fn arrays(&self) -> impl Iterator<Item = &ArrayD<f64>> {
        let always = [&self.strength, &self.uplift_displacement_m, &self.restitution, &self.scale];
        always.into_iter().chain(&self.capacity_m).chain(&self.post_uplift_stiffness_per_s2)
    }

    /// The shape to which everything is broadcast; empty where all are scalars.
    fn shape(&self, py: Python<'_>) -> PyResult<Vec<usize>> {
        let mut shapes = self.arrays().map(ArrayD::shape).filter(|shape| !shape.is_empty());
        match (shapes.next(), shapes.next()) {
            (None, _) => Ok(Vec::new()),
            (Some(only), None) => Ok(only.to_vec()),
            _ => {
                let shapes = self.arrays().map(|array| pyo3::types::PyTuple::new(py, array.shape()));
                let shapes = pyo3::types::PyTuple::new(py, shapes.collect::<PyResult<Vec<_>>>()?)?;
                PyModule::import(py, "numpy")?.getattr("broadcast_shapes")?.call1(shapes)?.extract()
            }
        }
    }

    /// The one oscillator where all are scalars.
    fn only(&self, shaken: &Shaken) -> PyResult<Case> {
        let first = |array: &ArrayD<f64>| array.first().copied().unwrap_or(f64::NAN);
        let numbers = Numbers {
            strength: first(&self.strength),
            uplift_displacement_m: first(&self.uplift_displacement_m),
            restitution: first(&self.restitution),
            capacity_m: self.capacity_m.as_ref().map(first),
            post_uplift_stiffness_per_s2: self.post_uplift_stiffness_per_s2.as_ref().map(first),
            gravity_m_s2: self.gravity_m_s2,
        };
        shaken.case(&numbers, first(&self.scale))
    }

    /// Every oscillator with its scale, in C order.
    fn cases(&self, shape: &[usize], shaken: &Shaken) -> PyResult<Vec<Case>> {
        let spread = |array| spread(array, shape);
        let mut uplift_displacement_m = spread(&self.uplift_displacement_m)?;
        let mut restitution = spread(&self.restitution)?;
        let mut capacity_m = self.capacity_m.as_ref().map(spread).transpose()?;
        let mut post_uplift_stiffness_per_s2 = self.post_uplift_stiffness_per_s2.as_ref().map(spread).transpose()?;
        let mut cases = room(count(shape)?)?;
        for (strength, scale) in spread(&self.strength)?.zip(spread(&self.scale)?) {
            let numbers = Numbers {
                strength,
                uplift_displacement_m: next(&mut uplift_displacement_m),
                restitution: next(&mut restitution),
                capacity_m: capacity_m.as_mut().map(next),
                post_uplift_stiffness_per_s2: post_uplift_stiffness_per_s2.as_mut().map(next),
                gravity_m_s2: self.gravity_m_s2,
            };
            cases.push(shaken.case(&numbers, scale)?);
        }
        Ok(cases)
    }
}

/// The values of an array that is broadcast to a shape, in C order.
fn spread(array: &ArrayD<f64>, shape: &[usize]) -> PyResult<impl Iterator<Item = f64>> {
    let view = array.broadcast(shape).ok_or_else(|| {
        PyValueError::new_err(format!("the shape {:?} cannot be broadcast to {shape:?}", array.shape()))
    })?;
    Ok(view.into_iter().copied())
}

/// The next of as many values as all others have.
fn next(values: &mut impl Iterator<Item = f64>) -> f64 {
    values.next().unwrap_or(f64::NAN)
}

/// An oscillator and a scale, checked.
struct Case {
    oscillator: Oscillator,
    scale: f64,
}

/// What shakes, and what happens after it.
struct Shaken {
    record: String,
    motion: Arc<Accelerogram>,
    free_vibration: FreeVibration,
}

impl Shaken {
    fn case(&self, numbers: &Numbers, scale: f64) -> PyResult<Case> {
        check_plausible(&[(SCALE, "scale", Some(scale))])?;
        let oscillator = numbers.oscillator()?;
        let free_s = if let FreeVibration::Seconds(seconds) = self.free_vibration { seconds } else { 0.0 };
        oscillator.check_run_length(self.motion.duration_s() + free_s, self.motion.dt_s()).map_err(refused)?;
        Ok(Case { oscillator, scale })
    }

    fn run(
        &self,
        Case { oscillator, scale }: &Case,
        history: bool,
    ) -> PyResult<(uplift_oscillator::Response, Option<uplift_oscillator::History>)> {
        let excitation = Excitation::new(self.motion.dt_s(), self.motion.acceleration_m_s2())
            .and_then(|excitation| excitation.scaled(*scale))
            .map_err(refused)?;
        let (run, history) = if history {
            let (run, history) = respond_with_history(oscillator, &excitation, self.free_vibration);
            (run, Some(history))
        } else {
            (follow(oscillator, &excitation, self.free_vibration), None)
        };
        if run.overturned || run.peak_displacement_m.is_finite() {
            return Ok((run, history));
        }
        Err(refused(IdaError::NotFinite {
            motion: self.record.clone(),
            scale: *scale,
            system: System::Oscillator(oscillator.clone()).to_string(),
            displacement_m: run.peak_displacement_m,
        }))
    }
}
