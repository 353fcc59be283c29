//! How far the spectra of a result lie apart over what is not known: weighted hazard curves, structures that may be.

use uplift_motion::IntensityMeasure;

/// Fractiles of the spectra over the branches.
pub const FRACTILES: [f64; 5] = [0.05, 0.16, 0.5, 0.84, 0.95];

use super::file::ResultFile;
use super::layout::{axis, epistemic, percentile_name, uncertainty};
use crate::error::ResultError;
use uplift_job::Array;

/// What a spread is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpreadOver {
    /// The weighted hazard curves of the site.
    HazardCurves,
    /// The structures that may be, where all records shake the same ones.
    Structures,
}

impl SpreadOver {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::HazardCurves, Self::Structures];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::HazardCurves => "weighted hazard curves",
            Self::Structures => "structures that may be",
        }
    }

    /// In names of columns and keys.
    pub fn key(self) -> &'static str {
        match self {
            Self::HazardCurves => "hazard",
            Self::Structures => "structure",
        }
    }
}

/// The spread of the spectra of one site by one measure, of the probabilities of the study.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredSpread {
    /// The measure.
    pub measure: IntensityMeasure,
    /// What it is over.
    pub over: SpreadOver,
    /// Position of the site.
    pub site: usize,
    /// Weighted mean of the ordinates `[poe, strength]`, m.
    pub mean_m: Array<2>,
    /// Weighted [`FRACTILES`] of the ordinates, each `[poe, strength]`, m; NaN where one of them has none.
    pub fractiles_m: [Array<2>; 5],
}

impl StoredSpread {
    /// Names of the mean and of the fractiles, in the order of [`limits_m`](Self::limits_m): `mean`, `u05`, ….
    pub fn names() -> [String; 6] {
        let fractile = |of: usize| percentile_name(100.0 * FRACTILES[of]).trim_end_matches("_m").to_owned();
        ["mean".to_owned(), fractile(0), fractile(1), fractile(2), fractile(3), fractile(4)]
    }

    /// Mean and fractiles of the spectrum of a probability, by its position, over the strengths, m.
    pub fn limits_m(&self, poe: usize) -> [&[f64]; 6] {
        let [a, b, c, d, e] = &self.fractiles_m;
        [&self.mean_m, a, b, c, d, e].map(|values| values.block([poe]))
    }
}

impl ResultFile {
    /// The spectrum of a probability of the study, by its position, by each of the weighted hazard curves of a site:
    /// its weight of 1, and ordinates over the strengths, m. None of a site with one curve, and of a result that was
    /// asked for other risks.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn branch_spectra(
        &self,
        measure: IntensityMeasure,
        site: &str,
        poe: usize,
    ) -> Result<Vec<(f64, Vec<f64>)>, ResultError> {
        let path = epistemic::array(measure, site, "u_m");
        if self.is_asked() || !self.reader.exists(&path) {
            return Ok(Vec::new());
        }
        let axes = self.axes_with_sites()?;
        let (poes, strengths) = (axes.poes.len(), axes.strengths.len());
        let weights = self.reader.array_f64(&epistemic::array(measure, site, "weight"))?.values;
        let spectra_m = self.reader.array_f64(&path)?.values;
        if spectra_m.len() != weights.len() * poes * strengths {
            return Err(self.damaged(format!("{path}: {} ordinates", spectra_m.len())));
        }
        let total: f64 = weights.iter().sum();
        let of_curve = |(weight, of_curve): (&f64, &[f64])| {
            (weight / total, of_curve[poe * strengths..(poe + 1) * strengths].to_vec())
        };
        Ok(weights.iter().zip(spectra_m.chunks_exact(poes * strengths)).map(of_curve).collect())
    }

    /// Every spread that the result has, by measure, then what it is over, then site; none of a result that was asked
    /// for other risks than those of its study.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn spreads(&self) -> Result<Vec<StoredSpread>, ResultError> {
        if self.is_asked() {
            return Ok(Vec::new());
        }
        let axes = self.axes_with_sites()?;
        let lengths = [(axis::POE, axes.poes.len()), (axis::STRENGTH, axes.strengths.len())];
        let mut spreads = Vec::new();
        for measure in self.measures() {
            for over in SpreadOver::ALL {
                for (site, name) in axes.sites.iter().enumerate() {
                    let path = |array: &str| match over {
                        SpreadOver::HazardCurves => epistemic::array(measure, name, array),
                        SpreadOver::Structures => uncertainty::array(measure, name, array),
                    };
                    if !self.reader.exists(&path("mean_m")) {
                        continue;
                    }
                    let fractile = |of: usize| self.array(&path(&percentile_name(100.0 * FRACTILES[of])), lengths);
                    spreads.push(StoredSpread {
                        measure,
                        over,
                        site,
                        mean_m: self.array(&path("mean_m"), lengths)?,
                        fractiles_m: [fractile(0)?, fractile(1)?, fractile(2)?, fractile(3)?, fractile(4)?],
                    });
                }
            }
        }
        Ok(spreads)
    }
}
