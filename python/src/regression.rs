//! The curve through a spectrum (Eq. 4.11).

use numpy::PyArrayDyn;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_regression::{Exponential, ExponentialFit};

use crate::errors::refused;
use crate::floats::{array, floats, list};

/// The curve u(η) = c0 exp(c1 η) + c2 through a spectrum (Eq. 4.11).
///
/// Attributes
/// ----------
/// c0_m, c1, c2_m : float
///     Coefficients: m, 1, m.
/// rmse_m, rmse_plain_m : float
///     Root mean square error with n − 3 degrees of freedom, and over all n points, m.
/// max_abs_residual_m, max_abs_residual_strength : float
///     Largest residual, m, and where it is.
/// bound_active : bool
///     Whether c2 is held at 0.
/// at_search_limit : bool
///     Whether the data are a straight line or a step rather than an exponential, so that the coefficients have no
///     meaning one by one.
/// points : int
///     Number of points fitted.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct Fit {
    c0_m: f64,
    c1: f64,
    c2_m: f64,
    rmse_m: f64,
    rmse_plain_m: f64,
    max_abs_residual_m: f64,
    max_abs_residual_strength: f64,
    bound_active: bool,
    at_search_limit: bool,
    points: usize,
}

#[pymethods]
impl Fit {
    /// The curve at strengths.
    ///
    /// Parameters
    /// ----------
    /// strength : float or array_like
    ///     Uplift strengths η.
    ///
    /// Returns
    /// -------
    /// ndarray of float64
    ///     Displacements, m, in the shape of `strength`.
    fn at<'py>(&self, py: Python<'py>, strength: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let curve = Exponential { c0: self.c0_m, c1: self.c1, c2: self.c2_m };
        let strengths = floats("strength", strength)?;
        array(py, strengths.shape(), strengths.iter().map(|strength| curve.at(*strength)).collect())
    }

    fn __repr__(&self) -> String {
        let Self { c0_m, c1, c2_m, rmse_m, .. } = self;
        format!("<Fit: {c0_m:.4} m exp({c1:.3} strength) + {c2_m:.4} m, rmse {rmse_m:.2e} m>")
    }
}

/// Fits u = c0 exp(c1 η) + c2 with c2 ≥ 0 to a spectrum by least squares (Eq. 4.11); the minimum is the global one.
///
/// Parameters
/// ----------
/// strengths : array_like, shape (strengths,)
///     Uplift strengths η, in any order.
/// u_m : array_like, shape (strengths,)
///     Displacements of the spectrum, m.
/// strength_above : float, default 0.05
///     Only strengths above this take part.
///
/// Returns
/// -------
/// Fit
///
/// Raises
/// ------
/// ValueError
///     For arrays of different lengths, fewer than 4 points, a censored ordinate among those that take part,
///     displacements that are all equal.
///
/// Notes
/// -----
/// N. Reggiani Manzo, dissertation, Section 4.6 and Table 4.2.
#[pyfunction]
#[pyo3(signature = (strengths, u_m, *, strength_above = 0.05))]
pub(crate) fn fit(
    py: Python<'_>,
    strengths: &Bound<'_, PyAny>,
    u_m: &Bound<'_, PyAny>,
    strength_above: f64,
) -> PyResult<Fit> {
    let (strengths, displacements) = (list("strengths", strengths)?, list("u_m", u_m)?);
    if strengths.len() != displacements.len() {
        let (strengths, displacements) = (strengths.len(), displacements.len());
        let message = format!("{strengths} strengths but {displacements} displacements: give one for each strength");
        return Err(PyValueError::new_err(message));
    }
    // a strength that is no number takes part, and is refused
    let takes_part = |pair: &(f64, f64)| !(pair.0 <= strength_above);
    let (strengths, displacements): (Vec<f64>, Vec<f64>) =
        strengths.into_iter().zip(displacements).filter(takes_part).unzip();
    if let Some(position) = displacements.iter().position(|u| u.is_infinite()) {
        let strength = strengths[position];
        return Err(PyValueError::new_err(format!("the spectrum is censored at strength {strength}: leave it out")));
    }
    let found: ExponentialFit = py.detach(|| uplift_regression::fit(&strengths, &displacements)).map_err(refused)?;
    Ok(Fit {
        c0_m: found.c0,
        c1: found.c1,
        c2_m: found.c2,
        rmse_m: found.rmse,
        rmse_plain_m: found.rmse_plain,
        max_abs_residual_m: found.max_abs_residual,
        max_abs_residual_strength: found.max_abs_residual_strength,
        bound_active: found.bound_active,
        at_search_limit: found.at_search_limit,
        points: found.points,
    })
}
