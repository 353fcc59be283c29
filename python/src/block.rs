//! The rigid rocking block of Chapter 2.

use std::sync::Arc;

use numpy::PyArrayDyn;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use rayon::prelude::*;
use uplift_block::{BlockResponse, FreeRocking, RockingBlock};
use uplift_ida::Watch;
use uplift_motion::Accelerogram;
use uplift_plausible::{FREE_VIBRATION, GRAVITY, LENGTH, RESTITUTION, SCALE, SIZE};

use crate::cores::on_all_cores;
use crate::errors::{check_plausible, refused};
use crate::floats::{array, floats};
use crate::record::Record;

/// A rigid rocking block: width and height, or a slenderness and one length.
///
/// Parameters
/// ----------
/// width_m, height_m : float, optional
///     Width 2b and height 2h, m.
/// size_m : float, optional
///     Half the diagonal R, m.
/// slenderness_rad : float, optional
///     α = atan(b/h), rad.
/// restitution : float, optional
///     Angular velocity after an impact over the one before; without it Housner's (Eq. 2.3).
/// gravity_m_s2 : float, default 9.80665
///     Acceleration of gravity, m/s².
///
/// Raises
/// ------
/// ValueError
///     For numbers that make no block.
#[pyclass(frozen, module = "uplift_urs")]
pub(crate) struct Block(RockingBlock);

#[pymethods]
impl Block {
    #[new]
    #[pyo3(signature = (
        *, width_m = None, height_m = None, size_m = None, slenderness_rad = None, restitution = None,
        gravity_m_s2 = 9.806_65
    ))]
    fn new(
        width_m: Option<f64>,
        height_m: Option<f64>,
        size_m: Option<f64>,
        slenderness_rad: Option<f64>,
        restitution: Option<f64>,
        gravity_m_s2: f64,
    ) -> PyResult<Self> {
        check_plausible(&[
            (LENGTH, "width_m", width_m),
            (LENGTH, "height_m", height_m),
            (SIZE, "size_m", size_m),
            (RESTITUTION, "restitution", restitution),
            (GRAVITY, "gravity_m_s2", Some(gravity_m_s2)),
        ])?;
        let block = match (slenderness_rad, width_m, height_m, size_m) {
            (None, Some(width_m), Some(height_m), None) => RockingBlock::from_half_sides(0.5 * width_m, 0.5 * height_m),
            (Some(slenderness_rad), None, Some(height_m), None) => RockingBlock::from_height(height_m, slenderness_rad),
            (Some(slenderness_rad), Some(width_m), None, None) => {
                RockingBlock::new(0.5 * width_m / slenderness_rad.sin(), slenderness_rad)
            }
            (Some(slenderness_rad), None, None, Some(size_m)) => RockingBlock::new(size_m, slenderness_rad),
            _ => {
                return Err(PyValueError::new_err(
                    "a block needs two numbers: width_m and height_m, or slenderness_rad and one of width_m, height_m \
                     and size_m",
                ));
            }
        };
        let block = block.and_then(|block| block.with_gravity(gravity_m_s2)).map_err(refused)?;
        let block = restitution.map_or(Ok(block), |restitution| block.with_restitution(restitution));
        block.map(Self).map_err(refused)
    }

    /// Width 2b, m.
    #[getter]
    fn width_m(&self) -> f64 {
        2.0 * self.0.half_width_m()
    }

    /// Height 2h, m.
    #[getter]
    fn height_m(&self) -> f64 {
        2.0 * self.0.half_height_m()
    }

    /// Half the diagonal R, m.
    #[getter]
    fn size_m(&self) -> f64 {
        self.0.size_m()
    }

    /// Slenderness α, rad.
    #[getter]
    fn slenderness_rad(&self) -> f64 {
        self.0.slenderness_rad()
    }

    /// Angular velocity after an impact over the one before.
    #[getter]
    fn restitution(&self) -> f64 {
        self.0.restitution()
    }

    /// Frequency parameter p = √(3g/(4R)), rad/s.
    #[getter]
    fn frequency_parameter_rad_s(&self) -> f64 {
        self.0.frequency_parameter_rad_s()
    }

    /// Shakes the block with a record: Eq. 2.1 between impacts, Eq. 2.3 at them.
    ///
    /// Parameters
    /// ----------
    /// record : Record
    /// scale : float or array_like, default 1
    ///     Factors on the record.
    /// free_vibration_s : float, default 0
    ///     How long the block is followed after the record, s; 0: to its first peak, the last that may be the largest.
    ///
    /// Returns
    /// -------
    /// BlockResponses
    ///     Arrays in the shape of `scale`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For factors or times that no person means.
    ///
    /// Notes
    /// -----
    /// N. Reggiani Manzo, dissertation, Chapter 2.
    #[pyo3(signature = (record, *, scale = None, free_vibration_s = 0.0), text_signature = "($self, record, *, \
scale=1.0, free_vibration_s=0.0)")]
    fn respond(
        &self,
        py: Python<'_>,
        record: &Bound<'_, Record>,
        scale: Option<&Bound<'_, PyAny>>,
        free_vibration_s: f64,
    ) -> PyResult<BlockResponses> {
        let scale = match scale {
            Some(given) => floats("scale", given)?,
            None => numpy::ndarray::ArrayD::from_elem(numpy::ndarray::IxDyn(&[]), 1.0),
        };
        check_plausible(&[(FREE_VIBRATION, "free_vibration_s", Some(free_vibration_s))])?;
        for factor in &scale {
            check_plausible(&[(SCALE, "scale", Some(*factor))])?;
        }
        let free = match free_vibration_s {
            0.0 => FreeRocking::FirstPeak,
            duration_s => FreeRocking::Lasting { duration_s },
        };
        let motion: Arc<Accelerogram> = record.get().accelerogram.clone();
        let scales: Vec<f64> = scale.iter().copied().collect();
        let runs = on_all_cores(py, |interruption| {
            let run = |scale: &f64| {
                if interruption.cancelled() {
                    return Err(PyKeyboardInterrupt::new_err(()));
                }
                let ground = motion.scaled(*scale).map_err(refused)?;
                uplift_block::respond(&self.0, &ground, free).map_err(refused)
            };
            scales.par_iter().map(run).collect::<PyResult<Vec<_>>>()
        })?;
        BlockResponses::new(py, scale.shape(), &runs)
    }

    fn __repr__(&self) -> String {
        let (width_m, height_m, restitution) = (self.width_m(), self.height_m(), self.restitution());
        format!("<Block: {width_m:.4} m wide, {height_m:.4} m high, restitution {restitution:.4}>")
    }
}

/// What became of a block, in the shape of the scales.
///
/// Attributes
/// ----------
/// peak_rotation_rad : ndarray of float64
///     Largest rotation, rad; `inf` where overturned, 0 where it never uplifts.
/// peak_displacement_m : ndarray of float64
///     Largest displacement of the top, m (Eq. 2.10).
/// time_of_peak_s : ndarray of float64
///     When, s from the start of the record; of an overturned block when it lies or is lost for certain.
/// impacts : ndarray of uint64
/// overturned : ndarray of bool
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct BlockResponses {
    peak_rotation_rad: Py<PyArrayDyn<f64>>,
    peak_displacement_m: Py<PyArrayDyn<f64>>,
    time_of_peak_s: Py<PyArrayDyn<f64>>,
    impacts: Py<PyArrayDyn<u64>>,
    overturned: Py<PyArrayDyn<bool>>,
}

impl BlockResponses {
    fn new(py: Python<'_>, shape: &[usize], runs: &[BlockResponse]) -> PyResult<Self> {
        let of = |value: fn(&BlockResponse) -> f64| {
            PyResult::Ok(array(py, shape, runs.iter().map(value).collect())?.unbind())
        };
        Ok(Self {
            peak_rotation_rad: of(|run| run.rotation_rad)?,
            peak_displacement_m: of(|run| run.displacement_m)?,
            time_of_peak_s: of(|run| run.time_s)?,
            impacts: array(py, shape, runs.iter().map(|run| run.impacts).collect())?.unbind(),
            overturned: array(py, shape, runs.iter().map(BlockResponse::is_overturned).collect())?.unbind(),
        })
    }
}

#[pymethods]
impl BlockResponses {
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("<BlockResponses of the shape {}>", self.overturned.bind(py).getattr("shape")?))
    }
}
