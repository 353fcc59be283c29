//! The risk integral: from stripes of demand and a hazard curve to the ordinates of a uniform risk spectrum.
//!
//! - [`StripeWeights`]: what one site's hazard makes of each stripe (Eq. 4.4 by the trapezoid rule).
//! - [`PooledDemand`]: all demands of one oscillator, sorted once, shared by every site, probability and resample.
//! - [`RiskCurve`]: the two together, λ(c), the mean annual frequency of exceeding a displacement c; its ordinates are
//!   [`RiskCurve::exact_ordinate`] and [`RiskCurve::grid_ordinate`].
//! - [`RecordSample`]: which records count, and how often: a bootstrap replicate.
//! - [`RunWeights`]: records that do not count alike, each with its share at every level; [`SiteWeights`]: these, or
//!   those of the stripes alone.
//! - [`ResamplingTable`]: the same ordinates for thousands of samples.
//! - [`ReplicateWeights`]: the same for samples whose records are weighed anew, a few at once.
//! - [`EventRisk`]: how often something happens to a structure.
//! - [`StrengthPlace`]: a spectrum read between its strengths.
//! - [`lognormal_risk`]: the risk integral of a lognormal fragility, exact on a log–log hazard curve.
//!
//! λ(c) is linear in the stripe fragilities, and these are counts (Eq. 4.7). So λ(c) = Σ w(level) m(record)/n over the
//! runs with EDP > c: a right-continuous step function that falls at the demands, and an ordinate of the uniform risk
//! spectrum is a weighted quantile of the pooled demands.
//!
//! **Rounding.** Rates are added in fixed point, as 128-bit integers. Such sums do not depend on their order:
//! permuted records, tied demands and a record drawn twice or written twice give the same bits, and "λ(c) ≤ target"
//! is decided without rounding error.
//!
//! ```
//! use uplift_fragility::Stripes;
//! use uplift_hazard::{Extrapolation, HazardCurve};
//! use uplift_risk::{OrdinateFlag, PooledDemand, RiskCurve, StripeWeights};
//!
//! let levels_cm_s = [1.0, 10.0, 100.0];
//! let edp_m = [0.0, 0.1, 0.8, // record 0
//!              0.0, 0.2, 0.6]; // record 1
//! let demand = PooledDemand::new(&Stripes::new(&levels_cm_s, &edp_m)?)?;
//!
//! let hazard = HazardCurve::new("PGV", "cm/s", "example", vec![0.5, 10.0, 100.0], vec![0.5, 0.1, 0.001])?;
//! let weights = StripeWeights::from_hazard(&hazard, &levels_cm_s, Extrapolation::Refuse)?;
//!
//! let ordinate = RiskCurve::new(&demand, &weights)?.exact_ordinate(0.1)?;
//! assert_eq!(ordinate.displacement_m, 0.2);
//! assert_eq!(ordinate.flag, OrdinateFlag::Regular);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Source
//! N. Reggiani Manzo, dissertation, Sections 4.3.3 to 4.4.

mod curve;
mod demand;
mod disaggregation;
mod error;
mod event_risk;
mod fixed_point;
mod grid;
mod lognormal;
mod ordinate;
mod replicate_weights;
mod resampling;
mod risk_targeted;
mod run_weights;
mod sample;
mod site_weights;
mod strength_place;
mod stretches;
mod weights;

pub use curve::RiskCurve;
pub use demand::PooledDemand;
pub use disaggregation::Disaggregation;
pub use error::{RiskError, check_count, check_target};
pub use event_risk::{BOUND_CONFIDENCE, EventRisk, at_most_per_year, share_at_most};
pub use grid::ThresholdGrid;
pub use lognormal::{LognormalRisk, lognormal_risk};
pub use ordinate::{
    BEYOND_LIMIT, COMPARED_FROM_M, DECISIVE_SHARE, FEW_RECORDS, MEASURES_APART, MEASURES_APART_DECISIVE, Ordinate,
    OrdinateFlag, TAIL_SHARE_LIMIT,
};
pub use replicate_weights::{REPLICATES_AT_ONCE, ReplicateWeights};
pub use resampling::ResamplingTable;
pub use risk_targeted::{RiskTargetedLevel, risk_targeted_level};
pub use run_weights::RunWeights;
pub use sample::RecordSample;
pub use site_weights::SiteWeights;
pub use strength_place::StrengthPlace;
pub use weights::{StripeWeights, mean_annual_frequency};
