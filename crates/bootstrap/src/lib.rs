//! How sure a uniform risk spectrum is: the bootstrap over records of Section 4.5, and the influence of single records.
//!
//! - [`ResamplingPlan`]: which records each replicate draws; planned before any computing, from counter-based streams.
//! - [`Unit`]: whether records are drawn one by one, or earthquakes with all their records ([`units`]);
//!   [`is_too_narrow`]: where a band by record is not to be quoted.
//! - [`Replicates`]: the ordinates of one strength for all replicates, sites and probabilities.
//! - [`weighted_replicates`]: the same where the records of each replicate are weighed anew.
//! - [`Interval`], [`Band`]: confidence intervals of an ordinate, by percentiles or bias-corrected and
//!   accelerated (BCa).
//! - [`inferred_limits`]: the band of the spectrum of all records there could be, and that of another set's, without
//!   resampling; [`inferred_rate`]: the same of the rate at which something is exceeded.
//! - [`inferred_limits_over_curves`], [`inferred_rate_over_curves`]: the same where there are weighted hazard curves.
//! - [`inferred_mean`], [`inferred_mean_over_alternatives`]: the same of a rate of which each record's part is known,
//!   [`inferred_weighted_rate`] of one by the weights of a repair;
//!   [`falling`], [`crossing`]: the value at which such a rate meets a target.
//! - [`simultaneous_bands`]: a band that holds whole spectra.
//! - [`error_of_median`], [`range_of_interval`]: the two figures of Table 4.1 (Eq. 4.9, 4.10).
//! - [`without_each`]: the ordinates without each record, for influence and for BCa.
//!
//! One replicate rebuilds the whole spectrum: the same draw serves all strengths, sites, probabilities and intensity
//! measures (common random numbers), so differences between them are not blurred by the resampling.
//!
//! # Source
//! N. Reggiani Manzo, dissertation, Section 4.5; B. Efron and R. J. Tibshirani, An Introduction to the Bootstrap
//! (1993), chapters 13 and 14; global rank envelopes: M. Myllymäki et al., J. R. Stat. Soc. B 79 (2017).

mod accuracy;
mod calibration;
mod error;
mod falling;
mod inferred;
mod interval;
mod inversion;
mod jackknife;
mod over_curves;
mod plan;
mod rates;
mod replicates;
mod shared_rates;
mod simultaneous;
mod skewed_mean;
mod spread;
mod unit;
mod unit_rates;
mod walk;
mod weighted;
mod weighted_replicates;

pub use accuracy::{error_of_median, range_of_interval};
pub use error::BootstrapError;
pub use falling::{crossing, falling};
pub use inferred::{
    InferredLimits, QUOTED_CONFIDENCE, inferred_limits, inferred_mean, inferred_rate, inferred_weighted_rate,
    truth_limits,
};
pub use interval::{Band, Interval};
pub use jackknife::{acceleration, contributions, without_each};
pub use over_curves::{inferred_limits_over_curves, inferred_mean_over_alternatives, inferred_rate_over_curves};
pub use plan::ResamplingPlan;
pub use replicates::Replicates;
pub use simultaneous::simultaneous_bands;
pub use skewed_mean::{SkewedMean, StudentQuantiles};
pub use unit::{Unit, is_too_narrow, units, units_in_sample};
pub use weighted::weighted_quantile;
pub use weighted_replicates::{SORTED_AT_ONCE, left_out, left_out_together, weighted_replicates};
