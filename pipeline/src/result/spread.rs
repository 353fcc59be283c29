//! How far the spectra of a result lie apart over what is not known: weighted hazard curves, structures that may be.

use uplift_motion::IntensityMeasure;

use super::file::ResultFile;
use super::layout::{axis, epistemic, percentile_name, uncertainty};
use crate::array::Array;
use crate::error::UpliftError;
use crate::uniform_risk::FRACTILES;

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
    /// Every spread that the result has, by measure, then what it is over, then site; none of a result that was asked
    /// for other risks than those of its study.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn spreads(&self) -> Result<Vec<StoredSpread>, UpliftError> {
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
