//! The spectra of a site's weighted hazard curves, and those of the possible structures: how much of a spectrum is
//! the choice of hazard model, and how much what is not known of the structure.

use uplift_bootstrap::weighted_quantile;
use uplift_inputs::BranchHazard;
use uplift_job::Array;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::declared::{Group, Names};
use uplift_result::layout::axis;
use uplift_result::{FRACTILES, Spread};

/// The spectra of the branches of one site and measure.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchSpectra {
    /// Position of the site.
    pub site: usize,
    /// Names of the branches.
    pub names: Vec<String>,
    /// Their weights.
    pub weights: Vec<f64>,
    /// Ordinates `[branch, poe, strength]`, m.
    pub spectra_m: Array<3>,
    /// Their weighted mean and fractiles.
    pub spread: Spread,
}

impl BranchSpectra {
    /// Those of `branches`, with ordinates `spectra_m` `[branch, poe, strength]`, m.
    pub fn new(site: usize, branches: &[BranchHazard], spectra_m: Array<3>) -> Self {
        let names = branches.iter().map(|branch| branch.name.clone()).collect();
        Self::from_spectra(site, names, branches.iter().map(|branch| branch.weight).collect(), spectra_m)
    }

    /// Mean and fractiles of `spectra_m`, ordinates `[branch, poe, strength]`, m; NaN where a branch has none.
    pub(crate) fn from_spectra(site: usize, names: Vec<String>, weights: Vec<f64>, spectra_m: Array<3>) -> Self {
        let spread = spread(&weights, &spectra_m);
        Self { site, names, weights, spectra_m, spread }
    }
}

/// Weighted mean and fractiles of `spectra_m`, ordinates `[branch, poe, strength]`, m.
pub(crate) fn spread(weights: &[f64], spectra_m: &Array<3>) -> Spread {
    let total: f64 = weights.iter().sum();
    let [_, poes, strengths] = spectra_m.shape();
    let pairs = |[poe, strength]: [usize; 2]| -> Vec<(f64, f64)> {
        weights.iter().enumerate().map(|(branch, &weight)| (spectra_m[[branch, poe, strength]], weight)).collect()
    };
    let mean = |at| pairs(at).iter().map(|(u_m, weight)| u_m * weight).sum::<f64>() / total;
    let mean_m = Array::from_fn([poes, strengths], mean);
    let sorted = Array::from_fn([poes, strengths], |at| {
        let mut pairs = pairs(at);
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        pairs
    });
    let fractile = |pairs: &Vec<(f64, f64)>, probability| {
        let is_whole = pairs.iter().all(|(u_m, _)| !u_m.is_nan());
        if is_whole { weighted_quantile(pairs, probability) } else { f64::NAN }
    };
    let fractiles_m = FRACTILES.map(|probability| sorted.map(|pairs| fractile(pairs, probability)));
    Spread { mean_m, fractiles_m }
}

/// What weighted hazard curves are called, one and many.
pub const BRANCHES: [(&str, &str); 2] = [("<one>", "branch"), ("<many>", "branches")];

/// Write spectra, their mean and their fractiles into groups whose `names` say the axis of the spectra, and what one
/// and many of those are called that they are over.
///
/// # Errors
/// A file that cannot be written.
pub fn write_branch_spectra(
    writer: &mut LabelledWriter,
    branches: &BranchSpectra,
    (spectra, spread): (&Group<Array<3>>, &Group<Spread>),
    names: Names<'_>,
) -> Result<(), LabelledError> {
    spectra.write_array(writer, names, branches.spectra_m.values())?;
    let [poes, strengths] = branches.spread.mean_m.shape();
    spread.write(writer, names, &[(axis::POE.name, poes), (axis::STRENGTH.name, strengths)], &branches.spread)
}
