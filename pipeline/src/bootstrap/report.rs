//! What a bootstrap tells: Table 4.1, and rocking initiation.

use std::path::PathBuf;

use serde::Serialize;

use super::bands::{BandSettings, Bands};
use super::reference::ReferenceRow;
use crate::result::StoredStripes;

/// What a bootstrap tells.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct BootstrapReport {
    /// The figures of Table 4.1, one a measure, site, probability and sample size, in this order.
    pub rows: Vec<BootstrapRow>,
    /// The result file, which holds the bands now.
    #[serde(skip)]
    pub result: PathBuf,
    /// The tables beside it: bands, and figures of Table 4.1.
    #[serde(skip)]
    pub tables: [PathBuf; 2],
    /// Share of the replicates between the limits.
    #[serde(skip)]
    pub confidence: f64,
    /// Names of the sites.
    #[serde(skip)]
    pub sites: Vec<String>,
    /// Probabilities of exceedance.
    #[serde(skip)]
    pub poes: Vec<f64>,
    /// Years that they refer to.
    #[serde(skip)]
    pub years: f64,
    /// Records in a sample.
    #[serde(skip)]
    pub sizes: Vec<u32>,
    /// Uplift strengths.
    #[serde(skip)]
    pub strengths: Vec<f64>,
    /// Displacement at uplift, m.
    #[serde(skip)]
    pub uplift_displacement_m: f64,
    /// The bands, a measure each.
    #[serde(skip)]
    pub bands: Vec<Bands>,
    /// What was given to compare with.
    #[serde(skip)]
    pub reference: Vec<ReferenceRow>,
}

/// The figures of Table 4.1 of one spectrum and sample size; none where overturning or a displacement of zero leaves
/// none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BootstrapRow {
    /// The site.
    pub site: String,
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Probability of exceedance.
    pub poe: f64,
    /// Records in a sample.
    pub sample_size: u32,
    /// Error of the median (Eq. 4.9), per cent.
    pub e_median: Option<f64>,
    /// Range of the interval (Eq. 4.10), per cent.
    pub r_90ci: Option<f64>,
}

/// Where rocking begins (Section 4.5.2, Fig. 4.10): the strengths at which the band falls to the uplift displacement;
/// none where it is above it at every strength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Initiation {
    /// Of the lower limit.
    pub lower: Option<f64>,
    /// Of the median.
    pub median: Option<f64>,
    /// Of the upper limit.
    pub upper: Option<f64>,
    /// Width of the band over the median, at the strength of the median; none where it is not finite.
    pub width: Option<f64>,
}

impl BootstrapReport {
    pub(super) fn new(
        stored: StoredStripes,
        tables: [PathBuf; 2],
        sizes: Vec<u32>,
        settings: BandSettings,
        bands: Vec<Bands>,
        reference: Vec<ReferenceRow>,
    ) -> Self {
        let mut rows = Vec::new();
        for bands in &bands {
            for (cell, (error, range)) in bands.error_of_median.iter().zip(&bands.range_of_interval).enumerate() {
                let spectrum = cell / sizes.len();
                rows.push(BootstrapRow {
                    site: stored.sites[spectrum / stored.poes.len()].clone(),
                    im: bands.measure.label(),
                    poe: stored.poes[spectrum % stored.poes.len()],
                    sample_size: sizes[cell % sizes.len()],
                    e_median: error.map(|error| 100.0 * error),
                    r_90ci: range.map(|range| 100.0 * range),
                });
            }
        }
        Self {
            rows,
            result: stored.path,
            tables,
            confidence: settings.confidence,
            sites: stored.sites,
            poes: stored.poes,
            years: stored.years,
            sizes,
            strengths: stored.strengths,
            uplift_displacement_m: stored.uplift_displacement_m,
            bands,
            reference,
        }
    }

    /// Position of a spectrum and sample size, by positions, in arrays over `[site, poe, size]`.
    pub fn cell(&self, site: usize, poe: usize, size: usize) -> usize {
        (site * self.poes.len() + poe) * self.sizes.len() + size
    }

    /// Where rocking begins, by `bands` at the position `cell`.
    ///
    /// # Panics
    /// If `cell` is out of range, which is a bug of the caller.
    pub fn initiation(&self, bands: &Bands, cell: usize) -> Initiation {
        let count = self.strengths.len();
        let row = cell * count..(cell + 1) * count;
        let at_uplift = |values: &[f64]| values.iter().position(|&u_m| u_m <= self.uplift_displacement_m);
        let strength = |values: &[f64]| at_uplift(values).map(|index| self.strengths[index]);
        let (lower, median, upper) = (&bands.lower_m[row.clone()], &bands.median_m[row.clone()], &bands.upper_m[row]);
        Initiation {
            lower: strength(lower),
            median: strength(median),
            upper: strength(upper),
            width: at_uplift(median)
                .map(|index| (upper[index] - lower[index]) / median[index])
                .filter(|width| width.is_finite()),
        }
    }
}
