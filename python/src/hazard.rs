//! Hazard curves.

use std::path::PathBuf;

use numpy::{PyArray1, PyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyType;
use uplift_hazard::{
    ComponentDefinition, CsvOptions, Declared, Extrapolation, HazardError, SecondColumn, read_csv, table_text,
};
use uplift_motion::IntensityMeasure;
use uplift_plausible::YEARS;

use crate::errors::{check_plausible, from_hazard_file, refused};
use crate::floats::{array, floats, list};

/// A site's hazard curve: the mean annual frequency of exceeding each level of an intensity measure.
///
/// A curve that exists is valid: levels above 0 that increase, frequencies above 0 that decrease. Between its points it
/// is straight in double logarithms. It does not change.
///
/// Parameters
/// ----------
/// im : array_like, shape (points,)
///     Levels of the measure, in `unit`; at least 2.
/// maf_per_year : array_like, shape (points,)
///     Mean annual frequencies of exceeding them, 1/yr.
/// measure : str, default "pgv"
///     Intensity measure; any other name is kept as it is and needs a unit.
/// unit : str, optional
///     "cm/s", "m/s", "g", "m/s2", "cm/s2", "cm", "m"; without it that of the measure: cm/s, g or cm.
/// source : str, optional
///     Where the numbers come from.
/// component : str, optional
///     How the two horizontal components are combined: "geometric mean", "GMRotI50", "RotD50", "RotD100", "larger",
///     "arbitrary".
///
/// Raises
/// ------
/// ValueError
///     With the index and the value of the first point that breaks a rule; for a unit that the measure cannot have.
///
/// Examples
/// --------
/// >>> HazardCurve([1, 10, 100], [0.1, 1e-3, 1e-5]).rate_at(10)
/// 0.001
#[pyclass(frozen, eq, module = "uplift_urs")]
#[derive(Clone, PartialEq)]
pub(crate) struct HazardCurve {
    pub(crate) curve: uplift_hazard::HazardCurve,
}

#[pymethods]
impl HazardCurve {
    #[new]
    #[pyo3(signature = (im, maf_per_year, *, measure = "pgv", unit = None, source = "", component = None))]
    fn new(
        im: &Bound<'_, PyAny>,
        maf_per_year: &Bound<'_, PyAny>,
        measure: &str,
        unit: Option<&str>,
        source: &str,
        component: Option<&str>,
    ) -> PyResult<Self> {
        let component = component.map(str::parse::<ComponentDefinition>).transpose().map_err(refused)?;
        let Declared { measure, unit } = declared("", "HazardCurve", Some(measure), unit)?;
        let (im, maf) = (list("im", im)?, list("maf_per_year", maf_per_year)?);
        let curve = uplift_hazard::HazardCurve::new(measure, unit, source, im, maf).map_err(refused)?;
        Ok(Self { curve: curve.with_component(component) })
    }

    /// Reads a curve from a file of two columns, level and frequency or probability, as a study does.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     Text, separated by comma, semicolon, tab or blanks; column names and lines that begin with "#" may say what
    ///     the columns are (docs/hazard.md).
    /// measure : str, optional
    ///     Intensity measure; without it what the file says.
    /// unit : str, optional
    ///     Unit of the levels; without it what the file says, or that of the measure.
    /// kind : {"maf", "poe"}, optional
    ///     Annual frequencies or probabilities, for a file without column names.
    /// years : float, optional
    ///     Time that probabilities refer to, yr.
    ///
    /// Returns
    /// -------
    /// HazardCurve
    ///
    /// Raises
    /// ------
    /// OSError
    ///     For a file that is not there or cannot be read.
    /// ValueError
    ///     For a file that is no hazard curve, or says something else than the arguments; with file, line and value.
    #[classmethod]
    #[pyo3(signature = (path, *, measure = None, unit = None, kind = None, years = None))]
    fn read(
        _class: &Bound<'_, PyType>,
        path: PathBuf,
        measure: Option<&str>,
        unit: Option<&str>,
        kind: Option<&str>,
        years: Option<f64>,
    ) -> PyResult<Self> {
        check_plausible(&[(YEARS, "years", years)])?;
        let second_column = match kind {
            None => None,
            Some("maf") => Some(SecondColumn::AnnualRate),
            Some("poe") => Some(SecondColumn::Probability),
            Some(other) => {
                return Err(PyValueError::new_err(format!("kind is {other:?}: it must be \"maf\" or \"poe\"")));
            }
        };
        let failed = |error: HazardError| from_hazard_file(error, &path);
        let text = table_text(&path).map_err(failed)?;
        let name = path.display().to_string();
        let declared = declared(&text, &name, measure, unit)?;
        let options = CsvOptions { declared, second_column, years };
        let read = read_csv(&text, &name, &options).map_err(failed)?;
        Ok(Self { curve: read.curve })
    }

    /// Levels, in `unit`, shape (points,); a copy.
    #[getter]
    fn im<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.curve.im())
    }

    /// Mean annual frequencies of exceedance, 1/yr, shape (points,); a copy.
    #[getter]
    fn maf_per_year<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.curve.maf())
    }

    /// Intensity measure, e.g. "PGV".
    #[getter]
    fn measure(&self) -> &str {
        self.curve.measure()
    }

    /// Unit of the levels, e.g. "cm/s".
    #[getter]
    fn unit(&self) -> &str {
        self.curve.unit()
    }

    /// Where the numbers come from.
    #[getter]
    fn source(&self) -> &str {
        self.curve.source()
    }

    /// How the horizontal components are combined, where it is known.
    #[getter]
    fn component(&self) -> Option<String> {
        self.curve.component().map(|component| component.to_string())
    }

    /// Mean annual frequency of exceeding levels.
    ///
    /// Parameters
    /// ----------
    /// im : float or array_like
    ///     Levels, in `unit`.
    /// extrapolate : {"refuse", "loglog"}, default "refuse"
    ///     Outside the curve: an error, or the first and last segment continued in double logarithms.
    ///
    /// Returns
    /// -------
    /// ndarray of float64
    ///     Frequencies, 1/yr, in the shape of `im`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a level outside the curve, or not above 0.
    #[pyo3(signature = (im, *, extrapolate = "refuse"))]
    fn rate_at<'py>(
        &self,
        py: Python<'py>,
        im: &Bound<'py, PyAny>,
        extrapolate: &str,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let extrapolation = extrapolation(extrapolate)?;
        each(py, "im", im, |im| self.curve.rate_at_extrapolated(im, extrapolation))
    }

    /// Level that is exceeded at annual frequencies: the uniform hazard value, the inverse of `rate_at`.
    ///
    /// Parameters
    /// ----------
    /// rate_per_year : float or array_like
    ///     Annual frequencies, 1/yr.
    /// extrapolate : {"refuse", "loglog"}, default "refuse"
    ///     As for `rate_at`.
    ///
    /// Returns
    /// -------
    /// ndarray of float64
    ///     Levels, in `unit`, in the shape of `rate_per_year`.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a frequency outside the curve, or not above 0.
    #[pyo3(signature = (rate_per_year, *, extrapolate = "refuse"))]
    fn im_at_rate<'py>(
        &self,
        py: Python<'py>,
        rate_per_year: &Bound<'py, PyAny>,
        extrapolate: &str,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let extrapolation = extrapolation(extrapolate)?;
        each(py, "rate_per_year", rate_per_year, |rate| self.curve.im_at_rate_extrapolated(rate, extrapolation))
    }

    /// The same curve with its levels in another unit of the same dimension.
    ///
    /// Parameters
    /// ----------
    /// unit : str
    ///     "cm/s", "m/s", "g s"; "g", "m/s2", "cm/s2"; "cm", "m".
    /// gravity_m_s2 : float, default 9.80665
    ///     What 1 g stands for, m/s².
    ///
    /// Returns
    /// -------
    /// HazardCurve
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a unit that is unknown or of another dimension.
    #[pyo3(signature = (unit, *, gravity_m_s2 = 9.806_65))]
    fn in_unit(&self, unit: &str, gravity_m_s2: f64) -> PyResult<Self> {
        let curve = self.curve.in_unit(unit, gravity_m_s2).map_err(refused)?;
        Ok(Self { curve })
    }

    /// The curve as the text of a file that `read` reads back to the bit.
    fn to_csv(&self) -> String {
        self.curve.to_csv(&[])
    }

    fn __len__(&self) -> usize {
        self.curve.len()
    }

    fn __repr__(&self) -> String {
        let (first, last) = (self.curve.first(), self.curve.last());
        let (measure, unit, points) = (self.curve.measure(), self.curve.unit(), self.curve.len());
        let (from, to) = (first.im, last.im);
        format!(
            "<HazardCurve: {measure}, {points} points, {from} to {to} {unit}, {:e} to {:e} per year>",
            first.maf, last.maf
        )
    }
}

/// The values of a function of one number, in the shape in which the numbers are given.
fn each<'py>(
    py: Python<'py>,
    name: &str,
    given: &Bound<'py, PyAny>,
    value: impl Fn(f64) -> Result<f64, HazardError>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let given = floats(name, given)?;
    let values = given.iter().map(|number| value(*number)).collect::<Result<Vec<_>, _>>().map_err(refused)?;
    array(py, given.shape(), values)
}

/// A measure and its unit, given or said by a table.
fn declared(text: &str, name: &str, measure: Option<&str>, unit: Option<&str>) -> PyResult<Declared> {
    let mut declared = Declared::completed(text, name, measure, unit).map_err(refused)?;
    if let Ok(known) = declared.measure.parse::<IntensityMeasure>() {
        known.label().clone_into(&mut declared.measure);
    }
    Ok(declared)
}

/// What happens outside a curve, by its word.
pub(crate) fn extrapolation(word: &str) -> PyResult<Extrapolation> {
    Extrapolation::ALL
        .into_iter()
        .find(|choice| choice.key() == word)
        .ok_or_else(|| PyValueError::new_err(format!("extrapolate is {word:?}: it must be \"refuse\" or \"loglog\"")))
}
