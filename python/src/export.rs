//! Files of many hazard curves, as the engines export them.

use std::path::PathBuf;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_hazard::{SiteSelection, read_export};

use crate::errors::from_hazard_file;
use crate::hazard::HazardCurve;

/// A curve of an engine's export.
///
/// Attributes
/// ----------
/// curve : HazardCurve
/// site : str or None
///     The engine's own name of the site.
/// longitude_deg, latitude_deg : float
/// distance_km : float or None
///     Distance from the place asked for, km.
/// statistic : str
///     "mean", "quantile 0.84", "realization 3", ..., "exported" where the file does not say.
/// investigation_years : float or None
///     Time of the probabilities that the frequencies were computed from, yr.
/// vs30_m_s : float or None
///     Mean shear-wave velocity of the upper 30 m, m/s.
#[pyclass(frozen, get_all, module = "uplift_urs")]
pub(crate) struct ExportedCurve {
    curve: Py<HazardCurve>,
    site: Option<String>,
    longitude_deg: f64,
    latitude_deg: f64,
    distance_km: Option<f64>,
    statistic: String,
    investigation_years: Option<f64>,
    vs30_m_s: Option<f64>,
}

#[pymethods]
impl ExportedCurve {
    fn __repr__(&self) -> String {
        let Self { statistic, longitude_deg, latitude_deg, .. } = self;
        let (curve, site) = (self.curve.get().curve.measure(), self.site.as_deref().unwrap_or(""));
        format!("<ExportedCurve: {statistic} of {curve}, site {site:?} at {longitude_deg}, {latitude_deg}>")
    }
}

/// Reads the hazard curves of an engine's export: OpenQuake's CSV, NRML (XML), JSON of the USGS.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file; gzip is unpacked, the format is recognised by the content.
/// site : str, optional
///     Only the curves of the site of this name.
/// near : (float, float), optional
///     Only those of the site nearest to this longitude and latitude, degrees.
///
/// Returns
/// -------
/// list of ExportedCurve
///     All measures and statistics that the file has for the site, or for all sites.
///
/// Raises
/// ------
/// OSError
///     For a file that is not there or cannot be read.
/// ValueError
///     For a file of another format, a site that it does not have, values that are no hazard curve.
#[pyfunction]
#[pyo3(signature = (path, *, site = None, near = None))]
pub(crate) fn read_hazard_export(
    py: Python<'_>,
    path: PathBuf,
    site: Option<String>,
    near: Option<(f64, f64)>,
) -> PyResult<Vec<ExportedCurve>> {
    let selection = match (site, near) {
        (None, None) => SiteSelection::All,
        (Some(name), None) => SiteSelection::Name(name),
        (None, Some((longitude_deg, latitude_deg))) => {
            let on_earth = (-180.0..=360.0).contains(&longitude_deg) && (-90.0..=90.0).contains(&latitude_deg);
            if !on_earth {
                let message = format!("near is ({longitude_deg}, {latitude_deg}): give degrees, longitude first");
                return Err(PyValueError::new_err(message));
            }
            SiteSelection::Nearest { longitude_deg, latitude_deg }
        }
        (Some(_), Some(_)) => return Err(PyValueError::new_err("site and near are given: give one of them")),
    };
    let curves = py.detach(|| read_export(&path, &selection)).map_err(|error| from_hazard_file(error, &path))?;
    let exported = |curve: uplift_hazard::ExportedCurve| {
        Ok(ExportedCurve {
            curve: Py::new(py, HazardCurve { curve: curve.curve })?,
            site: curve.site.name,
            longitude_deg: curve.site.longitude_deg,
            latitude_deg: curve.site.latitude_deg,
            distance_km: curve.distance_km,
            statistic: curve.kind.to_string(),
            investigation_years: curve.investigation_years,
            vs30_m_s: curve.vs30_m_s,
        })
    };
    curves.into_iter().map(exported).collect()
}
