//! How far the spectra of a result lie apart over what is not known: weighted hazard curves, possible structures.

use uplift_job::Array;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::IntensityMeasure;

use super::declared::{Group, group, measure_names};
use super::layout::axis::{BRANCH, POE, STRENGTH, STRUCTURE};
use super::stored_result::{RiskAxes, StoredResult};
use crate::error::ResultError;

/// Fractiles of the spectra over the branches.
pub const FRACTILES: [f64; 5] = [0.05, 0.16, 0.5, 0.84, 0.95];

/// What a spread is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpreadOver {
    /// The weighted hazard curves of the site.
    HazardCurves,
    /// The possible structures, where all records shake the same ones.
    Structures,
}

impl SpreadOver {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::HazardCurves, Self::Structures];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::HazardCurves => "weighted hazard curves",
            Self::Structures => "possible structures",
        }
    }

    /// The group of the spreads of a measure and site.
    pub fn group(self) -> Group<Spread> {
        match self {
            Self::HazardCurves => EPISTEMIC,
            Self::Structures => UNCERTAINTY,
        }
    }

    /// In the names and meanings of its arrays.
    pub const fn names(self) -> [(&'static str, &'static str); 3] {
        let (one, many) = match self {
            Self::HazardCurves => ("branch", "branches"),
            Self::Structures => ("structure", "structures"),
        };
        [("<one>", one), ("<many>", many), ("<over>", self.key())]
    }

    /// In names of columns and keys.
    pub const fn key(self) -> &'static str {
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
    /// The spread.
    pub spread: Spread,
}

/// Mean and fractiles of spectra, each `[poe, strength]`, m.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Weighted mean of the ordinates. It is not the ordinate of the mean hazard, which is the site's spectrum.
    pub mean_m: Array<2>,
    /// Weighted [`FRACTILES`] of the ordinates: the smallest ordinate that so much weight does not exceed; NaN where
    /// one of the spectra has none.
    pub fractiles_m: [Array<2>; 5],
}

/// The spectra of one site and measure by each of its branches: weighted hazard curves, or possible structures.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchSpectra {
    /// Position of the site.
    pub site: usize,
    /// Names of the branches.
    pub names: Vec<String>,
    /// Their weights.
    pub weights: Vec<f64>,
    /// Ordinates `[branch, poe, strength]`, m; NaN where a branch has none.
    pub spectra_m: Array<3>,
    /// Their weighted mean and fractiles.
    pub spread: Spread,
}

group! {
    /// Spread over the weighted hazard curves of a site; `<one>` of them and `<many>` in words.
    pub const EPISTEMIC: Spread = "/epistemic/<im>/<site>";
    "mean_m" [POE, STRENGTH] F64 "m" "weighted mean over the <many>" as "mean_<over>_m" "mean"
        = |of, at| of.mean_m[at];
    "u05_m" [POE, STRENGTH] F64 "m" "5 % fractile over the <many>" as "u05_<over>_m" "5 %"
        = |of, at| of.fractiles_m[0][at];
    "u16_m" [POE, STRENGTH] F64 "m" "16 % fractile over the <many>" as "u16_<over>_m" "16 %"
        = |of, at| of.fractiles_m[1][at];
    "u50_m" [POE, STRENGTH] F64 "m" "50 % fractile over the <many>" as "u50_<over>_m" "50 %"
        = |of, at| of.fractiles_m[2][at];
    "u84_m" [POE, STRENGTH] F64 "m" "84 % fractile over the <many>" as "u84_<over>_m" "84 %"
        = |of, at| of.fractiles_m[3][at];
    "u95_m" [POE, STRENGTH] F64 "m" "95 % fractile over the <many>" as "u95_<over>_m" "95 %"
        = |of, at| of.fractiles_m[4][at];
}

group! {
    /// The spectra themselves, along the axis `<branches>`.
    pub const EPISTEMIC_SPECTRA: Array<3> = EPISTEMIC.path;
    "u_m" ["<branches>", POE, STRENGTH] F64 "m" "uniform risk displacement by the <one>" = |of, at| of[at];
}

group! {
    /// Weights of the curves.
    pub const BRANCH_WEIGHTS: Array<1> = EPISTEMIC.path;
    "weight" ["<branches>"] F64 "1" "weight of the branch" = |of, at| of[at];
}

/// Spread over the possible structures.
pub const UNCERTAINTY: Group<Spread> = Group { path: "/uncertainty/<im>/<site>", ..EPISTEMIC };
/// The spectra of these structures.
pub const UNCERTAINTY_SPECTRA: Group<Array<3>> = Group { path: UNCERTAINTY.path, ..EPISTEMIC_SPECTRA };
/// Spread of the repaired spectra of the weighted hazard curves.
pub const REPAIRED_EPISTEMIC: Group<Spread> = Group { path: "/consistency/<im>/branches/<site>", ..EPISTEMIC };
/// The repaired spectra of these curves.
pub const REPAIRED_EPISTEMIC_SPECTRA: Group<Array<3>> = Group { path: REPAIRED_EPISTEMIC.path, ..EPISTEMIC_SPECTRA };

impl BranchSpectra {
    /// Writes those of the weighted hazard curves of `site` with the names and weights of these, along their `axis`.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_curves(
        &self,
        writer: &mut LabelledWriter,
        (measure, site, axis): (IntensityMeasure, &str, &str),
    ) -> Result<(), LabelledError> {
        BRANCH.write_texts(writer, &[("<branches>", axis)], &self.names)?;
        let names = [measure_names(measure)[0], ("<site>", site), ("<branches>", axis)];
        BRANCH_WEIGHTS.write_array(writer, &names, &self.weights)?;
        self.write(writer, (&EPISTEMIC_SPECTRA, &EPISTEMIC), SpreadOver::HazardCurves, (measure, site, axis))
    }

    /// Writes the repaired ones of weighted hazard curves, along the `axis` of these.
    pub(super) fn write_repaired(
        &self,
        writer: &mut LabelledWriter,
        at: (IntensityMeasure, &str, &str),
    ) -> Result<(), LabelledError> {
        self.write(writer, (&REPAIRED_EPISTEMIC_SPECTRA, &REPAIRED_EPISTEMIC), SpreadOver::HazardCurves, at)
    }

    /// Writes those of the possible structures.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_structures(
        &self,
        writer: &mut LabelledWriter,
        (measure, site): (IntensityMeasure, &str),
    ) -> Result<(), LabelledError> {
        let groups = (&UNCERTAINTY_SPECTRA, &UNCERTAINTY);
        self.write(writer, groups, SpreadOver::Structures, (measure, site, STRUCTURE.name))
    }

    fn write(
        &self,
        writer: &mut LabelledWriter,
        (spectra, spread): (&Group<Array<3>>, &Group<Spread>),
        over: SpreadOver,
        (measure, site, axis): (IntensityMeasure, &str, &str),
    ) -> Result<(), LabelledError> {
        let own = [measure_names(measure)[0], ("<site>", site), ("<branches>", axis)];
        let names = [&own[..], &over.names()].concat();
        spectra.write_array(writer, &names, self.spectra_m.values())?;
        spread.write(writer, &names, &lengths(self.spread.mean_m.shape()), &self.spread)
    }
}

/// Lengths of the axes of a spread.
fn lengths([poes, strengths]: [usize; 2]) -> [(&'static str, usize); 2] {
    [(POE.name, poes), (STRENGTH.name, strengths)]
}

impl StoredSpread {
    /// Names of the mean and of the fractiles, in the order of [`limits_m`](Self::limits_m): `mean`, `u05`, ….
    pub fn names() -> impl Iterator<Item = &'static str> {
        EPISTEMIC.quantities.iter().map(|quantity| quantity.name.trim_end_matches("_m"))
    }

    /// Mean and fractiles of the spectrum of a probability, by its position, over the strengths, m.
    pub fn limits_m(&self, poe: usize) -> [&[f64]; 6] {
        let [a, b, c, d, e] = &self.spread.fractiles_m;
        [&self.spread.mean_m, a, b, c, d, e].map(|values| values.block([poe]))
    }
}

impl StoredResult {
    /// The spectrum of a probability of the study, by its position, by each of the weighted hazard curves of a site:
    /// its weight of 1, and ordinates over the strengths of `axes`, m. None of a site with one curve.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn stored_branch_spectra(
        &self,
        axes: &RiskAxes,
        (measure, site): (IntensityMeasure, &str),
        poe: usize,
    ) -> Result<Vec<(f64, Vec<f64>)>, ResultError> {
        let names = [measure_names(measure)[0], ("<site>", site)];
        if !EPISTEMIC_SPECTRA.is_in(self, &names) {
            return Ok(Vec::new());
        }
        let (poes, strengths) = (axes.poes.len(), axes.strengths.len());
        let weights = self.reader.array::<f64>(&BRANCH_WEIGHTS.first_path(&names))?.values;
        let path = EPISTEMIC_SPECTRA.first_path(&names);
        let spectra_m = self.reader.array::<f64>(&path)?.values;
        if spectra_m.len() != weights.len() * poes * strengths {
            return Err(self.damaged(format!("{path}: {} ordinates", spectra_m.len())));
        }
        let total: f64 = weights.iter().sum();
        let of_curve = |(weight, of_curve): (&f64, &[f64])| {
            (weight / total, of_curve[poe * strengths..(poe + 1) * strengths].to_vec())
        };
        Ok(weights.iter().zip(spectra_m.chunks_exact(poes * strengths)).map(of_curve).collect())
    }

    /// Every spread that the result has, by measure, then what it is over, then site.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn stored_spreads(&self, axes: &RiskAxes) -> Result<Vec<StoredSpread>, ResultError> {
        let (poes, strengths) = (axes.poes.len(), axes.strengths.len());
        let nan = || Array::from_fn([poes, strengths], |_| f64::NAN);
        let mut spreads = Vec::new();
        for measure in self.measures() {
            for over in SpreadOver::ALL {
                for (site, name) in axes.sites.iter().enumerate() {
                    let names = [measure_names(measure)[0], ("<site>", name)];
                    if over.group().is_in(self, &names) {
                        let mut spread = Spread { mean_m: nan(), fractiles_m: FRACTILES.map(|_| nan()) };
                        over.group().read(self, &names, &lengths([poes, strengths]), &mut spread)?;
                        spreads.push(StoredSpread { measure, over, site, spread });
                    }
                }
            }
        }
        Ok(spreads)
    }
}
