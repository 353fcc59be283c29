//! The study of a result, to be asked something new: its spectra and hazard as the file holds them, its records read
//! again.

use std::path::{Path, PathBuf};

use uplift_hazard::rate_from_probability;
use uplift_inputs::{RecordSet, motion_keys, read_measured, read_with_pairs};
use uplift_job::events::Silent;
use uplift_job::{Array, JobError};
use uplift_motion::{IntensityMeasure, RecordPair};
use uplift_result::declared::measure_names;
use uplift_result::{ResultFile, StoredRecords, urs};
use uplift_risk::StripeWeights;
use uplift_study::{MeasurePlan, UniformRiskStudy};

use crate::error::UniformRiskError;
use crate::stored_stripes::{poe_index, weigh};

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

impl StudyOfResult {
    /// The study of a result of uniform risk, with its spectra; its records are looked for in `manifest` if one is
    /// given.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn read(file: &ResultFile, manifest: Option<&Path>) -> Result<Self, UniformRiskError> {
        let axes = file.axes_with_sites()?;
        let mut study = file.stored_study()?;
        study.risk.poe.clone_from(&axes.poes);
        study.risk.years = axes.years;
        let spectra = file.spectra()?;
        if let Some(manifest) = manifest {
            let absolute = std::path::absolute(manifest)
                .map_err(|error| JobError::input(format!("{}: {error}", manifest.display())))?;
            study.records.source = study.records.source.by_manifest(absolute);
        }
        let measures = study
            .measures
            .iter()
            .map(|plan| {
                let weigh = |site: &String| {
                    let curve = file.site_curve(site, plan.measure)?;
                    weigh(file, site, &curve, &plan.levels, study.risk.extrapolate)
                };
                let own = spectra.measures.iter().find(|spectra| spectra.measure == plan.measure);
                Ok(SpectraOfResult {
                    plan: plan.clone(),
                    u_m: own
                        .ok_or_else(|| {
                            file.damaged(urs::GROUP.path(&urs::U_M, &measure_names(plan.measure)) + " is missing")
                        })?
                        .u_m
                        .clone(),
                    weights: axes.sites.iter().map(weigh).collect::<Result<_, _>>()?,
                })
            })
            .collect::<Result<Vec<_>, UniformRiskError>>()?;
        let head = file.head()?;
        Ok(Self {
            path: file.path().to_owned(),
            record_set: head.record_set,
            synthetic: head.synthetic,
            made_from: file.records()?,
            study,
            sites: axes.sites,
            measures,
        })
    }

    /// The records of the study, the very motions that the result was made from, with the same intensities: each motion
    /// once, whatever structures it shakes.
    ///
    /// # Errors
    /// Records that are not there, or are others: what is wrong, and what to do.
    pub fn records(&self) -> Result<RecordSet, String> {
        Ok(self.records_measured(&self.study.further_measures())?.without_structures())
    }

    /// The records of the result, with every structure that they shake, and the measures `further` beside PGV and PGA.
    ///
    /// # Errors
    /// As [`records`](Self::records).
    pub fn records_measured(&self, further: &[IntensityMeasure]) -> Result<RecordSet, String> {
        self.same_as_before(read_measured(&self.study, further, &Silent).map_err(|error| error.to_string())?)
    }

    /// The records, each motion once, with the pairs that they are components of.
    ///
    /// # Errors
    /// As [`records`](Self::records).
    pub fn records_and_pairs(&self) -> Result<(RecordSet, Vec<RecordPair>), String> {
        let further = self.study.further_measures();
        let (set, pairs) = read_with_pairs(&self.study, &further, &Silent).map_err(|error| error.to_string())?;
        Ok((self.same_as_before(set)?.without_structures(), pairs))
    }

    /// The records, if the result was made from them.
    fn same_as_before(&self, set: RecordSet) -> Result<RecordSet, String> {
        if self.study.records.at_level.is_some() {
            return Err("its levels have records of their own (records.at_level), selected for the level of the \
                         spectrum and not for another system"
                .to_owned());
        }
        let made_from = &self.made_from;
        if set.records.len() != made_from.ids.len() {
            let (found, made) = (set.records.len(), made_from.ids.len());
            return Err(format!(
                "there are {found} records now, and the result was made from {made}: run the study again"
            ));
        }
        let other = set.records.iter().zip(motion_keys(&set.records)).enumerate().find(|(index, (record, key))| {
            let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
            *key != made_from.motion_sha256[*index]
                || !same(record.pga_g, made_from.pga_g[*index])
                || !same(record.pgv_cm_s, made_from.pgv_cm_s[*index])
        });
        match other {
            Some((_, (record, _))) => Err(format!(
                "record {} is not the motion that the result was made from: put that file back, or run the study again",
                record.id
            )),
            None => Ok(set),
        }
    }

    /// Position of the smallest probability of the study, the only one where one was asked for.
    ///
    /// # Errors
    /// None for a study that was checked.
    pub fn rarest(&self) -> Result<usize, UniformRiskError> {
        poe_index(&self.study.risk.poe, None)
    }

    /// Target rate of the probability at `poe`, 1/yr (Eq. 4.8).
    ///
    /// # Errors
    /// None for a study that was checked.
    pub fn target_per_year(&self, poe: usize) -> Result<f64, UniformRiskError> {
        Ok(rate_from_probability(self.study.risk.poe[poe], self.study.risk.years)?)
    }

    /// The spectrum of a site and probability, `[strength]`, m.
    ///
    /// # Panics
    /// If an index is out of range, which is a bug of the caller.
    pub fn spectrum<'a>(&self, measure: &'a SpectraOfResult, site: usize, poe: usize) -> &'a [f64] {
        measure.u_m.block([site, poe])
    }
}
