//! The rocking frame of Chapter 6, planar and wobbling.

use std::sync::Arc;

use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_frame::{FrameEvent, GroundMotion, History, HistoryRow, Model, Moment, Options, Shaking, Until};
use uplift_motion::Accelerogram;
use uplift_plausible::{FREE_VIBRATION, RESTITUTION, SCALE};

use crate::errors::{check_plausible, refused};
use crate::floats::array;
use crate::record::Record;
use crate::structure::Structure;

/// Shakes the columns of a structure under their deck: a block, a free or restrained frame (Chapter 6).
///
/// Parameters
/// ----------
/// structure : Structure
///     Of the kind "block", "frame" or "restrained-frame".
/// h1, h2, v : Record, optional
///     Horizontal components and the vertical one, upwards positive; one horizontal component at least.
/// model : {"planar", "wobbling"}, optional
///     In a plane, under h1 or h2 alone, or in space under both; without it by the section of the columns: circular
///     ones wobble.
/// scale : float, default 1
///     Factor on all components.
/// free_vibration_s : float, default 0
///     How long the frame is followed after the shaking, s; 0: to its first peak, the last that may be the largest.
/// restitution : float, optional
///     Velocity after an impact over the one before; without it the structure's, or the balance of momentum, and 1 of a
///     wobbling frame.
/// history : bool, default False
///     Whether the motion is kept.
///
/// Returns
/// -------
/// FrameResponse
///
/// Raises
/// ------
/// ValueError
///     For a structure without columns with flat ends, columns of rectangular section that are to wobble, two
///     horizontal components in a plane, numbers that no frame or person means, a motion beyond the model.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 6.2, as corrected in docs/errata.md.
#[pyfunction]
#[pyo3(signature = (
    structure, h1 = None, h2 = None, v = None, *, model = None, scale = 1.0, free_vibration_s = 0.0,
    restitution = None, history = false
))]
#[expect(clippy::too_many_arguments, reason = "they are Python's, by name")]
pub(crate) fn respond_frame(
    py: Python<'_>,
    structure: &Bound<'_, Structure>,
    h1: Option<&Bound<'_, Record>>,
    h2: Option<&Bound<'_, Record>>,
    v: Option<&Bound<'_, Record>>,
    model: Option<&str>,
    scale: f64,
    free_vibration_s: f64,
    restitution: Option<f64>,
    history: bool,
) -> PyResult<FrameResponse> {
    check_plausible(&[
        (SCALE, "scale", Some(scale)),
        (FREE_VIBRATION, "free_vibration_s", Some(free_vibration_s)),
        (RESTITUTION, "restitution", restitution),
    ])?;
    let structure = &structure.get().read;
    let kind = structure.description.kind.name();
    let Some(frame) = structure.rocking_frame() else {
        let message = format!(
            "what is shaken is columns with flat ends, and kind \"{kind}\" has none: give a block, frame or \
             restrained-frame"
        );
        return Err(PyValueError::new_err(message));
    };
    let frame = frame.map_err(refused)?;
    let is_round = frame.shape() == uplift_frame::ColumnShape::Cylinder;
    let model = match model {
        None if is_round => Model::Wobbling,
        None | Some("planar") => Model::Planar,
        Some("wobbling") => Model::Wobbling,
        Some(other) => {
            let message = format!("model is {other:?}: it must be \"planar\" or \"wobbling\"");
            return Err(PyValueError::new_err(message));
        }
    };
    let [h1, h2, v] = [h1, h2, v].map(|record| record.map(|record| record.get().accelerogram.clone()));
    let (h1, h2) = match (model, h1, h2) {
        (_, None, None) => return Err(PyValueError::new_err("nothing shakes the frame: give h1 or h2, or both")),
        (Model::Planar, Some(_), Some(_)) => {
            return Err(PyValueError::new_err("a frame rocks in the plane of one component: give h1 or h2"));
        }
        (Model::Planar, h1, h2) => (h1.or(h2), None),
        (Model::Wobbling, h1, h2) => (h1, h2),
    };
    let options = Options {
        restitution: restitution.or(match model {
            Model::Planar => structure.description.restitution,
            Model::Wobbling => None,
        }),
        ..Options::default()
    };
    let (response, history) = py.detach(|| {
        let scaled =
            |record: Option<Arc<Accelerogram>>| record.map(|record| record.scaled(scale)).transpose().map_err(refused);
        let [x, y, z] = [scaled(h1)?, scaled(h2)?, scaled(v)?];
        let [x, y, z] = [&x, &y, &z].map(|motion| motion.as_ref().map(Shaking::Record));
        let ground = GroundMotion { x, y, z };
        let until = match free_vibration_s {
            0.0 => Until::FirstFreePeak,
            free_s => Until::Time(ground.duration_s() + free_s),
        };
        let options = Options { until, ..options };
        if history {
            let of = uplift_frame::respond_with_history(&frame, &ground, model, &options);
            of.map(|(response, history)| (response, Some(history))).map_err(refused)
        } else {
            uplift_frame::respond(&frame, &ground, model, &options).map(|of| (of, None)).map_err(refused)
        }
    })?;
    let history = history.map(|history| Py::new(py, FrameHistory::new(py, &history)?)).transpose()?;
    Ok(FrameResponse { model, response, history })
}

/// What became of a rocking frame. Of one that overturned rotation, displacements and forces of restrainers are `inf`;
/// accelerations and base shear are the largest up to then.
///
/// Attributes
/// ----------
/// overturned : bool
/// model : {"planar", "wobbling"}
/// peak_rotation_rad : float
/// peak_displacement_m, peak_displacement_x_m, peak_displacement_y_m : float
///     Largest travel of the deck, and along each component, m.
/// time_of_peak_s : float
/// peak_tendon_n, peak_spring_m : float or None
///     Largest force of a restrainer, N, and deformation of its springs, m.
/// peak_deck_acceleration_m_s2 : float
///     Largest total acceleration of the deck, m/s².
/// peak_base_shear_n, peak_base_reaction_n : float
///     Of the deck alone (Eq. 6.10), and with the inertia of the columns, N.
/// impacts, rests : int
/// events : list of (str, float)
///     What happened to the restrainers, with the time, s.
/// history : FrameHistory or None
#[pyclass(frozen, module = "uplift_urs")]
pub(crate) struct FrameResponse {
    model: Model,
    response: uplift_frame::FrameResponse,
    history: Option<Py<FrameHistory>>,
}

#[pymethods]
impl FrameResponse {
    #[getter]
    fn overturned(&self) -> bool {
        self.response.overturned
    }

    #[getter]
    fn model(&self) -> &'static str {
        match self.model {
            Model::Planar => "planar",
            Model::Wobbling => "wobbling",
        }
    }

    #[getter]
    fn peak_rotation_rad(&self) -> f64 {
        if self.response.overturned { f64::INFINITY } else { self.response.rotation.value }
    }

    #[getter]
    fn peak_displacement_m(&self) -> f64 {
        self.response.displacement.value
    }

    #[getter]
    fn peak_displacement_x_m(&self) -> f64 {
        self.response.displacement_x.value
    }

    #[getter]
    fn peak_displacement_y_m(&self) -> f64 {
        self.response.displacement_y.value
    }

    #[getter]
    fn time_of_peak_s(&self) -> f64 {
        self.response.displacement.time_s
    }

    #[getter]
    fn peak_tendon_n(&self) -> Option<f64> {
        self.response.tendon_n
    }

    #[getter]
    fn peak_spring_m(&self) -> Option<f64> {
        self.response.spring_m
    }

    #[getter]
    fn peak_deck_acceleration_m_s2(&self) -> f64 {
        self.response.deck_acceleration.value
    }

    #[getter]
    fn peak_base_shear_n(&self) -> f64 {
        self.response.base_shear_n
    }

    #[getter]
    fn peak_base_reaction_n(&self) -> f64 {
        self.response.base_reaction_n
    }

    #[getter]
    fn impacts(&self) -> u64 {
        self.response.impacts
    }

    #[getter]
    fn rests(&self) -> u64 {
        self.response.rests
    }

    #[getter]
    fn events(&self) -> Vec<(&'static str, f64)> {
        self.response.events.iter().map(|FrameEvent { event, time_s }| (event.words(), *time_s)).collect()
    }

    #[getter]
    fn history<'py>(&self, py: Python<'py>) -> Option<&Bound<'py, FrameHistory>> {
        self.history.as_ref().map(|history| history.bind(py))
    }

    fn __repr__(&self) -> String {
        let (model, peak_m) = (self.model(), self.peak_displacement_m());
        format!("<FrameResponse: {model}, peak {peak_m:.4} m, {} impacts>", self.response.impacts)
    }
}

/// The motion of a frame: a row at every sample, uplift, impact and rest.
///
/// Attributes
/// ----------
/// time_s, rotation_rad, direction_rad, displacement_x_m, displacement_y_m, rise_m : ndarray of float64
/// velocity_rad_s, turning_rad_s : ndarray of float64
/// tendon_n, spring_m : ndarray of float64
///     0 without restrainers.
/// deck_acceleration_x_m_s2, deck_acceleration_y_m_s2, deck_acceleration_z_m_s2 : ndarray of float64
///     Total acceleration of the deck, m/s²; gravity is not counted.
/// moment : list of str
///     Why the row is there: "sample", "uplift", "impact", "rest", "overturned".
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct FrameHistory {
    time_s: Py<PyArrayDyn<f64>>,
    rotation_rad: Py<PyArrayDyn<f64>>,
    direction_rad: Py<PyArrayDyn<f64>>,
    velocity_rad_s: Py<PyArrayDyn<f64>>,
    turning_rad_s: Py<PyArrayDyn<f64>>,
    displacement_x_m: Py<PyArrayDyn<f64>>,
    displacement_y_m: Py<PyArrayDyn<f64>>,
    rise_m: Py<PyArrayDyn<f64>>,
    tendon_n: Py<PyArrayDyn<f64>>,
    spring_m: Py<PyArrayDyn<f64>>,
    deck_acceleration_x_m_s2: Py<PyArrayDyn<f64>>,
    deck_acceleration_y_m_s2: Py<PyArrayDyn<f64>>,
    deck_acceleration_z_m_s2: Py<PyArrayDyn<f64>>,
    moment: Vec<&'static str>,
}

impl FrameHistory {
    fn new(py: Python<'_>, History { rows }: &History) -> PyResult<Self> {
        let of = |value: fn(&HistoryRow) -> f64| {
            PyResult::Ok(array(py, &[rows.len()], rows.iter().map(value).collect())?.unbind())
        };
        Ok(Self {
            time_s: of(|row| row.time_s)?,
            rotation_rad: of(|row| row.rotation_rad)?,
            direction_rad: of(|row| row.direction_rad)?,
            velocity_rad_s: of(|row| row.velocity_rad_s)?,
            turning_rad_s: of(|row| row.turning_rad_s)?,
            displacement_x_m: of(|row| row.displacement_x_m)?,
            displacement_y_m: of(|row| row.displacement_y_m)?,
            rise_m: of(|row| row.rise_m)?,
            tendon_n: of(|row| row.tendon_n)?,
            spring_m: of(|row| row.spring_m)?,
            deck_acceleration_x_m_s2: of(|row| row.deck_acceleration_x_m_s2)?,
            deck_acceleration_y_m_s2: of(|row| row.deck_acceleration_y_m_s2)?,
            deck_acceleration_z_m_s2: of(|row| row.deck_acceleration_z_m_s2)?,
            moment: rows.iter().map(|row| word(row.moment)).collect(),
        })
    }
}

fn word(moment: Moment) -> &'static str {
    match moment {
        Moment::Sample => "sample",
        Moment::Uplift => "uplift",
        Moment::Impact => "impact",
        Moment::Rest => "rest",
        Moment::Overturned => "overturned",
    }
}

#[pymethods]
impl FrameHistory {
    fn __len__(&self) -> usize {
        self.moment.len()
    }
}
