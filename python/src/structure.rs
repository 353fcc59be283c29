//! Rocking structures, as the files of structures describe them.

use std::path::{Path, PathBuf};

use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use uplift_statics::PushoverState;
use uplift_structure::PostUpliftForce;

use crate::errors::{from_study, refused};
use crate::floats::{array, floats, room};

/// A rocking structure, with the oscillator that it is equivalent to (Table 3.1).
///
/// Attributes
/// ----------
/// name, kind : str
/// mass_kg : float
///     Equivalent mass, kg.
/// participation : float
///     Factor Γ on the ground motion (Eq. 3.4).
/// strength : float
///     Strength η of the oscillator that is driven by Γ times the ground motion.
/// spectral_strength : float
///     Strength η/Γ at which a spectrum is read.
/// uplift_force_n : float
///     Force at uplift, N.
/// uplift_displacement_m : float
///     Displacement at uplift, m.
/// capacity_m : float
///     Displacement capacity, m; `inf` where the force does not fall after uplift.
/// post_uplift_stiffness_n_m : float
///     Stiffness after uplift, N/m.
/// gravity_m_s2 : float
///     Acceleration of gravity, m/s².
/// warnings : list of str
///     What limits the worth of the oscillator.
#[pyclass(frozen, module = "uplift_urs")]
pub(crate) struct Structure {
    pub(crate) read: uplift_study::Structure,
}

#[pymethods]
impl Structure {
    /// Reads a structure file.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     A structure file (docs/structure-file.md).
    ///
    /// Raises
    /// ------
    /// OSError
    ///     For a file that is not there or cannot be read.
    /// StudyError
    ///     A `ValueError`: for what is no structure, with all its mistakes.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        uplift_study::Structure::load(&path).map(|read| Self { read }).map_err(|error| from_study(py, &error))
    }

    /// Parses the text of a structure file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     As in a structure file.
    /// name : str, default "structure"
    ///
    /// Raises
    /// ------
    /// StudyError
    ///     A `ValueError`: for what is no structure, with all its mistakes.
    #[staticmethod]
    #[pyo3(signature = (text, *, name = "structure"))]
    fn parse(py: Python<'_>, text: String, name: &str) -> PyResult<Self> {
        let parsed = uplift_study::Structure::parse(Path::new(name), text);
        parsed.map(|read| Self { read }).map_err(|error| from_study(py, &error))
    }

    #[getter]
    fn name(&self) -> String {
        self.read.name()
    }

    #[getter]
    fn kind(&self) -> &'static str {
        self.read.description.kind.name()
    }

    #[getter]
    fn mass_kg(&self) -> f64 {
        self.read.system.mass_kg()
    }

    #[getter]
    fn participation(&self) -> f64 {
        self.read.system.participation()
    }

    #[getter]
    fn strength(&self) -> f64 {
        self.read.system.strength()
    }

    #[getter]
    fn spectral_strength(&self) -> f64 {
        self.read.system.spectral_strength()
    }

    #[getter]
    fn uplift_force_n(&self) -> f64 {
        self.read.system.uplift_force_n()
    }

    #[getter]
    fn uplift_displacement_m(&self) -> f64 {
        self.read.system.conditions().uplift_displacement_m()
    }

    #[getter]
    fn capacity_m(&self) -> f64 {
        match self.read.system.post_uplift() {
            PostUpliftForce::Negative { capacity_m } => capacity_m,
            PostUpliftForce::Zero | PostUpliftForce::Positive { .. } => f64::INFINITY,
        }
    }

    #[getter]
    fn post_uplift_stiffness_n_m(&self) -> f64 {
        self.read.system.post_uplift_stiffness_n_m()
    }

    #[getter]
    fn gravity_m_s2(&self) -> f64 {
        self.read.system.conditions().gravity_m_s2()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.read.system.warnings().iter().map(ToString::to_string).collect()
    }

    /// The oscillator that is driven by the ground motion itself; Γ times its displacement is the structure's.
    ///
    /// Returns
    /// -------
    /// dict
    ///     Arguments of `respond`: ``respond(record, **structure.oscillator())``.
    fn oscillator<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let system = &self.read.system;
        let arguments = PyDict::new(py);
        arguments.set_item("strength", system.spectral_strength())?;
        arguments.set_item("uplift_displacement_m", system.spectral_uplift_displacement_m())?;
        match system.post_uplift() {
            PostUpliftForce::Negative { capacity_m } => {
                arguments.set_item("capacity_m", capacity_m / system.participation())?;
            }
            PostUpliftForce::Zero => {}
            PostUpliftForce::Positive { stiffness_n_m } => {
                arguments.set_item("post_uplift_stiffness_per_s2", stiffness_n_m / system.mass_kg())?;
            }
        }
        arguments.set_item("gravity_m_s2", self.gravity_m_s2())?;
        Ok(arguments)
    }

    /// Restoring force of the equivalent oscillator (Eq. 3.1, 3.2).
    ///
    /// Parameters
    /// ----------
    /// displacement_m : float or array_like
    ///
    /// Returns
    /// -------
    /// ndarray of float64
    ///     Forces, N, in the shape of `displacement_m`.
    fn restoring_force_n<'py>(
        &self,
        py: Python<'py>,
        displacement_m: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let given = floats("displacement_m", displacement_m)?;
        array(py, given.shape(), given.iter().map(|u| self.read.system.restoring_force_n(*u)).collect())
    }

    /// Pushes the columns sideways: exact statics with what holds them (Eq. 5.1, 5.5 to 5.7, A2.5).
    ///
    /// Parameters
    /// ----------
    /// displacement_m : float or array_like
    ///     Travel of the deck, m.
    ///
    /// Returns
    /// -------
    /// Pushover
    ///     Arrays in the shape of `displacement_m`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a structure without columns, a displacement beyond their reach.
    fn pushover(&self, py: Python<'_>, displacement_m: &Bound<'_, PyAny>) -> PyResult<Pushover> {
        let Some(columns) = &self.read.columns else {
            let message = format!("a structure of kind \"{}\" has no columns that could be pushed", self.kind());
            return Err(PyValueError::new_err(message));
        };
        let given = floats("displacement_m", displacement_m)?;
        let mut states = room(given.len())?;
        for displacement_m in &given {
            states.push(columns.at_displacement(*displacement_m).map_err(refused)?);
        }
        Pushover::new(py, given.shape(), &states)
    }

    fn __repr__(&self) -> String {
        let (name, kind, strength, capacity_m) = (self.name(), self.kind(), self.strength(), self.capacity_m());
        format!("<Structure {name}: {kind}, strength {strength:.4}, capacity {capacity_m:.4} m>")
    }
}

/// Columns pushed sideways, at each displacement.
///
/// Attributes
/// ----------
/// displacement_m, rotation_rad, rise_m : ndarray of float64
///     Travel of the deck, rotation of the columns, rise of the deck.
/// force_n : ndarray of float64
///     Force on the deck, of all columns, N.
/// energy_j : ndarray of float64
///     Potential energy of weights and restrainers against that at rest, J.
/// tendon_n, elongation_m, spring_m : ndarray of float64
///     Force of a restrainer, its elongation, deformation of its springs; the last NaN without springs.
/// base_axial_n, base_moment_n_m : ndarray of float64
///     Of the base of a column, of a restrained one where there is one; compression positive.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Pushover {
    displacement_m: Py<PyArrayDyn<f64>>,
    rotation_rad: Py<PyArrayDyn<f64>>,
    rise_m: Py<PyArrayDyn<f64>>,
    force_n: Py<PyArrayDyn<f64>>,
    energy_j: Py<PyArrayDyn<f64>>,
    tendon_n: Py<PyArrayDyn<f64>>,
    elongation_m: Py<PyArrayDyn<f64>>,
    spring_m: Py<PyArrayDyn<f64>>,
    base_axial_n: Py<PyArrayDyn<f64>>,
    base_moment_n_m: Py<PyArrayDyn<f64>>,
}

impl Pushover {
    fn new(py: Python<'_>, shape: &[usize], states: &[PushoverState]) -> PyResult<Self> {
        let of = |value: fn(&PushoverState) -> f64| {
            PyResult::Ok(array(py, shape, states.iter().map(value).collect())?.unbind())
        };
        Ok(Self {
            displacement_m: of(|state| state.displacement_m)?,
            rotation_rad: of(|state| state.rotation_rad)?,
            rise_m: of(|state| state.rise_m)?,
            force_n: of(|state| state.force_n)?,
            energy_j: of(|state| state.energy_j)?,
            tendon_n: of(|state| state.tendon_n)?,
            elongation_m: of(|state| state.elongation_m)?,
            spring_m: of(|state| state.spring_m.unwrap_or(f64::NAN))?,
            base_axial_n: of(|state| state.sections.base_axial_n)?,
            base_moment_n_m: of(|state| state.sections.base_moment_n_m)?,
        })
    }
}

#[pymethods]
impl Pushover {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<Pushover of the shape {}>", self.force_n.bind(py).getattr("shape")?))
    }
}
