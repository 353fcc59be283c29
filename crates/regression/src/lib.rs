//! The analytical approximation of a uniform risk spectrum, u(η) = c0 exp(c1 η) + c2 (Eq. 4.11), by least
//! squares with c2 ≥ 0.
//!
//! [`fit`] returns the global minimum in a stated range of c1 as an [`ExponentialFit`]: the coefficients, the errors
//! and whether the bound on c2 or the end of the range holds the solution. [`Exponential`] is the curve itself, to
//! evaluate. [`fit_line`] is the straight line with the test of its slope, for residuals against what the records are.
//!
//! ```
//! use uplift_regression::{Exponential, fit};
//!
//! let curve = Exponential { c0: 0.2022, c1: -12.598, c2: 0.0009 };
//! let strengths: Vec<f64> = (16..=300).map(|i| f64::from(i) / 300.0).collect();
//! let displacements_m: Vec<f64> = strengths.iter().map(|&eta| curve.at(eta)).collect();
//! let found = fit(&strengths, &displacements_m)?;
//! assert!((found.c1 - curve.c1).abs() < 1e-9);
//! # Ok::<(), uplift_regression::RegressionError>(())
//! ```
//!
//! # Source
//! N. Reggiani Manzo, dissertation, Section 4.6. The idea of removing the linear coefficients: G. H. Golub and V.
//! Pereyra (1973), SIAM Journal on Numerical Analysis 10, 413–432.

mod error;
mod fit;
mod line;
mod reduced;
mod root;

pub use error::RegressionError;
pub use fit::{Exponential, ExponentialFit, fit};
pub use line::{Line, fit_line};
