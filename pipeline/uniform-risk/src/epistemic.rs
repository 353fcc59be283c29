//! The spectra of a site's weighted hazard curves, and those of the possible structures: how much of a spectrum is
//! the choice of hazard model, and how much what is not known of the structure.

use uplift_bootstrap::weighted_quantile;
use uplift_job::Array;
use uplift_result::{BranchSpectra, FRACTILES, Spread};

/// The spectra of the branches of a site with their weighted mean and fractiles, of ordinates `spectra_m`
/// `[branch, poe, strength]`, m; NaN where a branch has none.
pub(crate) fn branch_spectra(site: usize, names: Vec<String>, weights: Vec<f64>, spectra_m: Array<3>) -> BranchSpectra {
    let spread = spread(&weights, &spectra_m);
    BranchSpectra { site, names, weights, spectra_m, spread }
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
