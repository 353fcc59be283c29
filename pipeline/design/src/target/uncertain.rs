//! A search among structures of which not all is known exactly.

use serde::Serialize;

use super::band::TargetBand;
use crate::uncertain::{Around, QuantityReport};

/// The structures that every value of a search may be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TargetUncertainty {
    /// `epistemic`, branches, of which the mean risk meets the target; or `aleatory`, structures of each record with
    /// one risk.
    pub kind: &'static str,
    /// `sobol` or `latin-hypercube`.
    pub sampling: &'static str,
    /// Where the random numbers began.
    pub seed: u64,
    /// Structures that shake under a record at every value.
    pub structures: usize,
    /// What is not known exactly, of the structure as described; at every other value it differs by the same factors.
    pub quantities: Vec<QuantityReport>,
    /// The value that each branch by itself would need; none where there are no branches.
    pub by_structure: Option<TargetBand>,
    /// The same with records drawn anew.
    pub by_all: Option<TargetBand>,
}

impl TargetUncertainty {
    /// Of the structures `around` every value, with the `bands` of branches by themselves and with the records.
    pub(super) fn of(around: &Around<'_>, bands: Option<[TargetBand; 2]>) -> Self {
        let (kind, sampling, seed) = around.sampled();
        let [by_structure, by_all] = bands.map_or([None, None], |bands| bands.map(Some));
        let (structures, quantities) = (around.per_record(), around.quantities());
        Self { kind, sampling, seed, structures, quantities, by_structure, by_all }
    }
}
