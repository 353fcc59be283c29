//! Overturning of the structures that one may be.

use uplift_engine::analysis::Analysed;
use uplift_ida::System;
use uplift_inputs::RecordSet;
use uplift_job::JobError;
use uplift_structure::UncertainQuantity;
use uplift_study::{Structure, Uncertainty};
use uplift_uniform_risk::{SpectraOfResult, Stripes};

use crate::certainty::Scatter;
use crate::error::DesignError;
use crate::hazard::Hazard;
use crate::uncertain::{AskedSite, Event, Uncertain, UncertaintyReport};

/// The structures that `structure` may be, whose `oscillator` is that of the structure as described; none where all of
/// it is known.
///
/// # Errors
/// A structure that cannot be; one restitution for all where the file says that it is uncertain.
pub(super) fn structures<'a>(
    structure: &'a Structure,
    for_both: Option<f64>,
    (oscillator, set): (&System, &RecordSet),
) -> Result<Option<Uncertain<'a>>, DesignError> {
    let is_uncertain = |of: &Uncertainty| of.quantities.contains(&UncertainQuantity::Restitution);
    if for_both.is_some() && structure.uncertainty.as_ref().is_some_and(is_uncertain) {
        return Err(JobError::Usage(format!(
            "--restitution: {} says that the restitution is uncertain: leave the option out, or \
             [uncertainty.restitution]",
            structure.file.display()
        ))
        .into());
    }
    Uncertain::of(structure, oscillator.restitution(), set.records.len())
}

/// What the stripes of the structures say by each of `measures`, with the hazard of each of the sites; `described` is
/// the frequency for the structure as described, by the positions of measure and site.
///
/// # Errors
/// Parts that do not belong together.
pub(super) fn report(
    uncertain: &Uncertain<'_>,
    (measures, sites): (&[(&SpectraOfResult, &[Hazard<'_>])], &[&str]),
    (analysed, (set, scatter)): (impl Iterator<Item = Analysed>, (&RecordSet, &Scatter)),
    described: &dyn Fn(usize, usize) -> f64,
) -> Result<UncertaintyReport, DesignError> {
    let (mut results, mut analyses) = (Vec::new(), 0);
    for ((index, (measure, hazard)), analysed) in measures.iter().enumerate().zip(analysed) {
        let asked = sites.iter().zip(*hazard).enumerate().map(|(place, (&name, hazard))| AskedSite {
            name,
            hazard,
            asked: vec![(Event::Overturning, described(index, place))],
        });
        let asked: Vec<AskedSite<'_>> = asked.collect();
        analyses += analysed.analyses;
        results.extend(uncertain.results(&Stripes::of(&measure.plan, set, analysed), &asked, scatter)?);
    }
    Ok(uncertain.report(analyses, results))
}
