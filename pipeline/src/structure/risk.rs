//! A structure under the records of a study: how often it goes too far.

use serde::Serialize;
use uplift_hazard::probability_from_rate;
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};

use crate::error::UpliftError;
use crate::uniform_risk::{Stripes, pooled_demand};

/// How often something happens to a structure at a site.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EventRisk {
    /// Mean annual frequency, 1/yr (Eq. 4.4).
    pub per_year: f64,
    /// Probability that it happens within the years of the study, 0 to 1 (Eq. 4.8 inverted).
    pub probability: f64,
    /// Share of the frequency that comes from below the first stripe, 0 to 1; 0 where it never happens.
    pub lower_tail_share: f64,
    /// Share of the frequency that comes from above the last stripe, 0 to 1; 0 where it never happens.
    pub upper_tail_share: f64,
}

impl EventRisk {
    /// From the shares and their sum, both 1/yr.
    ///
    /// # Errors
    /// Numbers that are no rate and no time, which the checks of study and inputs rule out.
    pub(super) fn new(per_year: f64, [lower_tail, upper_tail]: [f64; 2], years: f64) -> Result<Self, UpliftError> {
        let share = |tail: f64| if per_year > 0.0 { (tail / per_year).min(1.0) } else { 0.0 };
        let probability = probability_from_rate(per_year, years)?;
        Ok(Self { per_year, probability, lower_tail_share: share(lower_tail), upper_tail_share: share(upper_tail) })
    }

    /// The larger of the shares from the tails.
    pub fn tail_share(&self) -> f64 {
        self.lower_tail_share.max(self.upper_tail_share)
    }
}

/// A threshold that nothing but overturning exceeds.
pub(super) const OVERTURNING_M: f64 = f64::MAX;

/// The risk of exceeding `threshold_m`.
///
/// # Errors
/// Stripes and weights of different levels; a threshold that is none.
pub(super) fn risk_of_exceeding(
    demand: &PooledDemand,
    weights: &StripeWeights,
    threshold_m: f64,
    years: f64,
) -> Result<EventRisk, UpliftError> {
    let curve = RiskCurve::new(demand, weights)?;
    let per_year = curve.mean_annual_frequency(threshold_m)?;
    let parts = curve.disaggregation(threshold_m)?;
    EventRisk::new(per_year, [parts.lower_tail_per_year, parts.upper_tail_per_year], years)
}

/// All demands of one oscillator of `stripes`, sorted.
///
/// # Errors
/// None for stripes that were computed.
pub(super) fn demand_of(stripes: &Stripes, oscillator: usize) -> Result<PooledDemand, UpliftError> {
    pooled_demand(stripes, oscillator)
}
