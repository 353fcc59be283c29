//! What the runs of a structure weigh at a site: records that count alike, or weights by which they bring its hazard.

use uplift_risk::{PooledDemand, RiskCurve, RiskError, RunWeights, StripeWeights};

/// What the runs of a structure weigh at a site.
#[derive(Debug, Clone, Copy)]
pub(super) enum SiteWeights<'a> {
    /// Every record of a stripe alike.
    Alike(&'a StripeWeights),
    /// As a repair says ([hazard consistency](crate::consistency)).
    Repaired(&'a RunWeights),
}

impl<'a> SiteWeights<'a> {
    /// The risk curve of a `demand`.
    ///
    /// # Errors
    /// Weights of other levels or records.
    pub(super) fn curve(&self, demand: &'a PooledDemand) -> Result<RiskCurve<'a>, RiskError> {
        match self {
            Self::Alike(stripes) => RiskCurve::new(demand, stripes),
            Self::Repaired(weights) => RiskCurve::weighted(demand, weights),
        }
    }

    /// What the hazard makes of each stripe.
    pub(super) fn stripes(&self) -> &'a StripeWeights {
        match self {
            Self::Alike(stripes) => stripes,
            Self::Repaired(weights) => weights.stripes(),
        }
    }

    /// To how many records that count alike `records` amount at the last level, 1/Σp².
    pub(super) fn effective_records(&self, records: usize) -> f64 {
        match self {
            Self::Alike(_) => records as f64,
            Self::Repaired(weights) => {
                let shares = weights.shares();
                let last = &shares[shares.len().saturating_sub(weights.record_count())..];
                1.0 / last.iter().map(|share| share * share).sum::<f64>()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn records_that_weigh_little_count_little() {
        let stripes = StripeWeights::new(&[1.0, 0.5], None).unwrap();
        let repaired = RunWeights::new(&stripes, &[0.5, 0.5, 0.0, 0.25, 0.75, 0.0]).unwrap();
        assert!((SiteWeights::Repaired(&repaired).effective_records(3) - 1.6).abs() < 1e-12);
        assert!((SiteWeights::Alike(&stripes).effective_records(3) - 3.0).abs() < 1e-12);
    }
}
