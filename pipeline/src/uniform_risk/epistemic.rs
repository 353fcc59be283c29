//! The spectra of a site's weighted hazard curves: how much of a spectrum is the choice of hazard model.

use uplift_bootstrap::weighted_quantile;

use crate::inputs::BranchHazard;

/// Fractiles of the spectra over the branches.
pub const FRACTILES: [f64; 5] = [0.05, 0.16, 0.5, 0.84, 0.95];

/// The spectra of the branches of one site and measure.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchSpectra {
    /// Position of the site.
    pub site: usize,
    /// Names of the branches.
    pub names: Vec<String>,
    /// Their weights.
    pub weights: Vec<f64>,
    /// Ordinates over `[branch, poe, strength]`, m.
    pub spectra_m: Vec<f64>,
    /// Weighted mean of the ordinates over `[poe, strength]`, m. It is not the ordinate of the mean hazard, which is the site's spectrum.
    pub mean_m: Vec<f64>,
    /// Weighted [`FRACTILES`] of the ordinates, each over `[poe, strength]`, m: the smallest ordinate that so much weight does not exceed.
    pub fractiles_m: [Vec<f64>; 5],
}

impl BranchSpectra {
    /// Mean and fractiles of `spectra_m`, ordinates over `[branch, poe, strength]`, m.
    pub(super) fn new(site: usize, branches: &[BranchHazard], spectra_m: Vec<f64>) -> Self {
        let weights: Vec<f64> = branches.iter().map(|branch| branch.weight).collect();
        let names = branches.iter().map(|branch| branch.name.clone()).collect();
        let total: f64 = weights.iter().sum();
        let cells = spectra_m.len() / weights.len().max(1);
        let mut mean_m = Vec::with_capacity(cells);
        let mut fractiles_m: [Vec<f64>; 5] = Default::default();
        for cell in 0..cells {
            let mut pairs: Vec<(f64, f64)> = weights
                .iter()
                .enumerate()
                .map(|(branch, &weight)| (spectra_m[branch * cells + cell], weight))
                .collect();
            mean_m.push(pairs.iter().map(|(u_m, weight)| u_m * weight).sum::<f64>() / total);
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (fractile_m, probability) in fractiles_m.iter_mut().zip(FRACTILES) {
                fractile_m.push(weighted_quantile(&pairs, probability));
            }
        }
        Self { site, names, weights, spectra_m, mean_m, fractiles_m }
    }
}
