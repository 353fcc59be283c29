//! Whether computed peaks are distributed as measured ones (Section 6.8 of Reggiani Manzo's dissertation, and beyond).
//!
//! | module | what is in it |
//! |---|---|
//! | [`sample`] | values of one kind, with collapses as +∞ |
//! | [`kolmogorov_smirnov`] | the distance of two distributions, with p by three rules; Table 6.1's words for it |
//! | [`anderson_darling`] | its weighted square, for samples with and without ties |
//! | [`cramer_von_mises`] | its square, with p exact or in the limit |
//! | [`mann_whitney`] | whether one tends to be larger |
//! | [`distance`] | energy distance and Wasserstein's |
//! | [`pairs`] | motion by motion: bias, dispersion, correlation, collapses |
//! | [`band`] | pointwise and simultaneous bands of an empirical distribution |
//! | [`resampling`] | bands of medians' ratio, bias and dispersion; the permutation test within pairs |
//! | [`power`] | how large a difference the test would have seen |
//! | [`holm`] | p of several tests at once |
//!
//! A collapse is +∞ in every statistic: it has a rank and a place in a distribution, never a NaN, and is never dropped.
//! What has no meaning with infinite values, a mean distance, is none.
//!
//! ```
//! use uplift_validation::{Evidence, KolmogorovSmirnov, Sample};
//! let measured = Sample::new(vec![0.02, 0.05, 0.07, 0.11, f64::INFINITY])?;
//! let computed = Sample::new(vec![0.03, 0.04, 0.09, 0.16, f64::INFINITY])?;
//! let test = KolmogorovSmirnov::from_samples(&measured, &computed);
//! assert_eq!(Evidence::from_p(test.p_exact), Evidence::SmallOrNone);
//! # Ok::<(), uplift_validation::ValidationError>(())
//! ```

pub mod anderson_darling;
pub mod band;
pub mod cramer_von_mises;
pub mod distance;
mod error;
pub mod holm;
pub mod kolmogorov_smirnov;
pub mod mann_whitney;
pub mod pairs;
pub mod power;
pub mod resampling;
pub mod sample;

pub use anderson_darling::AndersonDarling;
pub use band::{BandRule, bootstrap_band, dkw_half_width, greenwood_band};
pub use cramer_von_mises::CramerVonMises;
pub use distance::{energy_distance, wasserstein_distance};
pub use error::ValidationError;
pub use holm::holm_adjusted;
pub use kolmogorov_smirnov::{Evidence, KolmogorovSmirnov, kstest2_p};
pub use mann_whitney::MannWhitney;
pub use pairs::{Collapses, Pairs};
pub use power::{MOST_DRAWN, detectable_factor};
pub use resampling::{Bands, Quantiles, Resampling, bands, median_ratio_band, permutation_p};
pub use sample::Sample;
