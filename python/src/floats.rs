//! What Python gives as numbers.

use numpy::ndarray::{ArrayD, IxDyn};
use numpy::{PyArray, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt};

/// A number, a list or an array of any real type, layout and byte order, as an array of its own in C order: what
/// Python does to it afterwards is not seen. `name` stands in messages.
pub(crate) fn floats(name: &str, given: &Bound<'_, PyAny>) -> PyResult<ArrayD<f64>> {
    if let Some(number) = number(name, given)? {
        return Ok(ArrayD::from_elem(IxDyn(&[]), number));
    }
    let numpy = PyModule::import(given.py(), "numpy")?;
    let array = numpy.call_method1("asarray", (given,))?;
    let dtype = array.getattr("dtype")?;
    if !matches!(dtype.getattr("kind")?.extract::<String>()?.as_str(), "f" | "i" | "u") {
        return Err(PyTypeError::new_err(format!("{name} is of type {dtype}: it must be real numbers")));
    }
    if given.hasattr("mask")? && numpy.getattr("ma")?.call_method1("is_masked", (given,))?.is_truthy()? {
        let message = format!("{name} has masked values: fill them, or leave them out");
        return Err(PyValueError::new_err(message));
    }
    let plain = numpy.call_method1("require", (array, "float64", ["C", "A"]))?;
    let plain = plain.cast::<PyArrayDyn<f64>>()?.try_readonly()?;
    let values = copied(plain.as_slice()?)?;
    shaped(plain.as_array().shape(), values)
}

/// The same of one dimension.
pub(crate) fn list(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = floats(name, given)?;
    if array.ndim() > 1 {
        let shape = array.shape();
        return Err(PyValueError::new_err(format!("{name} has the shape {shape:?}: it must have one dimension")));
    }
    Ok(array.into_raw_vec_and_offset().0)
}

/// A Python float or int; none for anything else.
fn number(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    if let Ok(float) = given.cast::<PyFloat>() {
        return Ok(Some(float.extract()?));
    }
    if given.cast::<PyInt>().is_ok() && given.cast::<PyBool>().is_err() {
        let too_large = |_| PyValueError::new_err(format!("{name} is an integer beyond the range of numbers"));
        return given.extract().map(Some).map_err(too_large);
    }
    Ok(None)
}

/// An array of this shape for Python, without a copy.
pub(crate) fn array<'py, T: numpy::Element>(
    py: Python<'py>,
    shape: &[usize],
    values: Vec<T>,
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    Ok(PyArray::from_owned_array(py, shaped(shape, values)?))
}

fn shaped<T>(shape: &[usize], values: Vec<T>) -> PyResult<ArrayD<T>> {
    ArrayD::from_shape_vec(shape, values).map_err(|error| PyValueError::new_err(error.to_string()))
}

fn copied(values: &[f64]) -> PyResult<Vec<f64>> {
    let mut copy = room(values.len())?;
    copy.extend_from_slice(values);
    Ok(copy)
}

/// Room for so many values, or `MemoryError`.
pub(crate) fn room<T>(count: usize) -> PyResult<Vec<T>> {
    let mut values = Vec::new();
    match values.try_reserve_exact(count) {
        Ok(()) => Ok(values),
        Err(_) => Err(PyMemoryError::new_err(format!("{count} values do not fit the memory: ask for fewer at once"))),
    }
}

/// How many values an array of this shape has, or `MemoryError`.
pub(crate) fn count(shape: &[usize]) -> PyResult<usize> {
    let product = shape.iter().try_fold(1_usize, |product, length| product.checked_mul(*length));
    product.ok_or_else(|| PyMemoryError::new_err(format!("an array of the shape {shape:?} does not fit the memory")))
}
