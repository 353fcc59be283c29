//! Weighted hazard curves of a site: each branch of one measure is repaired by that of the other, where both measures
//! have the same branches.

use uplift_motion::IntensityMeasure;
use uplift_result::StoredBranch;

use super::{Finding, Question};
use crate::error::UniformRiskError;

/// The answers for the branches of a site and the measure that the records are scaled to, one each.
#[derive(Debug, Clone)]
pub struct BranchFindings {
    pub(crate) site: usize,
    /// The measure that the records are scaled to.
    pub(crate) scaled_to: IntensityMeasure,
    pub(crate) names: Vec<String>,
    pub(crate) weights: Vec<f64>,
    /// What each of them asks of the records, repaired.
    pub(crate) findings: Vec<Finding>,
}

impl Question {
    /// The repairs of every site's branches.
    pub(crate) fn findings_of_branches(&self) -> Result<Vec<BranchFindings>, UniformRiskError> {
        let mut found = Vec::new();
        for (scaled_to, levels) in &self.analyses {
            let Some(other) = self.other(*scaled_to) else { continue };
            let set = self.set(*scaled_to, other)?;
            for site in 0..self.sites.len() {
                let Some(pairs) = self.branch_pairs(site, *scaled_to, other) else { continue };
                let findings = pairs
                    .iter()
                    .map(|(own, compared)| {
                        let curves = (&own.curve, &compared.curve);
                        self.finding_of(site, (*scaled_to, levels), other, &set, curves, true)
                    })
                    .collect::<Result<_, UniformRiskError>>()?;
                let names = pairs.iter().map(|(own, _)| own.name.clone()).collect();
                let weights = pairs.iter().map(|(own, _)| own.weight).collect();
                found.push(BranchFindings { site, scaled_to: *scaled_to, names, weights, findings });
            }
        }
        Ok(found)
    }

    /// The sites whose branches are not repaired, since those of the other measure are not the same.
    pub(super) fn branches_apart(&self) -> Vec<String> {
        let mut apart = Vec::new();
        for (scaled_to, _) in &self.analyses {
            let Some(other) = self.other(*scaled_to) else { continue };
            for (site, name) in self.sites.iter().enumerate() {
                let both = self.curve(*scaled_to, site).is_some() && self.curve(other, site).is_some();
                if both
                    && !self.weighted_curves(*scaled_to, site).is_empty()
                    && self.branch_pairs(site, *scaled_to, other).is_none()
                {
                    apart.push(format!(
                        "{name} by {}: its weighted hazard curves are repaired by their mean only: those of {} are not \
                         of the same number, names and weights",
                        scaled_to.label(),
                        other.label()
                    ));
                }
            }
        }
        apart
    }

    fn weighted_curves(&self, measure: IntensityMeasure, site: usize) -> &[StoredBranch] {
        self.branches.get(&(measure, site)).map_or(&[], Vec::as_slice)
    }

    /// The branches of a measure beside those of another; none where there are none, or not the same.
    pub(super) fn branch_pairs(
        &self,
        site: usize,
        scaled_to: IntensityMeasure,
        other: IntensityMeasure,
    ) -> Option<Vec<(&StoredBranch, &StoredBranch)>> {
        let (own, compared) = (self.weighted_curves(scaled_to, site), self.weighted_curves(other, site));
        let is_same = |(own, compared): (&StoredBranch, &StoredBranch)| {
            own.name == compared.name && own.weight.to_bits() == compared.weight.to_bits()
        };
        let same = own.len() == compared.len() && own.iter().zip(compared).all(is_same);
        (same && !own.is_empty()).then(|| own.iter().zip(compared).collect())
    }
}
