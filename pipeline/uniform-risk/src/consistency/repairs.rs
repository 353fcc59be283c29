//! What repaired weights make of a set: its spectra, and how many of its records still count.

use rayon::prelude::*;
use uplift_job::Array;
use uplift_motion::IntensityMeasure;
use uplift_regression::ExponentialFit;
use uplift_result::{BranchSpectra, ResultFile, StoredConsistency};
use uplift_risk::{Ordinate, PooledDemand, RiskCurve, RunWeights};
use uplift_study::UniformRiskStudy;

use super::{BranchFindings, Finding, Question};
use crate::coefficients::fit_ordinates;
use crate::epistemic::branch_spectra;
use crate::error::UniformRiskError;
use crate::spectra::Reading;
use crate::stored_stripes::{StoredMeasure, StoredStripes};

/// The repaired spectra of one measure.
#[derive(Debug, Clone)]
pub struct Repairs {
    /// The measure that the records are scaled to.
    pub measure: IntensityMeasure,
    /// Ordinates `[site, poe, strength]`; none where the set could not be repaired.
    pub ordinates: Array<3, Option<Ordinate>>,
    /// Fits of Eq. 4.11 `[site, poe]`, or why there is none.
    pub fits: Array<2, Result<ExponentialFit, String>>,
    /// Spectra of weighted hazard curves, each repaired by itself; NaN where one could not be.
    pub branches: Vec<BranchSpectra>,
}

/// The spectra of the weights in `findings`, and of those of `branches`, of the analysis by `measure`, read as `study`
/// says; `demand` pools that of a strength.
///
/// # Errors
/// Demands that are not demands, in a file that was changed.
pub(super) fn repaired_spectra(
    study: &UniformRiskStudy,
    measure: IntensityMeasure,
    (findings, branches): (&[Finding], &[BranchFindings]),
    demand: impl Fn(usize) -> Result<PooledDemand, UniformRiskError> + Sync,
) -> Result<Repairs, UniformRiskError> {
    let reading = Reading::from_study(study)?;
    let (sites, targets, strengths) = (study.sites.len(), reading.targets.len(), study.strengths.len());
    let of_site = |site: usize| findings.iter().find(|own| own.site == site && own.scaled_to == measure);
    let of_sites = (0..sites).map(|site| Some(&of_site(site)?.repaired()?.weights));
    let branches: Vec<&BranchFindings> = branches.iter().filter(|own| own.scaled_to == measure).collect();
    let of_branches = branches.iter().flat_map(|own| own.findings.iter().map(|own| Some(&own.repaired()?.weights)));
    // sites first, then the branches one after the other
    let weights: Vec<Option<&RunWeights>> = of_sites.chain(of_branches).collect();
    let of_strength = |strength: usize| -> Result<Vec<Option<Vec<Ordinate>>>, UniformRiskError> {
        let demand = demand(strength)?;
        let read = |weights: &RunWeights| Ok(reading.ordinates(&RiskCurve::weighted(&demand, weights)?)?);
        weights.iter().map(|weights| weights.map(read).transpose()).collect()
    };
    let by_strength = (0..strengths).into_par_iter().map(of_strength).collect::<Result<Vec<_>, UniformRiskError>>()?;
    let ordinates = Array::from_fn([sites, targets, strengths], |[site, poe, strength]| {
        by_strength[strength][site].as_ref().map(|of| of[poe])
    });
    let fits = Array::from_fn([sites, targets], |at| {
        let u_m: Option<Vec<f64>> =
            ordinates.block(at).iter().map(|ordinate| ordinate.map(|ordinate| ordinate.displacement_m)).collect();
        let u_m = u_m.ok_or_else(|| "the set could not be repaired".to_owned())?;
        fit_ordinates(&study.strengths, &u_m, study.regression.strength_above)
    });
    let mut first = sites;
    let mut spectra_of = |own: &&BranchFindings| {
        let begin = first;
        first += own.findings.len();
        let spectra_m = Array::from_fn([own.findings.len(), targets, strengths], |[branch, poe, strength]| {
            by_strength[strength][begin + branch].as_ref().map_or(f64::NAN, |of| of[poe].displacement_m)
        });
        branch_spectra(own.site, own.names.clone(), own.weights.clone(), spectra_m)
    };
    let branches = branches.iter().map(&mut spectra_of).collect();
    Ok(Repairs { measure, ordinates, fits, branches })
}

/// The repaired spectra of every measure of a result, at the risks of `question`.
///
/// # Errors
/// Demands that are none, in a file that was changed.
pub(super) fn repairs_from_result(
    file: &ResultFile,
    stored: &StoredStripes,
    question: &Question,
    findings: &[Finding],
) -> Result<Vec<Repairs>, UniformRiskError> {
    let mut study = file.stored_study()?;
    (study.risk.poe, study.risk.years) = (question.poes.clone(), question.years);
    let branches = question.findings_of_branches()?;
    let of_measure = |measure: &StoredMeasure| {
        repaired_spectra(&study, measure.measure, (findings, &branches), |strength| measure.demand(strength))
    };
    stored.measures.iter().map(of_measure).collect()
}

/// Fewest effective records at a level within the rates compared `[site]`; NaN where there is no repair, none before
/// one.
///
/// # Errors
/// A `file` that is damaged, or of another kind.
pub fn least_effective(file: &ResultFile, of: &StoredConsistency) -> Result<Option<Vec<f64>>, UniformRiskError> {
    let Some(records) = &of.effective_records else { return Ok(None) };
    let levels = file.levels()?.into_iter().find(|(measure, _)| *measure == of.scaled_to);
    let levels = levels.map_or_else(Vec::new, |(_, levels)| levels);
    let extrapolation = file.stored_study()?.risk.extrapolate;
    let of_site = |(site, name): (usize, &String)| {
        let Some(curve) = file.mean_curve(name, of.scaled_to)? else { return Ok(f64::NAN) };
        let [high, .., low] = of.rate_per_year.block([site]) else { return Ok(f64::NAN) };
        let is_compared = |level: f64| {
            let rate = curve.rate_at_extrapolated(level, extrapolation);
            rate.is_ok_and(|rate| *low <= rate && rate <= *high)
        };
        let compared = levels.iter().zip(records.block([site])).filter(|(level, _)| is_compared(**level));
        // the least of none, and of numbers that are none, is none
        Ok(compared.map(|(_, records)| *records).fold(f64::NAN, f64::min))
    };
    file.axes()?.sites.iter().enumerate().map(of_site).collect::<Result<_, _>>().map(Some)
}
