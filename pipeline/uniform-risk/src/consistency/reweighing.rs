//! The spectra of a repaired set for other samples of its records: each gets weights of its own, solved again.

use rayon::prelude::*;
use uplift_bootstrap::{SORTED_AT_ONCE, weighted_replicates};
use uplift_consistency::{Exponents, Repaired, Scratch, Solver};
use uplift_hazard::HazardCurve;
use uplift_ida::Watch;
use uplift_job::JobError;
use uplift_motion::IntensityMeasure;
use uplift_result::ResultFile;
use uplift_risk::{PooledDemand, RecordSample, RiskCurve, RunWeights};

use super::{BranchFindings, Finding, Question};
use crate::error::UniformRiskError;

/// The repaired analyses of a result, with all that weighs their records anew.
pub struct Reweighing {
    question: Question,
    findings: Vec<Finding>,
    branches: Vec<BranchFindings>,
}

/// A repaired analysis: the records scaled to a measure, and the hazard that their weights bring.
pub struct RepairedAnalysis<'a> {
    question: &'a Question,
    finding: &'a Finding,
    repaired: &'a Repaired,
    /// Of the measure that the records are scaled to, and of the other one.
    curves: (&'a HazardCurve, &'a HazardCurve),
}

/// The analysis for a weighted hazard curve.
pub struct ReweighedBranch<'a> {
    /// Name of the weighted curve.
    pub name: &'a str,
    /// Its weight.
    pub weight: f64,
    /// Or why it has no repair.
    pub analysis: Result<RepairedAnalysis<'a>, String>,
}

/// The ordinates of samples that were weighed anew.
pub struct Reweighed {
    /// Exact ordinates `[strength, target, sample]`, m.
    pub ordinates_m: Vec<f64>,
    /// Whether the weights of a sample bring the site's hazard `[sample]`; the others keep the best that was found.
    pub is_reached: Vec<bool>,
}

impl Reweighing {
    /// That of a result; none where it has no repaired spectra.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn from_result(file: &ResultFile) -> Result<Option<Self>, UniformRiskError> {
        if !file.has_repair() {
            return Ok(None);
        }
        Self::from_question(Question::from_result(file)?).map(Some)
    }

    /// That of the motions of a result, each once, whatever structures they shake; none where it has no repaired
    /// spectra.
    ///
    /// # Errors
    /// As [`from_result`](Self::from_result).
    pub fn from_motions(file: &ResultFile) -> Result<Option<Self>, UniformRiskError> {
        if !file.has_repair() {
            return Ok(None);
        }
        Self::from_question(Question::from_motions(file)?).map(Some)
    }

    fn from_question(question: Question) -> Result<Self, UniformRiskError> {
        let (findings, branches) = (question.findings(true)?, question.findings_of_branches()?);
        Ok(Self { question, findings, branches })
    }

    /// The analysis of the records scaled to a measure at a site; none where there is no repair.
    pub fn site(&self, (measure, site): (IntensityMeasure, usize)) -> Option<RepairedAnalysis<'_>> {
        let finding = self.findings.iter().find(|own| own.site == site && own.scaled_to == measure)?;
        let curves = (self.question.curve(measure, site)?, self.question.curve(finding.other, site)?);
        Some(RepairedAnalysis { question: &self.question, finding, repaired: finding.repaired()?, curves })
    }

    /// Those of its weighted hazard curves; none where these are not repaired one by one.
    pub fn branches(&self, (measure, site): (IntensityMeasure, usize)) -> Option<Vec<ReweighedBranch<'_>>> {
        let own = self.branches.iter().find(|own| own.site == site && own.scaled_to == measure)?;
        let pairs = self.question.branch_pairs(site, measure, own.findings.first()?.other)?;
        let branches = own.findings.iter().zip(pairs).map(|(finding, (own, compared))| {
            let curves = (&own.curve, &compared.curve);
            let question = &self.question;
            let analysis = finding.repaired().map(|repaired| RepairedAnalysis { question, finding, repaired, curves });
            let analysis = analysis.ok_or_else(|| question.no_repair(finding).unwrap_or_default());
            ReweighedBranch { name: &own.name, weight: own.weight, analysis }
        });
        Some(branches.collect())
    }

    /// The weights of the whole set, by which it brings a site's hazard; none where there is no repair.
    pub fn weights(&self, measure: IntensityMeasure, site: usize) -> Option<&RunWeights> {
        Some(self.site((measure, site))?.weights())
    }

    /// Numbers by which a checkpoint knows the weights again: what the set's own repairs came to.
    pub fn numbers(&self) -> Vec<f64> {
        let mut numbers = vec![self.question.settings.smoothness];
        let of_branches = self.branches.iter().flat_map(|own| &own.findings);
        for finding in self.findings.iter().chain(of_branches) {
            numbers.push(finding.site as f64);
            numbers.extend(finding.repaired().iter().flat_map(|repaired| repaired.fit.exponents));
            numbers.extend(finding.repaired().iter().flat_map(|repaired| repaired.knot_levels));
            numbers.extend(finding.range.rates::<2>());
        }
        numbers
    }
}

impl<'a> RepairedAnalysis<'a> {
    /// The weights of the whole set.
    pub fn weights(&self) -> &'a RunWeights {
        &self.repaired.weights
    }

    /// Exact ordinates of the whole set under its own weights, m, `[strength][target]`.
    ///
    /// # Errors
    /// Demands of other records or levels, in a file that was changed.
    pub fn ordinates_of_set(
        &self,
        demands: &[PooledDemand],
        targets_per_year: &[f64],
    ) -> Result<Vec<Vec<f64>>, UniformRiskError> {
        let of_strength = |demand: &PooledDemand| {
            let ordinates = RiskCurve::weighted(demand, self.weights())?.exact_ordinates(targets_per_year)?;
            Ok(ordinates.iter().map(|ordinate| ordinate.displacement_m).collect())
        };
        demands.par_iter().map(of_strength).collect()
    }

    /// Exact ordinates of `samples` of the records, each under weights solved for it from those of the set.
    ///
    /// - `demands`: all runs of the oscillators, `[strength]`.
    /// - `targets_per_year`: target rates, 1/yr, whatever those of the study are.
    /// - `watch`: told of the samples that are done.
    ///
    /// # Errors
    /// [`JobError::Interrupted`]; demands of other records or levels, in a file that was changed.
    pub fn ordinates(
        &self,
        demands: &[PooledDemand],
        targets_per_year: &[f64],
        samples: &[RecordSample],
        watch: &dyn Watch,
    ) -> Result<Reweighed, UniformRiskError> {
        let Finding { scaled_to, other, .. } = *self.finding;
        let set = self.question.set(scaled_to, other)?;
        let analysis = self.question.analysis(self.question.levels(scaled_to), &set, self.curves)?;
        let solver = Solver::new(&analysis, self.question.settings.smoothness)?;
        let of_portion = |samples: &[RecordSample]| -> Result<Reweighed, UniformRiskError> {
            if watch.cancelled() {
                return Err(JobError::Interrupted.into());
            }
            let done = portion(&solver, &self.repaired.fit.exponents, demands, targets_per_year, samples)?;
            watch.finished(samples.len() as u64);
            Ok(done)
        };
        // after each a thread looks at whoever may stop it
        let portions: Vec<Reweighed> = samples.par_chunks(SORTED_AT_ONCE).map(of_portion).collect::<Result<_, _>>()?;
        Ok(Reweighed::joined(portions, demands.len() * targets_per_year.len()))
    }
}

fn portion(
    solver: &Solver<'_>,
    start: &Exponents,
    demands: &[PooledDemand],
    targets_per_year: &[f64],
    samples: &[RecordSample],
) -> Result<Reweighed, UniformRiskError> {
    let mut scratch = Scratch::default();
    let mut is_reached = Vec::with_capacity(samples.len());
    let stripes = solver.analysis().stripes();
    let ordinates_m = weighted_replicates(demands, stripes, targets_per_year, samples, |sample, shares| {
        let fit = solver.solve_sample(sample.multiplicities(), start, &mut scratch)?;
        is_reached.push(fit.is_reached());
        Ok::<_, UniformRiskError>(solver.shares(sample.multiplicities(), &fit.exponents, &mut scratch, shares)?)
    })?;
    Ok(Reweighed { ordinates_m, is_reached })
}

impl Reweighed {
    /// Portions of samples side by side again, of so many `rows` each.
    fn joined(portions: Vec<Self>, rows: usize) -> Self {
        let samples = portions.iter().map(|portion| portion.is_reached.len()).sum();
        let mut joined = Self { ordinates_m: vec![0.0; rows * samples], is_reached: Vec::with_capacity(samples) };
        for portion in portions {
            let (first, count) = (joined.is_reached.len(), portion.is_reached.len());
            for (row, ordinates_m) in portion.ordinates_m.chunks_exact(count).enumerate() {
                joined.ordinates_m[row * samples + first..][..count].copy_from_slice(ordinates_m);
            }
            joined.is_reached.extend(portion.is_reached);
        }
        joined
    }
}
