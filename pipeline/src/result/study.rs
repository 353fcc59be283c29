//! The study of a result, to be asked something new: its spectra and hazard as the file holds them, its records read
//! again.

use std::path::{Path, PathBuf};

use uplift_hazard::rate_from_probability;
use uplift_motion::IntensityMeasure;
use uplift_risk::StripeWeights;
use uplift_study::{MeasurePlan, ResolvedStudy, Study};

use super::file::ResultFile;
use super::layout::{axis, urs};
use super::records::StoredRecords;
use super::stripes::{extrapolation, poe_index};
use crate::array::Array;
use crate::checkpoint::motion_key;
use crate::error::UpliftError;
use crate::inputs::{RecordSet, read_records};

/// Parts of a study that the result holds itself, or that matter no more.
const LEFT_OUT: [&str; 3] = ["sites", "site_table", "output"];

/// A result with its study.
#[derive(Debug, Clone)]
pub struct StudyOfResult {
    /// The file.
    pub path: PathBuf,
    /// Where the records come from, in a line.
    pub record_set: String,
    /// True for motions made by the program.
    pub synthetic: bool,
    /// The study, without its sites.
    pub study: ResolvedStudy,
    /// Names of the sites.
    pub sites: Vec<String>,
    /// The measures, in the order of the study.
    pub measures: Vec<SpectraOfResult>,
    /// Why the study's records cannot even be looked for.
    unreadable: Option<String>,
    /// What identifies the records.
    made_from: StoredRecords,
}

/// Spectra and hazard of one measure.
#[derive(Debug, Clone)]
pub struct SpectraOfResult {
    /// The measure with its levels.
    pub plan: MeasurePlan,
    /// The spectra `[site, poe, strength]`, m; infinite where censored.
    pub u_m: Array<3>,
    /// What each stripe weighs, `[site]`.
    pub weights: Vec<StripeWeights>,
}

impl SpectraOfResult {
    /// The measure.
    pub fn measure(&self) -> IntensityMeasure {
        self.plan.measure
    }
}

impl ResultFile {
    /// The study of a result of uniform risk, with its spectra; its records are looked for in `manifest` if one is
    /// given.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites; a manifest for records that have none.
    pub fn study(&self, manifest: Option<&Path>) -> Result<StudyOfResult, UpliftError> {
        let axes = self.axes_with_sites()?;
        let (study, unreadable) = self.stored_study(manifest)?;
        let lengths = [
            (axis::SITE, axes.sites.len()),
            (axis::POE, study.risk.poe.len()),
            (axis::STRENGTH, study.strengths.len()),
        ];
        let measures = study
            .measures
            .iter()
            .map(|plan| {
                let weigh = |site: &String| {
                    let curve = self.curves(site, plan.measure)?.curve;
                    self.weigh(site, &curve, &plan.levels, extrapolation(&study))
                };
                Ok(SpectraOfResult {
                    plan: plan.clone(),
                    u_m: self.array(&urs::u_m(plan.measure), lengths)?,
                    weights: axes.sites.iter().map(weigh).collect::<Result<_, _>>()?,
                })
            })
            .collect::<Result<Vec<_>, UpliftError>>()?;
        Ok(StudyOfResult {
            path: self.path.clone(),
            record_set: self.record_set()?,
            synthetic: self.is_synthetic()?,
            made_from: self.records()?,
            study,
            sites: axes.sites,
            measures,
            unreadable,
        })
    }

    /// The stored study; where its manifest is gone, without its records, and why.
    pub(super) fn stored_study(&self, manifest: Option<&Path>) -> Result<(ResolvedStudy, Option<String>), UpliftError> {
        resolve(&self.reader.attribute_text("/", "study_toml")?, manifest)
            .map_err(|reason| self.fail(format!("the study in the file cannot be read: {reason}")))
    }
}

impl StudyOfResult {
    /// The records of the study, the very motions that the result was made from, with the same intensities.
    ///
    /// # Errors
    /// Records that are not there, or are others: what is wrong, and what to do.
    pub fn records(&self) -> Result<RecordSet, String> {
        if let Some(reason) = &self.unreadable {
            return Err(reason.clone());
        }
        let set = read_records(&self.study).map_err(|error| error.to_string())?;
        let made_from = &self.made_from;
        if set.records.len() != made_from.ids.len() {
            let (found, made) = (set.records.len(), made_from.ids.len());
            return Err(format!(
                "there are {found} records now, and the result was made from {made}: run the study again"
            ));
        }
        let other = set.records.iter().enumerate().find(|(index, record)| {
            let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
            motion_key(&record.accelerogram) != made_from.motion_sha256[*index]
                || !same(record.pga_g, made_from.pga_g[*index])
                || !same(record.pgv_cm_s, made_from.pgv_cm_s[*index])
        });
        match other {
            Some((_, record)) => Err(format!(
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
        measure.u_m.block([site, poe])
    }
}

/// The stored study; where its manifest is gone, without its records, and why.
fn resolve(study_toml: &str, manifest: Option<&Path>) -> Result<(ResolvedStudy, Option<String>), String> {
    let mut table: toml::Table = toml::from_str(study_toml).map_err(|error| error.to_string())?;
    for section in LEFT_OUT {
        table.remove(section);
    }
    let study = |table: &toml::Table, overrides: &[String]| -> Result<ResolvedStudy, String> {
        let text = toml::to_string(table).map_err(|error| error.to_string())?;
        let name = Path::new("the study in the result");
        Study::parse(name, text).and_then(|study| study.resolve(overrides)).map_err(|error| {
            let mistakes: Vec<String> = error.mistakes().iter().map(ToString::to_string).collect();
            if mistakes.is_empty() { error.to_string() } else { mistakes.join("; ") }
        })
    };
    let overrides: Vec<String> =
        manifest.iter().map(|path| format!("records.manifest={:?}", path.display().to_string())).collect();
    match study(&table, &overrides) {
        Ok(study) => Ok((study, None)),
        Err(reason) => {
            table.remove("records");
            study(&table, &[]).map(|study| (study, Some(reason)))
        }
    }
}
