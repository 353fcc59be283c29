//! What the stripes weigh at a site: by its mean hazard curve, and by each of the curves that may hold.

use uplift_result::ResultFile;
use uplift_risk::StripeWeights;
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult, branch_weights};

use crate::error::DesignError;

#[derive(Debug, Clone)]
pub(super) struct Hazard<'a> {
    /// By the mean curve.
    pub(super) mean: &'a StripeWeights,
    /// Weighted alternatives to it; none where there is but one curve.
    pub(super) branches: Vec<(f64, StripeWeights)>,
}

impl<'a> Hazard<'a> {
    /// At a site of a result, by its position.
    pub(super) fn from_file(
        file: &ResultFile,
        source: &StudyOfResult,
        (measure, site): (&'a SpectraOfResult, usize),
    ) -> Result<Self, DesignError> {
        let branches = branch_weights(file, &source.sites[site], &measure.plan, source.study.risk.extrapolate)?;
        Ok(Self { mean: &measure.weights[site], branches })
    }

    /// The same where only the stripes at these `places` are analysed, whose weights by the mean curve are `mean`.
    pub(super) fn at_levels<'b>(&self, mean: &'b StripeWeights, places: &[usize]) -> Result<Hazard<'b>, DesignError> {
        let of_branch = |(weight, stripes): &(f64, StripeWeights)| Ok((*weight, stripes.at_levels(places)?));
        Ok(Hazard { mean, branches: self.branches.iter().map(of_branch).collect::<Result<_, DesignError>>()? })
    }

    /// The branch that a `number` between 0 and 1 chooses; the mean where there are no branches.
    pub(super) fn at(&self, number: f64) -> &StripeWeights {
        let total: f64 = self.branches.iter().map(|(weight, _)| weight).sum();
        let mut before = 0.0;
        for (weight, weights) in &self.branches {
            before += weight;
            if number * total < before {
                return weights;
            }
        }
        self.branches.last().map_or(self.mean, |(_, weights)| weights)
    }
}
