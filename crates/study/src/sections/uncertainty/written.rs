//! The section `[uncertainty]` as a study file has it.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use uplift_uncertainty::Family;

use super::{Uncertainty, UncertaintyKind};

/// How a quantity was said to be distributed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Written {
    pub(super) family: Family,
    pub(super) scatter: Scatter,
}

/// What of a distribution was given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scatter {
    /// The mean, unless it is the value that the quantity has, and the coefficient of variation.
    Mean { mean: Option<f64>, coefficient_of_variation: f64 },
    /// Two percentages with their values.
    Percentiles([(f64, f64); 2]),
    /// Limits, and the mode of a triangular one.
    Limits { limits: [f64; 2], mode: Option<f64> },
}

impl Serialize for Written {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("distribution", self.family.key())?;
        match self.scatter {
            Scatter::Mean { mean, coefficient_of_variation } => {
                if let Some(mean) = mean {
                    map.serialize_entry("mean", &mean)?;
                }
                map.serialize_entry("coefficient_of_variation", &coefficient_of_variation)?;
            }
            Scatter::Percentiles(percentiles) => map.serialize_entry("percentiles", &percentiles)?,
            Scatter::Limits { limits: [lower, upper], mode } => {
                map.serialize_entry("lower", &lower)?;
                map.serialize_entry("upper", &upper)?;
                if let Some(mode) = mode {
                    map.serialize_entry("mode", &mode)?;
                }
            }
        }
        map.end()
    }
}

#[derive(Serialize)]
struct Correlation {
    between: [&'static str; 2],
    coefficient: f64,
}

impl Serialize for Uncertainty {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("kind", self.kind.key())?;
        map.serialize_entry("sampling", self.sampling.key())?;
        match self.kind {
            UncertaintyKind::Epistemic => map.serialize_entry("samples", &self.samples)?,
            UncertaintyKind::Aleatory => map.serialize_entry("draws", &self.draws)?,
        }
        map.serialize_entry("seed", &self.seed)?;
        for (quantity, written) in self.quantities.iter().zip(&self.written) {
            map.serialize_entry(quantity.key(), written)?;
        }
        let correlation = |&(first, second, coefficient): &(usize, usize, f64)| Correlation {
            between: [self.quantities[first].key(), self.quantities[second].key()],
            coefficient,
        };
        if !self.correlations.is_empty() {
            map.serialize_entry("correlation", &self.correlations.iter().map(correlation).collect::<Vec<_>>())?;
        }
        map.end()
    }
}
