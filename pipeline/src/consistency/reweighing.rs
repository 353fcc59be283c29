//! The spectra of a repaired set for other samples of its records: each gets weights of its own, solved anew.

use rayon::prelude::*;
use uplift_bootstrap::weighted_replicates;
use uplift_consistency::{Exponents, RecordSet as ScaledSet, Repaired, ScaledAnalysis, Scratch, Solver};
use uplift_motion::IntensityMeasure;
use uplift_risk::{PooledDemand, REPLICATES_AT_ONCE, RecordSample, RiskCurve, RunWeights};

use super::{Finding, Question};
use crate::error::UpliftError;
use crate::result::ResultFile;

/// Samples that a thread weighs before another look at whoever may stop it.
const PORTION: usize = 8 * REPLICATES_AT_ONCE;

/// The repaired analyses of a result, with all that weighs their records anew.
pub(crate) struct Reweighing {
    question: Question,
    findings: Vec<Finding>,
}

/// The ordinates of samples that were weighed anew.
pub(crate) struct Reweighed {
    /// Exact ordinates `[strength, target, sample]`, m.
    pub(crate) ordinates_m: Vec<f64>,
    /// Whether the weights of a sample bring the site's hazard `[sample]`; the others keep the best that was found.
    pub(crate) is_reached: Vec<bool>,
}

impl Reweighing {
    /// That of a result; none where it has no repaired spectra.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub(crate) fn of_result(file: &ResultFile) -> Result<Option<Self>, UpliftError> {
        if !file.has_repair() {
            return Ok(None);
        }
        let question = Question::of_result(file)?;
        let findings = question.findings(true)?;
        Ok(Some(Self { question, findings }))
    }

    /// The repaired analysis of the records scaled to `measure` at a site.
    fn repaired(&self, measure: IntensityMeasure, site: usize) -> Option<(&Finding, &Repaired)> {
        let finding = self.findings.iter().find(|own| own.site == site && own.scaled_to == measure)?;
        Some((finding, finding.repaired()?))
    }

    /// The weights of the whole set, by which it brings a site's hazard; none where there is no repair.
    pub(crate) fn weights(&self, measure: IntensityMeasure, site: usize) -> Option<&RunWeights> {
        Some(&self.repaired(measure, site)?.1.weights)
    }

    /// Numbers by which a checkpoint knows the weights again: what the set's own repair came to.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let mut numbers = vec![self.question.settings.smoothness];
        for finding in &self.findings {
            numbers.push(finding.site as f64);
            numbers.extend(finding.repaired().iter().flat_map(|repaired| repaired.fit.exponents));
            numbers.extend(finding.repaired().iter().flat_map(|repaired| repaired.knot_levels));
            numbers.extend(finding.range.rates::<2>());
        }
        numbers
    }

    /// Exact ordinates of the whole set under its own weights, m, `[strength][target]`; none where there is no repair.
    ///
    /// # Errors
    /// Demands of other records or levels, in a file that was changed.
    pub(crate) fn ordinates_of_set(
        &self,
        (measure, site): (IntensityMeasure, usize),
        demands: &[PooledDemand],
        targets_per_year: &[f64],
    ) -> Result<Option<Vec<Vec<f64>>>, UpliftError> {
        let Some(weights) = self.weights(measure, site) else { return Ok(None) };
        let of_strength = |demand: &PooledDemand| {
            let ordinates = RiskCurve::weighted(demand, weights)?.exact_ordinates(targets_per_year)?;
            Ok(ordinates.iter().map(|ordinate| ordinate.displacement_m).collect())
        };
        demands.par_iter().map(of_strength).collect::<Result<_, UpliftError>>().map(Some)
    }

    /// Exact ordinates of `samples` of the records, each under weights solved for it from those of the set; none where
    /// there is no repair.
    ///
    /// - `demands`: all runs of the oscillators, `[strength]`.
    /// - `targets_per_year`: target rates, 1/yr, whatever those of the study are.
    /// - `is_cancelled`: asked now and then.
    ///
    /// # Errors
    /// [`UpliftError::Interrupted`]; demands of other records or levels, in a file that was changed.
    pub(crate) fn ordinates(
        &self,
        (measure, site): (IntensityMeasure, usize),
        demands: &[PooledDemand],
        targets_per_year: &[f64],
        samples: &[RecordSample],
        is_cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Reweighed>, UpliftError> {
        let Some((finding, repaired)) = self.repaired(measure, site) else { return Ok(None) };
        let set = self.question.set(measure, finding.other)?;
        let Some(analysis) = self.analysis(finding, &set)? else { return Ok(None) };
        let solver = Solver::new(&analysis, self.question.settings.smoothness)?;
        let of_portion = |samples: &[RecordSample]| {
            if is_cancelled() {
                return Err(UpliftError::Interrupted);
            }
            portion(&solver, &repaired.fit.exponents, demands, targets_per_year, samples)
        };
        let portions: Vec<Reweighed> = samples.par_chunks(PORTION).map(of_portion).collect::<Result<_, _>>()?;
        Ok(Some(Reweighed::joined(portions, demands.len() * targets_per_year.len())))
    }

    fn analysis<'a>(
        &'a self,
        finding: &Finding,
        set: &'a ScaledSet,
    ) -> Result<Option<ScaledAnalysis<'a>>, UpliftError> {
        let levels = self.question.analyses.iter().find(|(measure, _)| *measure == finding.scaled_to);
        let Some((_, levels)) = levels else { return Ok(None) };
        self.question.analysis(finding.site, (finding.scaled_to, levels), finding.other, set)
    }
}

fn portion(
    solver: &Solver<'_>,
    start: &Exponents,
    demands: &[PooledDemand],
    targets_per_year: &[f64],
    samples: &[RecordSample],
) -> Result<Reweighed, UpliftError> {
    let mut scratch = Scratch::default();
    let mut is_reached = Vec::with_capacity(samples.len());
    let stripes = solver.analysis().stripes();
    let ordinates_m = weighted_replicates(demands, stripes, targets_per_year, samples, |sample, shares| {
        let fit = solver.solve(sample.multiplicities(), start, &mut scratch)?;
        is_reached.push(fit.is_reached());
        Ok::<_, UpliftError>(solver.shares(sample.multiplicities(), &fit.exponents, &mut scratch, shares)?)
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
