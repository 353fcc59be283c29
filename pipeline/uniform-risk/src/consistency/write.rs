//! Consistency in the result file, and as a table beside it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_consistency::{DEVIATION_RATES, KNOTS};
use uplift_job::outputs::beside;
use uplift_job::table::ColumnsOf;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::IntensityMeasure;
use uplift_result::declared::of_measure;
use uplift_result::layout::axis;
use uplift_result::{
    CONSISTENCY, DIAGNOSES, Fit, REPAIRED_EPISTEMIC, REPAIRED_EPISTEMIC_SPECTRA, REPAIRED_FITS, REPAIRED_LEVELS,
    REPAIRED_SPECTRA, REPAIRS, WEIGHTS, consistency_names, sign,
};

use super::asked::{by_site, stored};
use super::{ConsistencyReport, ConsistencyRow, Finding, Question, Repairs, TargetRow};
use crate::{BRANCHES, write_branch_spectra};

/// The groups and axes that a new look replaces.
pub fn replaced() -> Vec<String> {
    let axes = [axis::RATE.name, axis::KNOT.name].map(axis::path);
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
    axis::RATE.write(writer, &[], &rates)?;
    let knots: Vec<u32> = (1..).take(KNOTS).collect();
    axis::KNOT.write(writer, &[], &knots)?;
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
    let (names, level) = (consistency_names(measure, other), axis::STRIPE_LEVEL.of_measure(measure));
    let strengths = repairs.map_or(0, |repairs| repairs.ordinates.shape()[2]);
    let lengths = [
        (axis::SITE.name, sites),
        (axis::RATE.name, DEVIATION_RATES),
        (axis::POE.name, poes),
        (axis::STRENGTH.name, strengths),
        (axis::KNOT.name, KNOTS),
        (level.as_str(), levels),
        (axis::RECORD.name, question.records.len()),
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
    let targets = report.rows.iter().flat_map(|row| row.targets.iter().map(move |target| (row, target)));
    let repaired = |(row, target): (&ConsistencyRow, &TargetRow), value: fn(&TargetRow) -> Option<f64>| {
        value(row.repair.as_ref()?.targets.iter().find(|own| own.poe.to_bits() == target.poe.to_bits())?)
    };
    ColumnsOf::new(targets)
        .with("site", |(row, _)| row.site.as_str())
        .with("scaled_to", |(row, _)| row.scaled_to)
        .with("shows", |(row, _)| row.shows)
        .with("unit", |(row, _)| row.unit)
        .with("poe", |(_, target)| target.poe)
        .with("years", |_| report.years)
        .with("site_level", |(_, target)| target.site_level)
        .with("implied_level", |(_, target)| target.implied_level)
        .with("ratio", |(_, target)| target.ratio)
        .with("times_as_often", |(_, target)| target.times_as_often)
        .with("bias", |(row, _)| row.bias)
        .with("rms", |(row, _)| row.rms)
        .with("max", |(row, _)| row.max)
        .with("verdict", |(row, _)| row.verdict.unwrap_or_default())
        .with("scale_factor_05", |(_, target)| target.scale_factors[0])
        .with("scale_factor_50", |(_, target)| target.scale_factors[1])
        .with("scale_factor_95", |(_, target)| target.scale_factors[2])
        .with("scale_factors_outside", |(_, target)| target.outside_limits)
        .with("effective_records", |(_, target)| target.effective_records)
        .with("effective_events", |(_, target)| target.effective_events)
        .with("repaired_ratio", |at| repaired(at, |target| target.ratio))
        .with("repaired_effective_records", |at| repaired(at, |target| Some(target.effective_records)))
        .with("repaired_effective_events", |at| repaired(at, |target| target.effective_events))
        .build()
}
