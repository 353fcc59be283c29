//! The section `[uncertainty]` as a study file has it.

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use uplift_uncertainty::Family;

use super::{Uncertainty, UncertaintyKind};

/// How a quantity was said to be distributed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Written {
    #[serde(rename = "distribution", serialize_with = "write_family")]
    pub(super) family: Family,
    #[serde(flatten)]
    pub(super) scatter: Scatter,
}

/// What of a distribution was given.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub(super) enum Scatter {
    /// The mean, unless it is the value that the quantity has, and the coefficient of variation.
    Mean {
        #[serde(skip_serializing_if = "Option::is_none")]
        mean: Option<f64>,
        coefficient_of_variation: f64,
    },
    /// Two percentages with their values.
    Percentiles { percentiles: [(f64, f64); 2] },
    /// Limits, and the mode of a triangular one.
    Limits {
        lower: f64,
        upper: f64,
        #[serde(skip_serializing_if = "Option::is_none")]
        mode: Option<f64>,
    },
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
fn write_family<S: Serializer>(family: &Family, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(family.key())
}

#[derive(Serialize)]
struct Correlation {
    between: [&'static str; 2],
    coefficient: f64,
}

impl Serialize for Uncertainty {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry(super::KIND.name, self.kind.key())?;
        map.serialize_entry(super::SAMPLING.name, self.sampling.key())?;
        match self.kind {
            UncertaintyKind::Epistemic => map.serialize_entry(super::SAMPLES.name, &self.samples)?,
            UncertaintyKind::Aleatory => map.serialize_entry(super::DRAWS.name, &self.draws)?,
        }
        map.serialize_entry(super::SEED.name, &self.seed)?;
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
