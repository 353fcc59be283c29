//! What a run, or an array of runs, returns.

use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;
use uplift_oscillator as solver;

use crate::floats::array;

/// The response of one oscillator to one record.
///
/// Attributes
/// ----------
/// peak_displacement_m : float
///     Largest absolute displacement relative to the ground, m; `inf` where the oscillator overturned.
/// time_of_peak_s : float
///     When, s from the start of the record; of the overturning where it overturned.
/// impacts, uplifts : int
///     Times that the displacement came down to the uplift displacement, and rose above it.
/// overturned : bool
///     Whether an oscillator of negative stiffness can no longer return.
/// end_displacement_m, end_velocity_m_s : float
///     The motion at the end of the run: of the record, where only the first free peak counts.
/// history : History or None
///     The motion at every sample, where `history=True`.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Response {
    peak_displacement_m: f64,
    time_of_peak_s: f64,
    impacts: u32,
    uplifts: u32,
    overturned: bool,
    end_displacement_m: f64,
    end_velocity_m_s: f64,
    history: Option<Py<History>>,
}

impl Response {
    pub(crate) fn new(run: &solver::Response, history: Option<Py<History>>) -> Self {
        Self {
            peak_displacement_m: run.peak_displacement_m,
            time_of_peak_s: run.time_of_peak_s,
            impacts: run.impacts,
            uplifts: run.uplifts,
            overturned: run.overturned,
            end_displacement_m: run.end_displacement_m,
            end_velocity_m_s: run.end_velocity_m_s,
            history,
        }
    }
}

#[pymethods]
impl Response {
    /// "no uplift", "uplifted" or "overturned".
    #[getter]
    fn status(&self) -> &'static str {
        status(self.overturned, self.uplifts)
    }

    fn __repr__(&self) -> String {
        let Self { peak_displacement_m, impacts, .. } = self;
        format!("<Response: {}, peak {peak_displacement_m} m, {impacts} impacts>", self.status())
    }
}

fn status(overturned: bool, uplifts: u32) -> &'static str {
    match (overturned, uplifts) {
        (true, _) => "overturned",
        (false, 0) => "no uplift",
        (false, _) => "uplifted",
    }
}

/// The responses of many oscillators, or of one at many scales, to one record: arrays of the shape of the arguments.
///
/// Attributes
/// ----------
/// peak_displacement_m, time_of_peak_s, end_displacement_m, end_velocity_m_s : ndarray of float64
/// impacts, uplifts : ndarray of uint32
/// overturned : ndarray of bool
///     As the attributes of `Response`, in the shape to which the arguments are broadcast.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Responses {
    peak_displacement_m: Py<PyArrayDyn<f64>>,
    time_of_peak_s: Py<PyArrayDyn<f64>>,
    impacts: Py<PyArrayDyn<u32>>,
    uplifts: Py<PyArrayDyn<u32>>,
    overturned: Py<PyArrayDyn<bool>>,
    end_displacement_m: Py<PyArrayDyn<f64>>,
    end_velocity_m_s: Py<PyArrayDyn<f64>>,
}

impl Responses {
    pub(crate) fn new(py: Python<'_>, shape: &[usize], runs: &[solver::Response]) -> PyResult<Self> {
        Ok(Self {
            peak_displacement_m: array_over_runs(py, shape, runs, |run| run.peak_displacement_m)?,
            time_of_peak_s: array_over_runs(py, shape, runs, |run| run.time_of_peak_s)?,
            impacts: array_over_runs(py, shape, runs, |run| run.impacts)?,
            uplifts: array_over_runs(py, shape, runs, |run| run.uplifts)?,
            overturned: array_over_runs(py, shape, runs, |run| run.overturned)?,
            end_displacement_m: array_over_runs(py, shape, runs, |run| run.end_displacement_m)?,
            end_velocity_m_s: array_over_runs(py, shape, runs, |run| run.end_velocity_m_s)?,
        })
    }
}

fn array_over_runs<T: numpy::Element>(
    py: Python<'_>,
    shape: &[usize],
    runs: &[solver::Response],
    value: impl Fn(&solver::Response) -> T,
) -> PyResult<Py<PyArrayDyn<T>>> {
    Ok(array(py, shape, runs.iter().map(value).collect())?.unbind())
}

#[pymethods]
impl Responses {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<Responses of the shape {}>", self.overturned.bind(py).getattr("shape")?))
    }
}

/// The motion of one run.
///
/// Attributes
/// ----------
/// time_s, displacement_m, velocity_m_s : ndarray of float64, shape (samples,)
///     At every sample of the record, and of the free vibration where `free_vibration_s` asks for it: time from the
///     start of the record, displacement and velocity relative to the ground.
/// event_time_s, event_displacement_m, event_velocity_before_m_s, event_velocity_after_m_s : ndarray, shape (events,)
///     Every uplift and impact, in time order.
/// event_is_impact : ndarray of bool, shape (events,)
///     Whether it is an impact; else an uplift.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct History {
    time_s: Py<PyArray1<f64>>,
    displacement_m: Py<PyArray1<f64>>,
    velocity_m_s: Py<PyArray1<f64>>,
    event_time_s: Py<PyArray1<f64>>,
    event_displacement_m: Py<PyArray1<f64>>,
    event_velocity_before_m_s: Py<PyArray1<f64>>,
    event_velocity_after_m_s: Py<PyArray1<f64>>,
    event_is_impact: Py<PyArray1<bool>>,
}

impl History {
    pub(crate) fn new(py: Python<'_>, history: &solver::History) -> Self {
        let samples =
            |value: fn(&solver::Sample) -> f64| PyArray1::from_iter(py, history.samples.iter().map(value)).unbind();
        let events =
            |value: fn(&solver::Event) -> f64| PyArray1::from_iter(py, history.events.iter().map(value)).unbind();
        let is_impact = history.events.iter().map(|event| event.kind == solver::EventKind::Impact);
        Self {
            time_s: samples(|sample| sample.time_s),
            displacement_m: samples(|sample| sample.displacement_m),
            velocity_m_s: samples(|sample| sample.velocity_m_s),
            event_time_s: events(|event| event.time_s),
            event_displacement_m: events(|event| event.displacement_m),
            event_velocity_before_m_s: events(|event| event.velocity_before_m_s),
            event_velocity_after_m_s: events(|event| event.velocity_after_m_s),
            event_is_impact: PyArray1::from_iter(py, is_impact).unbind(),
        }
    }
}
