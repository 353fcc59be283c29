//! What each run weighs at a site: records count alike, or by the weights of a repair.

use crate::{PooledDemand, RiskCurve, RiskError, RunWeights, StripeWeights};

/// What each run weighs at a site.
#[derive(Debug, Clone, Copy)]
pub enum SiteWeights<'a> {
    /// Its share of what the stripe weighs: that of the demand, or the same for all records.
    Alike(&'a StripeWeights),
    /// Its own weight, by which the records match the hazard of another measure.
    Repaired(&'a RunWeights),
}

impl<'a> From<&'a StripeWeights> for SiteWeights<'a> {
    fn from(stripes: &'a StripeWeights) -> Self {
        Self::Alike(stripes)
    }
}

impl<'a> From<&'a RunWeights> for SiteWeights<'a> {
    fn from(weights: &'a RunWeights) -> Self {
        Self::Repaired(weights)
    }
}

impl<'a> SiteWeights<'a> {
    /// The weights of a repair, if there are any, else those of the stripes.
    pub fn new(stripes: &'a StripeWeights, repaired: Option<&'a RunWeights>) -> Self {
        repaired.map_or(Self::Alike(stripes), Self::Repaired)
    }

    /// The risk curve of a `demand`.
    ///
    /// # Errors
    /// Demand and weights of other levels or records.
    pub fn curve(&self, demand: &'a PooledDemand) -> Result<RiskCurve<'a>, RiskError> {
        match self {
            Self::Alike(stripes) => RiskCurve::new(demand, stripes),
            Self::Repaired(weights) => RiskCurve::weighted(demand, weights),
        }
    }

    /// The weights of the stripes.
    pub fn stripes(&self) -> &'a StripeWeights {
        match self {
            Self::Alike(stripes) => stripes,
            Self::Repaired(weights) => weights.stripes(),
        }
    }

    /// The weights of a repair; none without one.
    pub fn repaired(&self) -> Option<&'a RunWeights> {
        match self {
            Self::Alike(_) => None,
            Self::Repaired(weights) => Some(weights),
        }
    }

    /// Effective number of pairs at the last level: 1/Σp², with the share p of a pair. Two records of one pair tell
    /// little more than one does.
    ///
    /// - `pairs`: the positions of the records of each pair, `[pair]`.
    ///
    /// # Panics
    /// At a position that no record has, which is a bug of the caller.
    pub fn effective_pairs(&self, pairs: &[Vec<usize>]) -> f64 {
        match self {
            Self::Alike(_) => pairs.len() as f64,
            Self::Repaired(weights) => {
                let shares = weights.shares();
                let last = &shares[shares.len().saturating_sub(weights.record_count())..];
                let of_pair = |pair: &Vec<usize>| pair.iter().map(|&record| last[record]).sum::<f64>();
                1.0 / pairs.iter().map(of_pair).map(|share| share * share).sum::<f64>()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_that_weigh_little_count_little() {
        let stripes = StripeWeights::new(&[1.0, 0.5], None).unwrap();
        let repaired = RunWeights::new(&stripes, &[0.5, 0.5, 0.0, 0.25, 0.75, 0.0]).unwrap();
        let alone = [vec![0], vec![1], vec![2]];
        assert!((SiteWeights::Repaired(&repaired).effective_pairs(&alone) - 1.6).abs() < 1e-12);
        assert_eq!(SiteWeights::Alike(&stripes).effective_pairs(&alone), 3.0);
    }

    #[test]
    fn records_of_one_pair_count_as_one() {
        let stripes = StripeWeights::new(&[1.0, 0.5], None).unwrap();
        // at the last level 1/4 and 1/4 of one pair, 1/2 and 0 of the other
        let repaired = RunWeights::new(&stripes, &[0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.5, 0.0]).unwrap();
        let pairs = [vec![0, 1], vec![2, 3]];
        assert_eq!(SiteWeights::Repaired(&repaired).effective_pairs(&pairs), 2.0);
        assert_eq!(SiteWeights::Alike(&stripes).effective_pairs(&pairs), 2.0);
    }
}
