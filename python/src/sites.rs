//! The hazard of sites, met by demands.

use pyo3::exceptions::{PyKeyboardInterrupt, PyTypeError};
use pyo3::prelude::*;
use rayon::prelude::*;
use uplift_hazard::Extrapolation;
use uplift_ida::Watch;
use uplift_risk::{PooledDemand, StripeWeights};

use crate::cores::on_all_cores;
use crate::demand::Demand;
use crate::errors::refused;
use crate::hazard::HazardCurve;

/// What the hazard of each site makes of each level.
pub(crate) struct Sites {
    weights: Vec<StripeWeights>,
    /// Whether several were asked for, so that the result has an axis of them.
    is_sequence: bool,
}

impl Sites {
    pub(crate) fn new(
        hazard: &Bound<'_, PyAny>,
        levels: &[f64],
        extrapolation: Extrapolation,
        gravity_m_s2: f64,
    ) -> PyResult<Self> {
        let weights = |curve: &Bound<'_, HazardCurve>| {
            let curve = curve.get().curve.in_field_units(gravity_m_s2).map_err(refused)?;
            StripeWeights::from_hazard(&curve, levels, extrapolation).map_err(refused)
        };
        if let Ok(curve) = hazard.cast::<HazardCurve>() {
            return Ok(Self { weights: vec![weights(curve)?], is_sequence: false });
        }
        let no_curve = || PyTypeError::new_err("hazard must be a HazardCurve, or a sequence of them");
        let site = |curve: PyResult<Bound<'_, PyAny>>| match curve?.cast::<HazardCurve>() {
            Ok(curve) => weights(curve),
            Err(_) => Err(no_curve()),
        };
        let curves = hazard.try_iter().map_err(|_| no_curve())?;
        Ok(Self { weights: curves.map(site).collect::<PyResult<_>>()?, is_sequence: true })
    }

    /// The axis of sites in front of others, where there is one.
    pub(crate) fn shape_with(&self, others: &[usize]) -> Vec<usize> {
        self.is_sequence.then_some(self.weights.len()).iter().chain(others).copied().collect()
    }

    /// What `of_both` makes of each oscillator at each site, `[site][strength]`: each oscillator is sorted once and
    /// serves every site.
    pub(crate) fn map_each<T: Send>(
        &self,
        py: Python<'_>,
        demand: &Demand,
        of_both: impl Fn(&PooledDemand, &StripeWeights) -> PyResult<Vec<T>> + Sync,
    ) -> PyResult<Vec<Vec<Vec<T>>>> {
        let mut sites: Vec<Vec<Vec<T>>> = self.weights.iter().map(|_| Vec::new()).collect();
        let by_strength = on_all_cores(py, |interruption| {
            let of_strength = |system: usize| {
                let pooled = demand.pooled(system)?;
                let of_site = |weights: &StripeWeights| {
                    if interruption.cancelled() {
                        return Err(PyKeyboardInterrupt::new_err(()));
                    }
                    of_both(&pooled, weights)
                };
                self.weights.iter().map(of_site).collect::<PyResult<Vec<_>>>()
            };
            (0..demand.systems()).into_par_iter().map(of_strength).collect::<PyResult<Vec<_>>>()
        })?;
        for of_sites in by_strength {
            for (site, of_strength) in sites.iter_mut().zip(of_sites) {
                site.push(of_strength);
            }
        }
        Ok(sites)
    }
}
