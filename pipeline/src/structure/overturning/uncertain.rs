//! Overturning of the structures that one may be.

use uplift_ida::System;
use uplift_structure::UncertainQuantity;
use uplift_study::{Structure, Uncertainty, UniformRiskStudy};

use crate::analysis::Analysed;
use crate::error::UpliftError;
use crate::inputs::RecordSet;
use crate::result::{ResultFile, SpectraOfResult};
use crate::structure::certainty::Scatter;
use crate::structure::uncertain::{AskedSite, Event, Uncertain, UncertaintyReport};
use crate::uniform_risk::Stripes;

/// The structures that `structure` may be, whose `oscillator` is that of the structure as described; none where all of
/// it is known.
///
/// # Errors
/// A structure that cannot be; one restitution for all where the file says that it is uncertain.
pub(super) fn structures<'a>(
    structure: &'a Structure,
    for_both: Option<f64>,
    (oscillator, set): (&System, &RecordSet),
) -> Result<Option<Uncertain<'a>>, UpliftError> {
    let is_uncertain = |of: &Uncertainty| of.quantities.contains(&UncertainQuantity::Restitution);
    if for_both.is_some() && structure.uncertainty.as_ref().is_some_and(is_uncertain) {
        return Err(UpliftError::Usage(format!(
            "--restitution: {} says that the restitution is uncertain: leave the option out, or \
             [uncertainty.restitution]",
            structure.file.display()
        )));
    }
    Uncertain::of(structure, oscillator.restitution(), set.records.len())
}

/// What the stripes of the structures say by each of `measures`, at each of the sites with their places; `described` is
/// the frequency for the structure as described, by the positions of measure and site.
///
/// # Errors
/// A file that is damaged; parts that do not belong together.
pub(super) fn report(
    uncertain: &Uncertain<'_>,
    file: &ResultFile,
    (measures, sites): (&[&SpectraOfResult], &[(&str, usize)]),
    (analysed, (study, set, scatter)): (impl Iterator<Item = Analysed>, (&UniformRiskStudy, &RecordSet, &Scatter)),
    described: &dyn Fn(usize, usize) -> f64,
) -> Result<UncertaintyReport, UpliftError> {
    let (mut results, mut analyses) = (Vec::new(), 0);
    for ((index, measure), analysed) in measures.iter().enumerate().zip(analysed) {
        let mut asked = Vec::new();
        for (place, site) in sites.iter().enumerate() {
            let of_site = vec![(Event::Overturning, described(index, place))];
            asked.push(AskedSite::of(file, *site, (measure, study), of_site)?);
        }
        analyses += analysed.analyses;
        results.extend(uncertain.results(&Stripes::of(&measure.plan, set, analysed), &asked, scatter)?);
    }
    Ok(uncertain.report(analyses, results))
}
