//! Fragility: the probability that a structure exceeds a displacement, given the intensity of the ground motion.
//!
//! The demands of one oscillator come as [`Stripes`]: every record scaled to every level of an intensity measure.
//! The fragility of record is the empirical one, Eq. 4.7 of the dissertation: the share of the records that exceed
//! the threshold, level by level ([`exceedance_probabilities`] for one threshold, [`EmpiricalFragility`] for many).
//! No curve is inverted: the response of rocking structures weaves, so a record may exceed a threshold at one
//! level and stay below it at the next.
//!
//! How much the demands scatter at a level, and whether that depends on what the records are, shows how good the
//! intensity measure is: [`Dispersion`], [`uplift_levels`], [`mean_residuals`].
//!
//! Beside it, never instead of it, [`fit_lognormal`] gives the maximum-likelihood lognormal fragility, and
//! [`fit_zero_inflated`] one for demands of which many are zero; [`Goodness`] has their agreement with the counts,
//! [`lognormal_spread`] the uncertainty of the parameters. [`fit_surface`] takes two intensity measures together.
//! [`nrml_model`] and [`pelicun_table`] write fragilities for `OpenQuake` and pelicun.
//!
//! ```
//! use uplift_fragility::{Stripes, exceedance_probabilities};
//!
//! let levels_cm_s = [10.0, 20.0, 40.0];
//! let edp_m = [0.001, 0.02, f64::INFINITY, // record 0 overturns at the last level
//!              0.000, 0.03, 0.1];          // record 1
//! let stripes = Stripes::new(&levels_cm_s, &edp_m)?;
//! assert_eq!(exceedance_probabilities(&stripes, 0.02)?, [0.0, 0.5, 1.0]);
//! # Ok::<(), uplift_fragility::FragilityError>(())
//! ```
//!
//! # Source
//! N. Reggiani Manzo, dissertation, Section 4.3.3.

mod dispersion;
mod empirical;
mod error;
mod function;
mod goodness;
mod lognormal;
mod normal;
mod nrml;
mod pelicun;
mod quantile;
mod spread;
mod stripes;
mod surface;
mod zero_inflated;

pub use dispersion::{Dispersion, mean_residuals, standard_deviation, uplift_levels};
pub use empirical::{EmpiricalFragility, check_threshold, exceedance_counts, exceedance_probabilities};
pub use error::FragilityError;
pub use function::{FragilityFunction, FragilityState, plain_id};
pub use goodness::Goodness;
pub use lognormal::{LognormalFit, LognormalFragility, StripeCount, fit_lognormal, fits_without_each, stripe_counts};
pub use normal::{ln_normal_cdf, normal_cdf, normal_quantile};
pub use nrml::nrml_model;
pub use pelicun::{PELICUN_COLUMN, PelicunDemand, TextColumn, pelicun_demand, pelicun_table};
pub use quantile::{quantile, weighted_quantile};
pub use spread::{FitSpread, lognormal_spread};
pub use stripes::Stripes;
pub use surface::{FragilitySurface, SurfaceFit, SurfaceTrial, fit_surface};
pub use zero_inflated::{ZeroInflatedFragility, fit_zero_inflated};
