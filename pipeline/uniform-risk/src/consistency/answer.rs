//! All that consistency makes of records and hazard: the question, the findings, and the spectra of repaired weights.

use uplift_consistency::{DEVIATION_RATES, Verdict};
use uplift_inputs::{OtherHazard, RecordSet, SiteHazard};
use uplift_job::events::{Events, Silent};
use uplift_job::{Array, JobError};
use uplift_motion::IntensityMeasure;
use uplift_result::{ConsistencyGroup, Fit, MeasureConsistency, ResultFile, StoredConsistency};
use uplift_study::{Repair, UniformRiskStudy};

use super::repairs::{Repairs, repaired_spectra, repairs_from_result};
use super::{ConsistencyReport, Finding, Question};
use crate::error::UniformRiskError;
use crate::spectra::pooled_demand;
use crate::stored_stripes::StoredStripes;
use crate::stripes::Stripes;

/// All that consistency makes of a study.
#[derive(Debug, Clone)]
pub struct Answer {
    question: Question,
    findings: Vec<Finding>,
    repairs: Vec<Repairs>,
}

impl Answer {
    /// For a study that is looked at, and not run: no spectra, and weights only `with_repair`.
    ///
    /// # Errors
    /// Records and hazard that cannot be held against each other.
    pub fn from_plan(
        study: &UniformRiskStudy,
        records: &RecordSet,
        (hazard, other): (&[Vec<SiteHazard>], &[OtherHazard]),
        with_repair: bool,
    ) -> Result<Self, UniformRiskError> {
        let question = Question::from_study(study, records, hazard, other)?;
        let findings = question.findings(with_repair)?;
        Ok(Self { question, findings, repairs: Vec::new() })
    }

    /// For a run, with its `stripes`.
    ///
    /// # Errors
    /// Records and hazard that cannot be held against each other.
    pub fn from_run(
        study: &UniformRiskStudy,
        records: &RecordSet,
        hazard: (&[Vec<SiteHazard>], &[OtherHazard]),
        stripes: &[Stripes],
    ) -> Result<Self, UniformRiskError> {
        let is_repaired = study.consistency.repair == Repair::Weights;
        let mut answer = Self::from_plan(study, records, hazard, is_repaired)?;
        if is_repaired && !answer.findings.is_empty() {
            let branches = answer.question.findings_of_branches()?;
            for stripes in stripes {
                let demand = |strength| pooled_demand(stripes, strength);
                answer.repairs.push(repaired_spectra(study, stripes.measure, (&answer.findings, &branches), demand)?);
            }
        }
        Ok(answer)
    }

    /// For a result, with its stripes where it has sites, as its study says.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn from_result(file: &ResultFile, stored: Option<&StoredStripes>) -> Result<Self, UniformRiskError> {
        let question = Question::from_result(file)?;
        let with_repair = question.settings.repair == Repair::Weights;
        Self::from_question(question, file, stored, with_repair, &Silent)
    }

    /// To the `question` asked of a result, with its stripes where it has sites.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn from_question(
        question: Question,
        file: &ResultFile,
        stored: Option<&StoredStripes>,
        with_repair: bool,
        events: &dyn Events,
    ) -> Result<Self, UniformRiskError> {
        let findings = question.findings(with_repair)?;
        if events.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        let repairs = match stored {
            Some(stored) if with_repair && !findings.is_empty() => {
                repairs_from_result(file, stored, &question, &findings)?
            }
            _ => Vec::new(),
        };
        Ok(Self { question, findings, repairs })
    }

    /// What was asked.
    pub fn question(&self) -> &Question {
        &self.question
    }

    /// What is reported beside the plain spectra `[site, poe, strength]` of each measure, m.
    pub fn report(&self, plain_m: &[(IntensityMeasure, Array<3>)]) -> ConsistencyReport {
        ConsistencyReport::new(&self.question, &self.findings, plain_m, &self.repairs)
    }

    /// What a result is to hold of it; with the weights of all runs where it `keeps_weights`.
    pub fn group(&self, keeps_weights: bool) -> ConsistencyGroup<'_> {
        let sites = 0..self.question.sites.len();
        let of_measure = |stored: StoredConsistency| {
            let (measure, findings) = (stored.scaled_to, self.by_site(&self.findings, stored.scaled_to));
            let repairs = self.repairs(measure);
            let has_branches = |site: &usize| self.question.branches.contains_key(&(measure, *site));
            let repaired_branches = |site| repairs.and_then(|own| own.branches.iter().find(|own| own.site == site));
            MeasureConsistency {
                stored,
                diagnoses: findings.iter().map(|own| Some(&(*own)?.diagnosis)).collect(),
                repaired: findings.iter().map(|own| (*own)?.repaired()).collect(),
                ordinates: repairs.map(|own| &own.ordinates),
                branches: sites.clone().filter(has_branches).map(|site| (site, repaired_branches(site))).collect(),
            }
        };
        ConsistencyGroup {
            smoothness: self.question.settings.smoothness,
            sites: &self.question.sites,
            records: self.question.records.len(),
            keeps_weights,
            measures: self.stored(&self.findings).into_iter().map(of_measure).collect(),
        }
    }

    /// What a result says of it, a measure each, with the ratios of the findings `at_risks` of the question.
    fn stored(&self, at_risks: &[Finding]) -> Vec<StoredConsistency> {
        let of_measure = |(measure, levels): &(IntensityMeasure, Vec<f64>)| {
            let other = self.findings.iter().find(|own| own.scaled_to == *measure)?.other;
            Some(self.stored_of_measure((*measure, other), levels.len(), at_risks))
        };
        self.question.analyses.iter().filter_map(of_measure).collect()
    }

    fn stored_of_measure(
        &self,
        (scaled_to, other): (IntensityMeasure, IntensityMeasure),
        levels: usize,
        at_risks: &[Finding],
    ) -> StoredConsistency {
        let (question, repairs) = (&self.question, self.repairs(scaled_to));
        let [findings, at_risks] = [&self.findings[..], at_risks].map(|of| self.by_site(of, scaled_to));
        let deviation = |site: usize| findings[site]?.diagnosis.deviation.as_ref();
        let repaired = |site: usize| findings[site]?.repaired();
        let sites = question.sites.len();
        let by_rate = |of: &dyn Fn(usize) -> Option<[f64; DEVIATION_RATES]>| {
            Array::from_fn([sites, DEVIATION_RATES], |[site, rate]| of(site).map_or(f64::NAN, |values| values[rate]))
        };
        StoredConsistency {
            scaled_to,
            other,
            rate_per_year: by_rate(&|site| Some(findings[site]?.range.rates())),
            site_level: by_rate(&|site| Some(deviation(site)?.site_levels)),
            implied_level: by_rate(&|site| Some(deviation(site)?.implied_levels)),
            repaired_level: repairs
                .map(|_| by_rate(&|site| Some(repaired(site)?.diagnosis.deviation.as_ref()?.implied_levels))),
            bias: (0..sites).map(|site| deviation(site).map_or(f64::NAN, |own| own.bias)).collect(),
            max: (0..sites).map(|site| deviation(site).map_or(f64::NAN, |own| own.max)).collect(),
            verdict: (0..sites)
                .map(|site| findings[site].and_then(|own| own.diagnosis.verdict()).map_or("", Verdict::key).to_owned())
                .collect(),
            poes: question.poes.clone(),
            years: question.years,
            ratio: Array::from_fn([sites, question.poes.len()], |[site, poe]| {
                at_risks[site].and_then(|own| own.diagnosis.targets[poe].ratio).unwrap_or(f64::NAN)
            }),
            effective_records: repairs.map(|_| {
                Array::from_fn([sites, levels], |[site, level]| {
                    repaired(site).map_or(f64::NAN, |own| own.diagnosis.stripes[level].effective_records)
                })
            }),
            fits: repairs.map(|repairs| repairs.fits.map(|fit| Fit::from_exponential(fit.as_ref().ok()))),
            u_m: repairs.map(|repairs| {
                repairs.ordinates.map(|ordinate| ordinate.map_or(f64::NAN, |ordinate| ordinate.displacement_m))
            }),
        }
    }

    fn repairs(&self, measure: IntensityMeasure) -> Option<&Repairs> {
        self.repairs.iter().find(|own| own.measure == measure)
    }

    /// The finding of each site among those of a measure, where there is one.
    fn by_site<'a>(&self, findings: &'a [Finding], measure: IntensityMeasure) -> Vec<Option<&'a Finding>> {
        let mut all = vec![None; self.question.sites.len()];
        findings.iter().filter(|own| own.scaled_to == measure).for_each(|own| all[own.site] = Some(own));
        all
    }
}

/// What [`ResultFile::consistency`] says of `file` at other risks than those of its study: verdict and weights are of
/// the study's own probabilities, and the spectra of the weights are read at the others.
///
/// # Errors
/// A file that is damaged.
pub(crate) fn consistency_at_target_risks(file: &ResultFile) -> Result<Vec<StoredConsistency>, UniformRiskError> {
    let (question, is_repaired) = (Question::from_result(file)?, file.has_repair());
    let findings = question.findings(is_repaired)?;
    let axes = file.axes()?;
    let question = question.at(&axes.poes, axes.years)?;
    let at_risks = question.findings(false)?;
    let repairs = if is_repaired {
        repairs_from_result(file, &StoredStripes::read(file)?, &question, &findings)?
    } else {
        Vec::new()
    };
    Ok(Answer { question, findings, repairs }.stored(&at_risks))
}
