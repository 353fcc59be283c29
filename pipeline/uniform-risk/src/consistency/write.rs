//! Consistency in the result file, and as a table beside it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_consistency::{DEVIATION_RATES, KNOTS};
use uplift_job::outputs::beside;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::IntensityMeasure;
use uplift_result::declared::of_measure;
use uplift_result::layout::axis;
use uplift_result::{
    CONSISTENCY, DIAGNOSES, Fit, REPAIRED_EPISTEMIC, REPAIRED_EPISTEMIC_SPECTRA, REPAIRED_FITS, REPAIRED_LEVELS,
    REPAIRED_SPECTRA, REPAIRS, WEIGHTS, consistency_names, sign,
};

use super::asked::{by_site, stored};
use super::{ConsistencyReport, Finding, Question, Repairs};
use crate::{BRANCHES, write_branch_spectra};

/// The groups and axes that a new look replaces.
pub fn replaced() -> Vec<String> {
    let axes = [axis::RATE, axis::KNOT].map(axis::path);
    std::iter::once(CONSISTENCY.root().to_owned()).chain(axes).collect()
}

/// The table beside the result file.
pub fn consistency_path(result: &Path) -> PathBuf {
    beside(result, "consistency.csv")
}

/// Whether the weights of all runs are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// No: they follow from the exponents.
    Exponents,
    /// Yes.
    Weights,
}

/// Adds `findings` and the spectra of their weights to a result.
///
/// # Errors
/// A file that cannot be written.
pub fn add(
    writer: &mut LabelledWriter,
    question: &Question,
    findings: &[Finding],
    repairs: &[Repairs],
    keep: Keep,
) -> Result<(), LabelledError> {
    if findings.is_empty() {
        return Ok(());
    }
    sign(writer, CONSISTENCY.root())?;
    writer.attribute(CONSISTENCY.root(), "smoothness", question.settings.smoothness)?;
    writer.attribute(CONSISTENCY.root(), "repair", if repairs.is_empty() { "none" } else { "weights" })?;
    let rates: Vec<u32> = (1..).take(DEVIATION_RATES).collect();
    writer.axis_u32(axis::RATE, &rates, "1", "annual rate at which hazards are compared, the most frequent first")?;
    let knots: Vec<u32> = (1..).take(KNOTS).collect();
    writer.axis_u32(axis::KNOT, &knots, "1", "knot of the weights' exponent")?;
    for (measure, levels) in &question.analyses {
        let own: Vec<&Finding> = findings.iter().filter(|finding| finding.scaled_to == *measure).collect();
        let repairs = repairs.iter().find(|repairs| repairs.measure == *measure);
        if !own.is_empty() {
            write_measure(writer, question, &own, (*measure, levels.len()), (repairs, keep))?;
        }
    }
    Ok(())
}

/// The arrays of one `measure`, which has so many `levels`.
fn write_measure(
    writer: &mut LabelledWriter,
    question: &Question,
    findings: &[&Finding],
    (measure, levels): (IntensityMeasure, usize),
    (repairs, keep): (Option<&Repairs>, Keep),
) -> Result<(), LabelledError> {
    let (other, sites, poes) = (findings[0].other, question.sites.len(), question.poes.len());
    let (names, level) = (consistency_names(measure, other), axis::level(measure));
    let strengths = repairs.map_or(0, |repairs| repairs.ordinates.shape()[2]);
    let lengths = [
        (axis::SITE, sites),
        (axis::RATE, DEVIATION_RATES),
        (axis::POE, poes),
        (axis::STRENGTH, strengths),
        (axis::KNOT, KNOTS),
        (level.as_str(), levels),
        (axis::RECORD, question.records.len()),
    ];
    let stored = stored(question, (measure, other), levels, (findings, findings), repairs);
    CONSISTENCY.write(writer, &names, &lengths, &stored)?;
    let findings = by_site(findings, sites);
    let diagnoses = findings.iter().map(|finding| finding.map(|finding| &finding.diagnosis));
    DIAGNOSES.write_rows(writer, &names, &lengths, diagnoses)?;
    let repaired = || findings.iter().map(|finding| finding.and_then(Finding::repaired));
    REPAIRED_LEVELS.write_rows(writer, &names, &lengths, repaired())?;
    let Some(repairs) = repairs else { return Ok(()) };
    REPAIRS.write_rows(writer, &names, &lengths, repaired())?;
    if keep == Keep::Weights {
        WEIGHTS.write_rows(writer, &names, &lengths, repaired())?;
    }
    REPAIRED_SPECTRA.write_rows(writer, &names, &lengths, repairs.ordinates.values().iter().map(Option::as_ref))?;
    let fits = repairs.fits.map(|fit| Fit::from_exponential(fit.as_ref().ok()));
    REPAIRED_FITS.write(writer, &names, &lengths, &fits)?;
    write_branches(writer, question, repairs)
}

/// The spectra of weighted hazard curves, each repaired by itself.
fn write_branches(writer: &mut LabelledWriter, question: &Question, repairs: &Repairs) -> Result<(), LabelledError> {
    let (measure, mut axes) = (repairs.measure, BTreeSet::new());
    // as the plain spectra of the branches name them, whether repaired or not
    let of_site = |site: usize| {
        let has_branches = question.branches.contains_key(&(measure, site));
        has_branches.then(|| axis::branch(&question.sites[site], measure, &mut axes))
    };
    let axes: Vec<Option<String>> = (0..question.sites.len()).map(of_site).collect();
    for branches in &repairs.branches {
        let site = &question.sites[branches.site];
        let Some(axis) = &axes[branches.site] else { continue };
        let own = [of_measure(measure)[0], ("<site>", site), ("<branches>", axis)];
        let groups = (&REPAIRED_EPISTEMIC_SPECTRA, &REPAIRED_EPISTEMIC);
        write_branch_spectra(writer, branches, groups, &[&own[..], &BRANCHES].concat())?;
    }
    Ok(())
}

/// The rows of a report as a table: a row a measure, site and probability.
pub fn columns(report: &ConsistencyReport) -> Vec<Column> {
    let targets = || report.rows.iter().flat_map(|row| row.targets.iter().map(move |target| (row, target)));
    let text =
        |value: fn(&super::ConsistencyRow) -> String| -> Vec<String> { targets().map(|(row, _)| value(row)).collect() };
    let number = |value: fn(&super::ConsistencyRow, &super::TargetRow) -> Option<f64>| -> Vec<Option<f64>> {
        targets().map(|(row, target)| value(row, target)).collect()
    };
    let repaired = |value: fn(&super::TargetRow) -> Option<f64>| -> Vec<Option<f64>> {
        let of = |(row, target): (&super::ConsistencyRow, &super::TargetRow)| {
            let own = row.repair.as_ref()?.targets.iter().find(|own| own.poe.to_bits() == target.poe.to_bits())?;
            value(own)
        };
        targets().map(of).collect()
    };
    vec![
        Column::new("site".into(), text(|row| row.site.clone())),
        Column::new("scaled_to".into(), text(|row| row.scaled_to.to_owned())),
        Column::new("shows".into(), text(|row| row.shows.to_owned())),
        Column::new("unit".into(), text(|row| row.unit.to_owned())),
        Column::new("poe".into(), number(|_, target| Some(target.poe))),
        Column::new("years".into(), vec![report.years; targets().count()]),
        Column::new("site_level".into(), number(|_, target| target.site_level)),
        Column::new("implied_level".into(), number(|_, target| Some(target.implied_level))),
        Column::new("ratio".into(), number(|_, target| target.ratio)),
        Column::new("times_as_often".into(), number(|_, target| target.times_as_often)),
        Column::new("bias".into(), number(|row, _| row.bias)),
        Column::new("rms".into(), number(|row, _| row.rms)),
        Column::new("max".into(), number(|row, _| row.max)),
        Column::new("verdict".into(), text(|row| row.verdict.unwrap_or_default().to_owned())),
        Column::new("scale_factor_05".into(), number(|_, target| Some(target.scale_factors[0]))),
        Column::new("scale_factor_50".into(), number(|_, target| Some(target.scale_factors[1]))),
        Column::new("scale_factor_95".into(), number(|_, target| Some(target.scale_factors[2]))),
        Column::new("scale_factors_outside".into(), number(|_, target| Some(target.outside_limits))),
        Column::new("effective_records".into(), number(|_, target| Some(target.effective_records))),
        Column::new("effective_events".into(), number(|_, target| target.effective_events)),
        Column::new("repaired_ratio".into(), repaired(|target| target.ratio)),
        Column::new("repaired_effective_records".into(), repaired(|target| Some(target.effective_records))),
        Column::new("repaired_effective_events".into(), repaired(|target| target.effective_events)),
    ]
}
