//! The risk of a structure of which not all is known exactly: by the structures that it may be, drawn inside the
//! stripes (docs/method.md, section 19).

mod around;
mod branches;
mod draws;
mod question;
mod report;
mod words;

use uplift_ida::System;
use uplift_structure::{EquivalentSystem, Realization};
use uplift_study::{MeasurePlan, Structure, Uncertainty, UncertaintyKind, UniformRiskStudy};

pub(super) use around::Around;
pub(super) use question::{Event, SiteQuestions};
pub(super) use report::PERCENTILES;
pub use report::{
    AleatoryResult, EpistemicResult, QuantityReport, Spread, UncertainFinding, UncertainResult, UncertaintyReport,
    VarianceShare,
};

use super::certainty::Scatter;
use super::opening::ShakenRecords;
use crate::error::DesignError;
use branches::Branches;
use uplift_engine::analysis::LabelledPlan;
use uplift_job::JobError;
use uplift_job::alarm::Severity;
use uplift_job::text::{counted, thousands};
use uplift_uniform_risk::{Stripes, at_most_per_year, plan_stripes};

/// The structures that one may be, as the oscillators that are shaken.
#[derive(Debug)]
pub(super) struct Uncertain<'a> {
    of: &'a Uncertainty,
    /// Factor Γ from the oscillators to the structure.
    participation: f64,
    /// Those of branches, each once; or those of each record, one record after the other.
    systems: Vec<System>,
    /// Which of them are branches; none where each record has its own.
    branches: Option<Branches>,
}

impl<'a> Uncertain<'a> {
    /// The structures that `structure` may be, whose impacts keep `restitution` of the velocity where that is known,
    /// under so many records; none where all of it is known.
    pub(super) fn from_structure(
        structure: &'a Structure,
        restitution: f64,
        records: usize,
    ) -> Result<Option<Self>, DesignError> {
        let Some(of) = &structure.uncertainty else { return Ok(None) };
        let realize = |point: &[f64]| realized((structure, &structure.system), of, restitution, point);
        let (systems, branches) = match of.kind {
            UncertaintyKind::Epistemic => {
                let (systems, branches) = Branches::draw(of, &realize)?;
                (systems, Some(branches))
            }
            UncertaintyKind::Aleatory => {
                let points = draws::points(of, records, &structure.file)?;
                (points.iter().map(|point| realize(point)).collect::<Result<_, _>>()?, None)
            }
        };
        Ok(Some(Self { of, participation: structure.system.participation(), systems, branches }))
    }

    /// The stripes of one measure, with what they cost.
    pub(super) fn plan<'b>(
        &'b self,
        (label, study): (&str, &UniformRiskStudy),
        measure: &MeasurePlan,
        records: &'b ShakenRecords,
    ) -> Result<LabelledPlan<'b>, DesignError> {
        let plan = plan_stripes(study, measure, &records.set, &self.systems)?;
        let plan = if self.branches.is_none() { plan.with_own_systems()? } else { plan };
        let axes = plan.axes();
        let whose = if self.branches.is_none() { "structures of each record" } else { "structures" };
        let cost = format!(
            "{label}: {} {whose} x {} x {}, {} analyses",
            thousands(axes.systems as u64),
            counted(axes.motions, "record"),
            counted(axes.scales, "level"),
            thousands(plan.analyses())
        );
        let remark = Some(("uncertainty".to_owned(), cost));
        Ok(LabelledPlan { label: format!("{label}, uncertain"), remark, plan, motions: &records.motions, known: None })
    }

    /// What the stripes of a measure say, `[site, asked]`.
    pub(super) fn results(
        &self,
        stripes: &Stripes,
        sites: &[SiteQuestions<'_>],
        scatter: &Scatter,
    ) -> Result<Vec<UncertainResult>, DesignError> {
        let shaken = (&self.systems[..], self.participation);
        let findings = match &self.branches {
            Some(branches) => branches.findings(shaken, self.of.seed, (stripes, sites), scatter)?,
            None => draws::findings(shaken, stripes, sites, scatter)?,
        };
        let asked = sites.iter().flat_map(|site| site.asked.iter().map(move |asked| (site, asked)));
        let result =
            |((site, (event, as_described)), found): ((&SiteQuestions<'_>, &(Event, f64)), UncertainFinding)| {
                let may_happen = self.systems.iter().any(|system| event.may_happen(system));
                // records are counted and not structures: to the motion of a pair all its structures are one sample
                let bound = may_happen.then(|| at_most_per_year(site.hazard.mean, scatter.pairs.len() as f64));
                UncertainResult {
                    site: site.name.to_owned(),
                    im: stripes.measure.label(),
                    of: event.words(),
                    unit: event.unit(),
                    as_described: *as_described,
                    as_described_at_most_per_year: bound.filter(|_| *as_described == 0.0),
                    found: found.bounded(bound),
                }
            };
        Ok(asked.zip(findings).map(result).collect())
    }

    /// What was asked, with its `results`, from so many `analyses`.
    pub(super) fn report(&self, analyses: u64, results: Vec<UncertainResult>) -> UncertaintyReport {
        UncertaintyReport {
            kind: self.of.kind.key(),
            sampling: self.of.sampling.key(),
            seed: self.of.seed,
            structures: self.systems.len(),
            analyses,
            quantities: QuantityReport::all(self.of),
            results,
        }
    }
}

/// The oscillator of `varied` at a `point` of the unit cube: what is uncertain differs from it by the factor by which
/// it differs from the `structure` as described.
fn realized(
    (structure, varied): (&Structure, &EquivalentSystem),
    of: &Uncertainty,
    restitution: f64,
    point: &[f64],
) -> Result<System, DesignError> {
    let mut realization = Realization::default();
    let mut told = Vec::new();
    for (quantity, value) in of.quantities.iter().zip(of.vector.values(point)) {
        let [own, varied] = [&structure.system, varied].map(|system| quantity.value(system, Some(restitution)));
        // what the varied structure has not, a capacity where its force does not fall, cannot scatter
        let Some(varied) = varied else { continue };
        let value = match own {
            // what does not scatter is that of the varied structure, to the bit
            Some(own) if own.to_bits() == value.to_bits() => varied,
            Some(own) => value * (varied / own),
            None => value,
        };
        realization.set(*quantity, value);
        told.push(format!("{} {value}", quantity.key()));
    }
    let fail = |reason: String| {
        // what is probably in another unit is why, most likely
        let doubtful = structure.warnings.iter().filter(|warning| warning.unlikely);
        let word = Severity::Mistake.word();
        let asked = doubtful.fold(String::new(), |asked, of| format!("{asked}; {word} {}", of.what));
        let error = JobError::input(format!(
            "[uncertainty]: a sampled structure is invalid ({}): {reason}; use less scatter, or correlate related \
             quantities{asked}",
            told.join(", ")
        ));
        uplift_job::in_file(error, &structure.file)
    };
    let system = varied.realized(&realization).map_err(|error| fail(error.to_string()))?;
    let restitution = realization.restitution.unwrap_or(restitution);
    Ok(system.spectral_oscillator(restitution).map(System::Oscillator).map_err(|error| fail(error.to_string()))?)
}

#[cfg(test)]
mod tests;
