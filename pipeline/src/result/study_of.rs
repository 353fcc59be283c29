//! The study of a result, to be asked something new: its spectra and hazard as the file holds them, its records read again.

use std::path::{Path, PathBuf};

use uplift_hazard::rate_from_probability;
use uplift_motion::IntensityMeasure;
use uplift_risk::StripeWeights;

use super::hazard::read_curve;
use super::open_result;
use super::stored::poe_index;
use crate::checkpoint::motion_key;
use crate::error::UpliftError;
use crate::inputs::{RecordSet, read_records};
use uplift_labelled::{LabelledError, LabelledReader};
use uplift_study::{AnyStudy, MeasurePlan, Study, UniformRiskStudy};

/// A result with its study.
#[derive(Debug, Clone)]
pub struct StudyOfResult {
    /// The file.
    pub path: PathBuf,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// True for motions made by the program.
    pub synthetic: bool,
    /// The study.
    pub study: UniformRiskStudy,
    /// Names of the sites.
    pub sites: Vec<String>,
    /// The measures, in the order of the study.
    pub measures: Vec<SpectraOfResult>,
    /// `[record]`: SHA-256 of the motion, PGA in g, PGV in cm/s.
    motions: Vec<(String, f64, f64)>,
}

/// Spectra and hazard of one measure.
#[derive(Debug, Clone)]
pub struct SpectraOfResult {
    /// The measure with its levels.
    pub plan: MeasurePlan,
    /// The spectra over `[site, poe, strength]`, m; infinite where censored.
    pub u_m: Vec<f64>,
    /// What each stripe weighs, `[site]`.
    pub weights: Vec<StripeWeights>,
}

impl SpectraOfResult {
    /// The measure.
    pub fn measure(&self) -> IntensityMeasure {
        self.plan.measure
    }
}

impl StudyOfResult {
    /// Read the result at `path`, and its study; its records are looked for in `manifest` if one is given.
    ///
    /// # Errors
    /// A file that is missing, damaged, no result, or of another layout; a study without sites; a manifest for records that have none.
    pub fn read(path: &Path, manifest: Option<&Path>) -> Result<Self, UpliftError> {
        let reader = open_result(path)?;
        let fail = |reason: &str| UpliftError::input(format!("{}: {reason}", path.display()));
        if !reader.exists("/axes/site") {
            return Err(fail("the study has no sites, and so no spectra: add [[sites]] and run it again"));
        }
        let sites = reader.axis_text("site")?;
        let mut study = uniform_risk_study(&reader, path)?;
        if let Some(manifest) = manifest {
            study.records.source = study.records.source.by_manifest(absolute(manifest)?);
        }
        let cells = sites.len() * study.risk.poe.len() * study.strengths.len();
        let measures = study
            .measures
            .iter()
            .map(|plan| {
                let key = plan.measure.key();
                let u_m = reader.array_f64(&format!("/urs/{key}/u_m"))?.values;
                if u_m.len() != cells {
                    return Err(fail(&format!(
                        "/urs/{key}/u_m does not have the shape of its axes: the file is damaged"
                    )));
                }
                let weights = sites
                    .iter()
                    .map(|site| {
                        let curve = read_curve(&reader, &format!("/hazard/{site}/{key}"), plan.measure)?;
                        StripeWeights::from_hazard(&curve, &plan.levels, study.risk.extrapolate)
                            .map_err(|error| fail(&format!("hazard of {site}: {error}")))
                    })
                    .collect::<Result<Vec<_>, _>>()?;
                Ok(SpectraOfResult { plan: plan.clone(), u_m, weights })
            })
            .collect::<Result<Vec<_>, UpliftError>>()?;
        Ok(Self {
            path: path.to_owned(),
            record_set: reader.attribute_text("/", "record_set")?,
            synthetic: reader.attribute_i64("/", "synthetic")? == 1,
            motions: motions(&reader)?,
            study,
            sites,
            measures,
        })
    }

    /// The records of the study, the very motions that the result was made from, with the same intensities.
    ///
    /// # Errors
    /// Records that are not there, or are others: what is wrong, and what to do.
    pub fn records(&self) -> Result<RecordSet, String> {
        let set = read_records(&self.study).map_err(|error| error.to_string())?;
        if set.records.len() != self.motions.len() {
            let (found, made) = (set.records.len(), self.motions.len());
            return Err(format!(
                "there are {found} records now, and the result was made from {made}: run the study again"
            ));
        }
        let other = set.records.iter().zip(&self.motions).find(|(record, (motion, pga_g, pgv_cm_s))| {
            let same = |a: f64, b: &f64| a.to_bits() == b.to_bits();
            motion_key(&record.accelerogram) != *motion
                || !same(record.pga_g, pga_g)
                || !same(record.pgv_cm_s, pgv_cm_s)
        });
        match other {
            Some((record, _)) => Err(format!(
                "record {} is not the motion that the result was made from: put that file back, or run the study again",
                record.id
            )),
            None => Ok(set),
        }
    }

    /// Position of the probability `wanted`, or of the smallest.
    ///
    /// # Errors
    /// A probability that the result does not have.
    pub fn poe_index(&self, wanted: Option<f64>) -> Result<usize, UpliftError> {
        poe_index(&self.study.risk.poe, wanted)
    }

    /// Target rate of the probability at `poe`, 1/yr (Eq. 4.8).
    ///
    /// # Errors
    /// None for a study that was checked.
    pub fn target_per_year(&self, poe: usize) -> Result<f64, UpliftError> {
        rate_from_probability(self.study.risk.poe[poe], self.study.risk.years)
            .map_err(|error| UpliftError::input(error.to_string()))
    }

    /// The spectrum of a site and probability, `[strength]`, m.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn spectrum<'a>(&self, measure: &'a SpectraOfResult, site: usize, poe: usize) -> &'a [f64] {
        let strengths = self.study.strengths.len();
        let start = (site * self.study.risk.poe.len() + poe) * strengths;
        &measure.u_m[start..start + strengths]
    }
}

/// A path that does not depend on the current folder.
fn absolute(path: &Path) -> Result<PathBuf, UpliftError> {
    std::path::absolute(path).map_err(|error| UpliftError::input(format!("{}: {error}", path.display())))
}

/// What identifies each record.
fn motions(reader: &LabelledReader) -> Result<Vec<(String, f64, f64)>, LabelledError> {
    let motions = reader.array_text("/records/motion_sha256")?.values;
    let pga_g = reader.array_f64("/records/pga_g")?.values;
    let pgv_cm_s = reader.array_f64("/records/pgv_cm_s")?.values;
    Ok(motions
        .into_iter()
        .zip(pga_g)
        .zip(pgv_cm_s)
        .map(|((motion, pga_g), pgv_cm_s)| (motion, pga_g, pgv_cm_s))
        .collect())
}

/// The study of the result at `path`; its records and curves need not be there any more.
///
/// # Errors
/// A study that cannot be read, or is of another kind.
pub(super) fn uniform_risk_study(reader: &LabelledReader, path: &Path) -> Result<UniformRiskStudy, UpliftError> {
    let fail = |reason: String| UpliftError::input(format!("{}: {reason}", path.display()));
    match Study::stored(&reader.attribute_text("/", "study_toml")?) {
        Ok(AnyStudy::UniformRisk(study)) => Ok(*study),
        Ok(AnyStudy::Displacement(study)) => {
            Err(fail(format!("the study {} has no uniform risk spectra", study.title)))
        }
        Err(error) => {
            let mistakes: Vec<String> = error.mistakes().iter().map(ToString::to_string).collect();
            Err(fail(format!("the study in the file cannot be read: {}", mistakes.join("; "))))
        }
    }
}
