//! The study of a result, to be asked something new: its spectra and hazard as the file holds them, its records read
//! again.

use std::path::{Path, PathBuf};

use uplift_hazard::rate_from_probability;
use uplift_motion::{IntensityMeasure, RecordPair};
use uplift_risk::StripeWeights;

use super::asked::{AskedRisk, RiskTargets};
use super::file::ResultFile;
use super::records::StoredRecords;
use super::spectra::urs;
use super::stripes::poe_index;
use crate::array::Array;
use crate::error::UpliftError;
use crate::events::Silent;
use crate::inputs::{RecordSet, motion_keys, read_measured, read_with_pairs};
use uplift_study::{AnyStudy, Kind, MeasurePlan, Study, UniformRiskStudy};

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

impl ResultFile {
    /// The study of a result of uniform risk, with its spectra; its records are looked for in `manifest` if one is
    /// given.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind; a study without sites.
    pub fn study(&self, manifest: Option<&Path>) -> Result<StudyOfResult, UpliftError> {
        let axes = self.axes_with_sites()?;
        let mut study = self.stored_study()?;
        study.risk.poe.clone_from(&axes.poes);
        study.risk.years = axes.years;
        let spectra = self.spectra()?;
        if let Some(manifest) = manifest {
            let absolute = std::path::absolute(manifest)
                .map_err(|error| UpliftError::input(format!("{}: {error}", manifest.display())))?;
            study.records.source = study.records.source.by_manifest(absolute);
        }
        let measures = study
            .measures
            .iter()
            .map(|plan| {
                let weigh = |site: &String| {
                    let curve = self.site_curve(site, plan.measure)?;
                    self.weigh(site, &curve, &plan.levels, study.risk.extrapolate)
                };
                let own = spectra.measures.iter().find(|spectra| spectra.measure == plan.measure);
                Ok(SpectraOfResult {
                    plan: plan.clone(),
                    u_m: own
                        .ok_or_else(|| self.damaged(urs::GROUP.path_of(&urs::U_M, plan.measure) + " is missing"))?
                        .u_m
                        .clone(),
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
        })
    }

    /// The study; its records and curves need not be there any more.
    pub(crate) fn stored_study(&self) -> Result<UniformRiskStudy, UpliftError> {
        self.require(Kind::UniformRisk)?;
        match Study::stored(&self.reader.attribute_text("/", "study_toml")?) {
            Ok(AnyStudy::UniformRisk(study)) => Ok(*study),
            Ok(other) => Err(self.damaged(format!("its study {} is of another kind", other.title()))),
            Err(error) => {
                let mistakes: Vec<String> = error.mistakes().iter().map(ToString::to_string).collect();
                Err(self.fail(format!("the study in the file cannot be read: {}", mistakes.join("; "))))
            }
        }
    }

    /// Refuses a result each of whose levels has records of its own, of which `question` has no answer.
    ///
    /// # Errors
    /// That it is one; a file that is damaged or of another kind.
    pub(crate) fn refuse_records_at_level(&self, question: &str) -> Result<(), UpliftError> {
        if self.stored_study()?.records.at_level.is_none() {
            return Ok(());
        }
        Err(self.fail(format!(
            "its levels have records of their own (records.at_level), and {question}: ask a result whose records are \
             the same at every level"
        )))
    }
}

impl StudyOfResult {
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
    pub(crate) fn records_measured(&self, further: &[IntensityMeasure]) -> Result<RecordSet, String> {
        self.same_as_before(read_measured(&self.study, further, &Silent).map_err(|error| error.to_string())?)
    }

    /// The records, each motion once, with the pairs that they are components of.
    ///
    /// # Errors
    /// As [`records`](Self::records).
    pub(crate) fn records_and_pairs(&self) -> Result<(RecordSet, Vec<RecordPair>), String> {
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

    /// Position of the one probability that was `asked` for; of the smallest of the study where none was.
    ///
    /// # Errors
    /// [`UpliftError::Usage`] where several were.
    pub(crate) fn only_risk(&self, asked: &AskedRisk) -> Result<usize, UpliftError> {
        let poes = &self.study.risk.poe;
        if asked.targets != RiskTargets::OfStudy && poes.len() > 1 {
            return Err(UpliftError::Usage("one risk at a time: give one --poe or --return-period".to_owned()));
        }
        poe_index(poes, None)
    }

    /// Target rate of the probability at `poe`, 1/yr (Eq. 4.8).
    ///
    /// # Errors
    /// None for a study that was checked.
    pub fn target_per_year(&self, poe: usize) -> Result<f64, UpliftError> {
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
