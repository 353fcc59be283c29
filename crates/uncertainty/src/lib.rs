//! Quantities that are not known exactly: how they are distributed, how they are sampled, and what a result owes to
//! each of them. Nothing here knows of structures or records.
//!
//! - [`Distribution`]: one quantity: lognormal, normal, uniform or triangular, within the range that it can have.
//! - [`GaussianCopula`]: how several of them go together.
//! - [`unit_cube`]: points that fill the unit cube evenly, by [`Sampling::LatinHypercube`] or [`Sampling::Sobol`].
//! - [`RandomVector`]: the three together: from a point of the unit cube to values.
//! - [`sobol_indices`]: which share of a result's variance each factor makes.
//!
//! ```
//! use uplift_uncertainty::{Distribution, Family, GaussianCopula, RandomVector, Sampling, unit_cube};
//!
//! let strength = Distribution::from_mean(Family::Lognormal, (0.1, 0.2), [0.0, 100.0])?;
//! let restitution = Distribution::from_limits([0.9, 0.98], Some(0.95), [0.0, 1.0])?;
//! let structure = RandomVector::new(vec![strength, restitution], GaussianCopula::new(2, &[(0, 1, 0.3)])?)?;
//! let points = unit_cube(Sampling::Sobol, (64, 2), 1)?;
//! let values: Vec<Vec<f64>> = points.chunks_exact(2).map(|point| structure.values(point)).collect();
//! assert!(values.iter().all(|values| values[0] > 0.0 && (0.9..=0.98).contains(&values[1])));
//! # Ok::<(), uplift_uncertainty::UncertaintyError>(())
//! ```

mod copula;
mod distribution;
mod error;
mod random;
mod sampling;
mod sensitivity;
mod sobol;
mod vector;

pub use copula::GaussianCopula;
pub use distribution::{Distribution, Family};
pub use error::UncertaintyError;
pub use sampling::{MOST_DIMENSIONS, Sampling, unit_cube};
pub use sensitivity::{Estimate, SobolIndices, sobol_indices};
pub use vector::RandomVector;
