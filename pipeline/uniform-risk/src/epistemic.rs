//! The spectra of a site's weighted hazard curves, and those of the structures that may be: how much of a spectrum is
//! the choice of hazard model, and how much what is not known of the structure.

use uplift_bootstrap::weighted_quantile;
use uplift_inputs::BranchHazard;
use uplift_job::Array;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::FRACTILES;
use uplift_result::layout::{axis, percentile_name};

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
    /// Weighted mean of the ordinates `[poe, strength]`, m. It is not the ordinate of the mean hazard, which is the
    /// site's spectrum.
    pub mean_m: Array<2>,
    /// Weighted [`FRACTILES`] of the ordinates, each `[poe, strength]`, m: the smallest ordinate that so much weight
    /// does not exceed.
    pub fractiles_m: [Array<2>; 5],
}

impl BranchSpectra {
    /// Those of `branches`, with ordinates `spectra_m` `[branch, poe, strength]`, m.
    pub fn new(site: usize, branches: &[BranchHazard], spectra_m: Array<3>) -> Self {
        let names = branches.iter().map(|branch| branch.name.clone()).collect();
        Self::of(site, names, branches.iter().map(|branch| branch.weight).collect(), spectra_m)
    }

    /// Mean and fractiles of `spectra_m`, ordinates `[branch, poe, strength]`, m; NaN where a branch has none.
    pub fn of(site: usize, names: Vec<String>, weights: Vec<f64>, spectra_m: Array<3>) -> Self {
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
        Self { site, names, weights, spectra_m, mean_m, fractiles_m }
    }
}

/// What weighted hazard curves are called.
pub const BRANCHES: [&str; 2] = ["branch", "branches"];

/// Write spectra of branches along `branch_axis`, their mean and their fractiles, each at the `path` of its name; a
/// branch and several are called `one` and `many`.
///
/// # Errors
/// A file that cannot be written.
pub fn write_branch_spectra(
    writer: &mut LabelledWriter,
    branches: &BranchSpectra,
    (branch_axis, [one, many]): (&str, [&str; 2]),
    path: impl Fn(&str) -> String,
) -> Result<(), LabelledError> {
    let dims = [branch_axis, axis::POE, axis::STRENGTH];
    let long_name = format!("uniform risk displacement by the {one}");
    writer.array_f64(&path("u_m"), &dims, branches.spectra_m.values(), "m", &long_name)?;
    let dims = [axis::POE, axis::STRENGTH];
    let long_name = format!("weighted mean over the {many}");
    writer.array_f64(&path("mean_m"), &dims, branches.mean_m.values(), "m", &long_name)?;
    for (fractile, values) in FRACTILES.iter().zip(&branches.fractiles_m) {
        let percent = (100.0 * fractile).round();
        let long_name = format!("{percent} % fractile over the {many}");
        writer.array_f64(&path(&percentile_name(percent)), &dims, values.values(), "m", &long_name)?;
    }
    Ok(())
}
