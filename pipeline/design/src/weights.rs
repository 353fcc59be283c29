//! Weights that make the motions of a result match the hazard of its sites.

use uplift_result::ResultFile;
use uplift_risk::RunWeights;
use uplift_uniform_risk::SpectraOfResult;
use uplift_uniform_risk::consistency::Reweighing;

use crate::error::DesignError;

pub(super) struct RepairedWeights(Option<Reweighing>);

impl RepairedWeights {
    /// Those of the motions of a result, each once.
    pub(super) fn from_file(file: &ResultFile) -> Result<Self, DesignError> {
        Ok(Self(Reweighing::from_motions(file)?))
    }

    /// Those by one measure at the site at this position; none where there is no repair.
    pub(super) fn at(&self, measure: &SpectraOfResult, site: usize) -> Option<&RunWeights> {
        self.0.as_ref()?.weights(measure.measure(), site)
    }
}
