//! All that consistency makes of a run: the question, the findings, and the spectra of repaired weights.

use uplift_inputs::{OtherHazard, RecordSet, SiteHazard};
use uplift_job::Array;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_study::{Repair, UniformRiskStudy};

use super::spectra::{Repairs, repaired_spectra, repairs_of};
use super::write::{Keep, add};
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

    /// For a result, with its stripes where it has sites.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn from_result(file: &ResultFile, stored: Option<&StoredStripes>) -> Result<Self, UniformRiskError> {
        let question = Question::from_result(file)?;
        let is_repaired = file.stored_study()?.consistency.repair == Repair::Weights;
        let findings = question.findings(is_repaired)?;
        let repairs = match stored {
            Some(stored) if is_repaired && !findings.is_empty() => repairs_of(file, stored, &question, &findings)?,
            _ => Vec::new(),
        };
        Ok(Self { question, findings, repairs })
    }

    /// What was asked.
    pub fn question(&self) -> &Question {
        &self.question
    }

    /// Adds it to a result.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn add(&self, writer: &mut LabelledWriter, keep: Keep) -> Result<(), LabelledError> {
        add(writer, &self.question, &self.findings, &self.repairs, keep)
    }

    /// What is reported beside the plain spectra.
    pub fn report(&self, plain_m: &[(IntensityMeasure, Array<3>)]) -> ConsistencyReport {
        ConsistencyReport::new(&self.question, &self.findings, plain_m, &self.repairs)
    }
}
