//! Records: read, or from arrays.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{PyArray1, PyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use uplift_motion::{
    AccelerationUnit, Accelerogram, IntensityMeasure, Orientation, ReadOptions, RecordFormat, Recording,
    RecordingDescription, read_record_file,
};
use uplift_plausible::{GRAVITY, PEAK_ACCELERATION, TIME_STEP};

use crate::errors::{check_plausible, from_motion, refused};
use crate::floats::{array, list};

/// Samples that a record has at most: hours at 200 Hz.
const MOST_SAMPLES: usize = 10_000_000;

/// One component of a ground motion: acceleration at equal time steps, linear between samples.
///
/// Made by `read_record`, `read_records` or `Record.from_array`; it does not change.
#[pyclass(frozen, module = "uplift_urs")]
#[derive(Clone)]
pub(crate) struct Record {
    pub(crate) accelerogram: Arc<Accelerogram>,
    /// Name, for messages: that of the file, or what the caller said.
    #[pyo3(get)]
    pub(crate) name: String,
    /// Acceleration of gravity, m/s², by which values in g are converted.
    #[pyo3(get)]
    gravity_m_s2: f64,
    description: RecordingDescription,
}

#[pymethods]
impl Record {
    /// A record from an array.
    ///
    /// Parameters
    /// ----------
    /// acceleration : array_like, shape (samples,)
    ///     Ground acceleration at equal time steps, in `unit`; at least 2 samples. It is copied.
    /// dt_s : float
    ///     Time step, s.
    /// unit : {"g", "m/s2", "cm/s2", "gal"}
    ///     Unit of the acceleration.
    /// name : str, default "record"
    ///     Name, for messages.
    /// gravity_m_s2 : float, default 9.80665
    ///     What 1 g stands for, m/s².
    ///
    /// Returns
    /// -------
    /// Record
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For fewer than 2 samples or more than 10 million, samples that are not finite or beyond 10 000 m/s², a time
    ///     step outside 1e-6 to 10 s, an unknown unit.
    /// TypeError
    ///     For an array that is not of real numbers.
    ///
    /// Examples
    /// --------
    /// >>> Record.from_array([0.0, 0.1, -0.2, 0.0], dt_s=0.01, unit="g").pga_g
    /// 0.2
    #[classmethod]
    #[pyo3(signature = (acceleration, *, dt_s, unit, name = "record", gravity_m_s2 = 9.806_65))]
    fn from_array(
        _class: &Bound<'_, PyType>,
        acceleration: &Bound<'_, PyAny>,
        dt_s: f64,
        unit: &str,
        name: &str,
        gravity_m_s2: f64,
    ) -> PyResult<Self> {
        check_plausible(&[(TIME_STEP, "dt_s", Some(dt_s)), (GRAVITY, "gravity_m_s2", Some(gravity_m_s2))])?;
        let unit: AccelerationUnit = unit.parse().map_err(from_motion)?;
        let values = list("acceleration", acceleration)?;
        if values.len() > MOST_SAMPLES {
            let count = values.len();
            return Err(PyValueError::new_err(format!("acceleration has {count} samples: at most {MOST_SAMPLES}")));
        }
        let in_m_s2 = values.into_iter().map(|value| unit.to_m_s2(value, gravity_m_s2)).collect();
        let accelerogram = Accelerogram::new(dt_s, in_m_s2).map_err(from_motion)?;
        PEAK_ACCELERATION.check("the largest acceleration", accelerogram.pga_m_s2()).map_err(refused)?;
        let description = RecordingDescription::default();
        Ok(Self { accelerogram: Arc::new(accelerogram), name: name.to_owned(), gravity_m_s2, description })
    }

    /// A record from a trace of ObsPy.
    ///
    /// Parameters
    /// ----------
    /// trace : obspy.Trace, or obspy.Stream of one
    ///     Ground acceleration: response removed, offset taken away.
    /// unit : {"g", "m/s2", "cm/s2", "gal"}
    ///     Unit of its samples.
    /// gravity_m_s2 : float, default 9.80665
    ///     What 1 g stands for, m/s².
    ///
    /// Returns
    /// -------
    /// Record
    ///     Named by the identifier of the trace.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a stream of several traces or none, a trace with gaps, and as `from_array`.
    /// AttributeError
    ///     If `trace` is neither a trace nor a stream.
    #[classmethod]
    #[pyo3(signature = (trace, *, unit, gravity_m_s2 = 9.806_65))]
    fn from_obspy(
        class: &Bound<'_, PyType>,
        trace: &Bound<'_, PyAny>,
        unit: &str,
        gravity_m_s2: f64,
    ) -> PyResult<Self> {
        if trace.hasattr("traces")? {
            let count = trace.len()?;
            if count != 1 {
                let message = format!("the stream has {count} traces: give one of them, stream[0]");
                return Err(PyValueError::new_err(message));
            }
            return Self::from_obspy(class, &trace.get_item(0)?, unit, gravity_m_s2);
        }
        let (samples, dt_s) = (trace.getattr("data")?, trace.getattr("stats")?.getattr("delta")?.extract()?);
        Self::from_array(class, &samples, dt_s, unit, &trace.getattr("id")?.extract::<String>()?, gravity_m_s2)
    }

    /// Ground acceleration, m/s², shape (samples,); a copy.
    #[getter]
    fn acceleration_m_s2<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.accelerogram.acceleration_m_s2())
    }

    /// Times of the samples, s, shape (samples,), the first 0.
    #[getter]
    fn time_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let times: Vec<f64> = (0..self.accelerogram.len()).map(|i| i as f64 * self.accelerogram.dt_s()).collect();
        array(py, &[times.len()], times)
    }

    /// Time step, s.
    #[getter]
    fn dt_s(&self) -> f64 {
        self.accelerogram.dt_s()
    }

    /// Time from the first to the last sample, s.
    #[getter]
    fn duration_s(&self) -> f64 {
        self.accelerogram.duration_s()
    }

    /// Peak ground acceleration, g.
    #[getter]
    fn pga_g(&self) -> f64 {
        self.value(IntensityMeasure::Pga)
    }

    /// Peak ground velocity, cm/s.
    #[getter]
    fn pgv_cm_s(&self) -> f64 {
        self.value(IntensityMeasure::Pgv)
    }

    /// Peak ground displacement, cm.
    #[getter]
    fn pgd_cm(&self) -> f64 {
        self.value(IntensityMeasure::Pgd)
    }

    /// Cumulative absolute velocity, cm/s.
    #[getter]
    fn cav_cm_s(&self) -> f64 {
        self.value(IntensityMeasure::Cav)
    }

    /// Arias intensity, cm/s.
    #[getter]
    fn arias_cm_s(&self) -> f64 {
        self.value(IntensityMeasure::Arias)
    }

    /// An intensity measure of this component.
    ///
    /// Parameters
    /// ----------
    /// measure : str
    ///     "pgv" (cm/s), "pga" (g), "sa_1s" (g; of any period, "sa_0p5s" or "SA(0.5)"), "avgsa_0p2s_2s" (g), "pgd"
    ///     (cm), "cav" (cm/s), "arias" (cm/s), "si" (cm), "d5_75" (s), "d5_95" (s).
    ///
    /// Returns
    /// -------
    /// float
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For an unknown measure.
    fn measure(&self, py: Python<'_>, measure: &str) -> PyResult<f64> {
        let measure = measure.parse::<IntensityMeasure>().map_err(from_motion)?;
        Ok(py.detach(|| self.value(measure)))
    }

    /// What the file says about the record, as far as it says it: event, event_time, magnitude,
    /// epicentral_distance_km, rupture_distance_km, station, station_name, vs30_m_s, sensor, channel, azimuth_deg,
    /// low_cut_hz, start_time_s, unprocessed.
    #[getter]
    fn description<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let said = &self.description;
        let words = [
            ("event", &said.event),
            ("event_time", &said.event_time),
            ("station", &said.station),
            ("station_name", &said.station_name),
            ("sensor", &said.sensor),
            ("channel", &said.channel),
        ];
        let azimuth_deg = match said.orientation {
            Some(Orientation::Azimuth(degrees)) => Some(degrees),
            _ => None,
        };
        let numbers = [
            ("magnitude", said.magnitude),
            ("epicentral_distance_km", said.epicentral_distance_km),
            ("rupture_distance_km", said.rupture_distance_km),
            ("vs30_m_s", said.vs30_m_s),
            ("azimuth_deg", azimuth_deg),
            ("low_cut_hz", said.low_cut_hz),
            ("start_time_s", said.start_time_s),
        ];
        let found = PyDict::new(py);
        for (key, word) in words.into_iter().filter_map(|(key, word)| Some((key, word.as_deref()?))) {
            found.set_item(key, word)?;
        }
        for (key, number) in numbers.into_iter().filter_map(|(key, number)| Some((key, number?))) {
            found.set_item(key, number)?;
        }
        if said.unprocessed {
            found.set_item("unprocessed", true)?;
        }
        Ok(found)
    }

    fn __len__(&self) -> usize {
        self.accelerogram.len()
    }

    fn __repr__(&self) -> String {
        let (samples, dt_s, pga_g, pgv_cm_s) = (self.__len__(), self.dt_s(), self.pga_g(), self.pgv_cm_s());
        format!("<Record {:?}: {samples} samples, dt {dt_s} s, PGA {pga_g:.3} g, PGV {pgv_cm_s:.2} cm/s>", self.name)
    }
}

impl Record {
    fn value(&self, measure: IntensityMeasure) -> f64 {
        measure.component_value(&self.accelerogram, self.gravity_m_s2)
    }

    fn read(recording: Recording, name: String, gravity_m_s2: f64) -> Self {
        let Recording { accelerogram, description, .. } = recording;
        Self { accelerogram: Arc::new(accelerogram), name, gravity_m_s2, description }
    }
}

/// Reads one component of a record file.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     PEER AT2, ESM, K-NET and KiK-net, COSMOS, CSMIP, or text of one column (acceleration) or two (time,
///     acceleration); gzip is unpacked. The format is recognised by the content.
/// channel : int, optional
///     Which component of a file with several, counted from 1.
/// dt_s : float, optional
///     Time step of a file that does not say it, s.
/// unit : {"g", "m/s2", "cm/s2", "gal"}, optional
///     Unit of a file that does not say it.
/// format : {"at2", "esm", "knet", "cosmos", "csmip", "columns"}, optional
///     Format, if it is not to be recognised.
/// gravity_m_s2 : float, default 9.80665
///     What 1 g stands for, m/s².
///
/// Returns
/// -------
/// Record
///
/// Raises
/// ------
/// OSError
///     For a file that is not there or cannot be read (`FileNotFoundError`, `PermissionError`, ...).
/// ValueError
///     For a file that is no record, is damaged, or needs one of the options; the message names file, line and value.
#[pyfunction]
#[pyo3(signature = (path, *, channel = None, dt_s = None, unit = None, format = None, gravity_m_s2 = 9.806_65))]
pub(crate) fn read_record(
    py: Python<'_>,
    path: PathBuf,
    channel: Option<usize>,
    dt_s: Option<f64>,
    unit: Option<&str>,
    format: Option<&str>,
    gravity_m_s2: f64,
) -> PyResult<Record> {
    let options = ReadOptions { channel, ..options(dt_s, unit, format, gravity_m_s2)? };
    let name = path.display().to_string();
    let read = || read_record_file(&path, &options)?.component(&name, channel);
    let recording = py.detach(read).map_err(from_motion)?;
    Ok(Record::read(recording, name, gravity_m_s2))
}

/// Reads all components of a record file, in its order.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     A file of any format of `read_record`.
/// dt_s, unit, format, gravity_m_s2 : optional
///     As for `read_record`.
///
/// Returns
/// -------
/// list of Record
///     At least one; with several, their names end with "#1", "#2" and so on.
///
/// Raises
/// ------
/// OSError, ValueError
///     As `read_record`.
#[pyfunction]
#[pyo3(signature = (path, *, dt_s = None, unit = None, format = None, gravity_m_s2 = 9.806_65))]
pub(crate) fn read_records(
    py: Python<'_>,
    path: PathBuf,
    dt_s: Option<f64>,
    unit: Option<&str>,
    format: Option<&str>,
    gravity_m_s2: f64,
) -> PyResult<Vec<Record>> {
    let options = options(dt_s, unit, format, gravity_m_s2)?;
    let recordings = py.detach(|| read_record_file(&path, &options)).map_err(from_motion)?.recordings;
    let is_alone = recordings.len() == 1;
    let name = |number: usize| {
        if is_alone { path.display().to_string() } else { format!("{}#{number}", path.display()) }
    };
    let record = |(number, recording)| Record::read(recording, name(number), gravity_m_s2);
    Ok((1..).zip(recordings).map(record).collect())
}

fn options(dt_s: Option<f64>, unit: Option<&str>, format: Option<&str>, gravity_m_s2: f64) -> PyResult<ReadOptions> {
    check_plausible(&[(TIME_STEP, "dt_s", dt_s), (GRAVITY, "gravity_m_s2", Some(gravity_m_s2))])?;
    let unit = unit.map(str::parse::<AccelerationUnit>).transpose().map_err(from_motion)?;
    let format = format.map(str::parse::<RecordFormat>).transpose().map_err(from_motion)?;
    Ok(ReadOptions { format, channel: None, dt_s, unit, gravity_m_s2 })
}
