//! Displacements that are handed over, as the stripes of each oscillator.

use numpy::ndarray::ArrayD;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use uplift_fragility::Stripes;
use uplift_risk::PooledDemand;

use crate::errors::refused;
use crate::floats::{floats, list};

/// Peak displacements of one oscillator, or of one a strength, with their levels.
pub(crate) struct Demand {
    edp_m: Vec<f64>,
    levels: Vec<f64>,
    records: usize,
    /// None where the array has no such axis.
    strengths: Option<usize>,
}

impl Demand {
    /// From arrays `[record, level]` or `[record, strength, level]`, m, and `[level]`.
    ///
    /// # Errors
    /// `ValueError` for other shapes, levels that do not ascend, displacements that are negative or NaN.
    pub(crate) fn new(edp_m: &Bound<'_, PyAny>, levels: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (edp_m, levels): (ArrayD<f64>, _) = (floats("edp_m", edp_m)?, list("levels", levels)?);
        let (records, strengths) = match *edp_m.shape() {
            [records, of_each] if of_each == levels.len() => (records, None),
            [records, strengths, of_each] if of_each == levels.len() => (records, Some(strengths)),
            _ => {
                return Err(PyValueError::new_err(format!(
                    "edp_m has the shape {:?}: with {} levels it must be (records, {1}) or (records, strengths, {1})",
                    edp_m.shape(),
                    levels.len()
                )));
            }
        };
        if strengths == Some(0) {
            return Err(PyValueError::new_err("edp_m has no strength: give at least one"));
        }
        let demand = Self { edp_m: edp_m.into_raw_vec_and_offset().0, levels, records, strengths };
        for strength in 0..demand.systems() {
            demand.stripes(strength)?;
        }
        Ok(demand)
    }

    /// Oscillators.
    pub(crate) fn systems(&self) -> usize {
        self.strengths.unwrap_or(1)
    }

    /// Records.
    pub(crate) fn records(&self) -> usize {
        self.records
    }

    /// Levels of the stripes, ascending.
    pub(crate) fn levels(&self) -> &[f64] {
        &self.levels
    }

    /// The axis of strengths in front of others, where there is one.
    pub(crate) fn shape_with(&self, others: &[usize]) -> Vec<usize> {
        self.strengths.iter().chain(others).copied().collect()
    }

    /// The axis of strengths behind others, where there is one.
    pub(crate) fn shape_after(&self, others: &[usize]) -> Vec<usize> {
        others.iter().copied().chain(self.strengths).collect()
    }

    /// The stripes of one oscillator.
    pub(crate) fn stripes(&self, system: usize) -> PyResult<Stripes<'_>> {
        let from = (system * self.levels.len()).min(self.edp_m.len());
        let stride = self.systems() * self.levels.len();
        Stripes::strided(&self.levels, &self.edp_m[from..], self.records, stride).map_err(refused)
    }

    /// The demands of one oscillator, sorted.
    pub(crate) fn pooled(&self, system: usize) -> PyResult<PooledDemand> {
        PooledDemand::new(&self.stripes(system)?).map_err(refused)
    }
}
