//! The stripes and hazard of a result file: what the questions asked after a run start from.

use std::path::{Path, PathBuf};

use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, rate_from_probability};
use uplift_motion::IntensityMeasure;
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};

use super::extend::whole_seal;
use super::hazard::{branch_group, read_curve};
use super::open_result;
use super::study_of::uniform_risk_study;
use crate::error::UpliftError;
use uplift_labelled::LabelledReader;
use uplift_study::Bootstrap;

/// A result file, read for another look at its stripes.
#[derive(Debug, Clone)]
pub struct StoredStripes {
    /// The file.
    pub path: PathBuf,
    /// Checksum of the file; none where it is not as it was written.
    pub seal: Option<String>,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// Names of the records.
    pub records: Vec<String>,
    /// Uplift strengths.
    pub strengths: Vec<f64>,
    /// Probabilities of exceedance.
    pub poes: Vec<f64>,
    /// Years that they refer to.
    pub years: f64,
    /// Target rates of the probabilities, 1/yr (Eq. 4.8).
    pub targets_per_year: Vec<f64>,
    /// Names of the sites.
    pub sites: Vec<String>,
    /// Displacement at uplift, m.
    pub uplift_displacement_m: f64,
    /// Seed of the study.
    pub seed: u64,
    /// What the study says about the bootstrap.
    pub bootstrap: Bootstrap,
    /// The measures, PGV first.
    pub measures: Vec<StoredMeasure>,
}

/// The stripes of one measure.
#[derive(Debug, Clone)]
pub struct StoredMeasure {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Its levels, cm/s or g.
    pub levels: Vec<f64>,
    /// Peak displacements over `[record, strength, level]`, m.
    pub edp_m: Vec<f64>,
    /// What each stripe weighs at each site.
    pub weights: Vec<StripeWeights>,
    /// Weighted alternatives of each site, `[site]` of (weight, what each stripe weighs); none where it has no branches.
    pub branches: Vec<Vec<(f64, StripeWeights)>>,
    /// The spectra over `[site, poe, strength]`, m, read as exact ordinates.
    pub spectra_m: Vec<f64>,
}

impl StoredStripes {
    /// Read the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged, no result, or of another layout; a study without sites.
    pub fn read(path: &Path) -> Result<Self, UpliftError> {
        let reader = open_result(path)?;
        let fail = |reason: String| UpliftError::input(format!("{}: {reason}", path.display()));
        let study = uniform_risk_study(&reader, path)?;
        if !reader.exists("/axes/site") {
            return Err(fail("the study has no sites, and so no spectra: add [[sites]] and run it again".to_owned()));
        }
        let (records, strengths) = (reader.axis_text("record")?, reader.axis_f64("strength")?);
        let (poes, sites) = (reader.axis_f64("poe")?, reader.axis_text("site")?);
        let lengths = [records.len(), strengths.len(), poes.len(), sites.len()];
        if lengths.contains(&0) {
            return Err(fail(format!(
                "records, strengths, probabilities and sites are {lengths:?} in number: the file is damaged"
            )));
        }
        let years = reader.attribute_f64("/", "poe_years")?;
        let targets_per_year = poes
            .iter()
            .map(|&poe| rate_from_probability(poe, years))
            .collect::<Result<Vec<_>, _>>()
            .map_err(|error| fail(error.to_string()))?;
        let extrapolation = study.risk.extrapolate;
        let mut stored = Self {
            path: path.to_owned(),
            seal: whole_seal(path).ok(),
            record_set: reader.attribute_text("/", "record_set")?,
            records,
            strengths,
            poes,
            years,
            targets_per_year,
            sites,
            uplift_displacement_m: study.oscillator.uplift_displacement_m,
            seed: reader.attribute_u64("/", "seed")?,
            bootstrap: study.bootstrap,
            measures: Vec::new(),
        };
        for measure in IntensityMeasure::ALL {
            if reader.exists(&format!("/ida/{}/edp_m", measure.key())) {
                let read = stored.read_measure(&reader, measure, extrapolation)?;
                stored.measures.push(read);
            }
        }
        Ok(stored)
    }

    fn read_measure(
        &self,
        reader: &LabelledReader,
        measure: IntensityMeasure,
        extrapolation: Extrapolation,
    ) -> Result<StoredMeasure, UpliftError> {
        let fail = |reason: String| UpliftError::input(format!("{}: {reason}", self.path.display()));
        let key = measure.key();
        let levels = reader.axis_f64(&format!("{key}_level"))?;
        let edp = reader.array_f64(&format!("/ida/{key}/edp_m"))?;
        if levels.is_empty() || edp.shape != [self.records.len(), self.strengths.len(), levels.len()] {
            return Err(fail(format!("/ida/{key}/edp_m has the shape {:?}, not that of its axes", edp.shape)));
        }
        let read_weights = |group: &str| -> Result<StripeWeights, UpliftError> {
            let curve = read_curve(reader, group, measure)?;
            StripeWeights::from_hazard(&curve, &levels, extrapolation)
                .map_err(|error| fail(format!("{group}: {error}")))
        };
        let (mut weights, mut branches) = (Vec::new(), Vec::new());
        for site in &self.sites {
            weights.push(read_weights(&format!("/hazard/{site}/{key}"))?);
            let of_site = (0..)
                .map(|index| branch_group(site, key, index))
                .take_while(|group| reader.exists(group))
                .map(|group| Ok((reader.attribute_f64(&group, "weight")?, read_weights(&group)?)));
            branches.push(of_site.collect::<Result<Vec<_>, UpliftError>>()?);
        }
        let mut measure = StoredMeasure {
            measure,
            levels: levels.clone(),
            edp_m: edp.values,
            weights,
            branches,
            spectra_m: Vec::new(),
        };
        let (sites, poes, strengths) = (self.sites.len(), self.poes.len(), self.strengths.len());
        measure.spectra_m = vec![0.0; sites * poes * strengths];
        for strength in 0..strengths {
            let demand = measure.demand(strength, strengths).map_err(|error| fail(error.to_string()))?;
            for (site, weights) in measure.weights.iter().enumerate() {
                let ordinates = RiskCurve::new(&demand, weights)
                    .and_then(|curve| curve.exact_ordinates(&self.targets_per_year))
                    .map_err(|error| fail(error.to_string()))?;
                for (poe, ordinate) in ordinates.iter().enumerate() {
                    measure.spectra_m[(site * poes + poe) * strengths + strength] = ordinate.displacement_m;
                }
            }
        }
        Ok(measure)
    }

    /// Position of the probability `wanted`, or of the smallest.
    ///
    /// # Errors
    /// A probability that the result does not have.
    pub fn poe_index(&self, wanted: Option<f64>) -> Result<usize, UpliftError> {
        poe_index(&self.poes, wanted)
    }

    /// Position of an ordinate in arrays over `[site, poe, strength]`.
    pub fn ordinate(&self, site: usize, poe: usize, strength: usize) -> usize {
        (site * self.poes.len() + poe) * self.strengths.len() + strength
    }

    /// A spectrum of arrays over `[site, poe, strength]`.
    pub fn spectrum<'a>(&self, array: &'a [f64], site: usize, poe: usize) -> &'a [f64] {
        let start = self.ordinate(site, poe, 0);
        &array[start..start + self.strengths.len()]
    }
}

/// Position of the probability `wanted` among `poes`, or of the smallest.
///
/// # Errors
/// A probability that is not among them.
pub(super) fn poe_index(poes: &[f64], wanted: Option<f64>) -> Result<usize, UpliftError> {
    let found = match wanted {
        Some(wanted) => poes.iter().position(|poe| (poe - wanted).abs() < 1e-9),
        None => (0..poes.len()).min_by(|&a, &b| poes[a].total_cmp(&poes[b])),
    };
    found.ok_or_else(|| UpliftError::Choice {
        option: "--poe",
        wanted: wanted.map(|wanted| wanted.to_string()),
        known: poes.iter().map(f64::to_string).collect(),
    })
}

impl StoredMeasure {
    /// The stripes of one strength of `strengths`.
    ///
    /// # Errors
    /// Demands that are none, in a file that was changed.
    pub fn stripes(&self, strength: usize, strengths: usize) -> Result<Stripes<'_>, UpliftError> {
        let levels = self.levels.len();
        let records = self.edp_m.len() / (strengths * levels);
        Ok(Stripes::strided(&self.levels, &self.edp_m[strength * levels..], records, strengths * levels)?)
    }

    /// All demands of one strength of `strengths`, pooled.
    ///
    /// # Errors
    /// As [`StoredMeasure::stripes`].
    pub fn demand(&self, strength: usize, strengths: usize) -> Result<PooledDemand, UpliftError> {
        Ok(PooledDemand::new(&self.stripes(strength, strengths)?)?)
    }
}
