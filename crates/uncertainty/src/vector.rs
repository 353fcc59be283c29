//! Several quantities together.

use crate::{Distribution, GaussianCopula, UncertaintyError};

/// Quantities with their distributions, and how they go together.
#[derive(Debug, Clone, PartialEq)]
pub struct RandomVector {
    distributions: Vec<Distribution>,
    copula: GaussianCopula,
}

impl RandomVector {
    /// Of as many `distributions` as the copula has dimensions.
    ///
    /// # Errors
    /// Another number of them.
    pub fn new(distributions: Vec<Distribution>, copula: GaussianCopula) -> Result<Self, UncertaintyError> {
        if distributions.len() != copula.dimensions() {
            let (found, expected) = (distributions.len(), copula.dimensions());
            return Err(UncertaintyError::Count { found, expected });
        }
        Ok(Self { distributions, copula })
    }

    /// The distributions, one a quantity.
    pub fn distributions(&self) -> &[Distribution] {
        &self.distributions
    }

    /// How they go together.
    pub fn copula(&self) -> &GaussianCopula {
        &self.copula
    }

    /// The values at a `point` of the unit cube, one a quantity.
    pub fn values(&self, point: &[f64]) -> Vec<f64> {
        let correlated = self.copula.correlated(point);
        self.distributions.iter().zip(correlated).map(|(of, uniform)| of.quantile(uniform)).collect()
    }
}
