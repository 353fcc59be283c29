//! Hazard curves in the result file, and the spectra of weighted ones.

use std::collections::BTreeSet;

use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;

use super::Outcome;
use crate::error::UpliftError;
use crate::inputs::{HazardInput, SiteHazard};
use crate::labelled::{LabelledError, LabelledReader, LabelledWriter};
use crate::stages::{FRACTILES, Spectra};

/// Write the curves `[measure][site]` with their branches.
pub(super) fn write_hazard(writer: &mut LabelledWriter, hazard: &[Vec<SiteHazard>]) -> Result<(), LabelledError> {
    let mut axes = BTreeSet::new();
    for site in hazard.iter().flatten() {
        let (key, label) = (site.measure.key(), site.measure.label());
        let group = format!("/hazard/{}/{key}", site.site);
        let axis = axis_name("hazard", &site.site, key, &mut axes);
        write_curve(writer, &site.curve, &group, &axis, label)?;
        for (index, branch) in site.branches.iter().enumerate() {
            let group = branch_group(&site.site, key, index);
            write_curve(writer, &branch.input, &group, &format!("{axis}_{}", index + 1), label)?;
            writer.attribute(&group, "name", branch.name.as_str())?;
            writer.attribute(&group, "weight", branch.weight)?;
        }
    }
    Ok(())
}

/// Where the branch at `index` of a site and measure is.
pub(super) fn branch_group(site: &str, measure: &str, index: usize) -> String {
    format!("/hazard/{site}/{measure}/branches/{}", index + 1)
}

fn write_curve(
    writer: &mut LabelledWriter,
    input: &HazardInput,
    group: &str,
    axis: &str,
    label: &str,
) -> Result<(), LabelledError> {
    let curve = &input.curve;
    writer.axis_f64(axis, curve.im(), curve.unit(), &format!("{label} of the hazard curve"))?;
    let path = format!("{group}/maf_per_year");
    writer.array_f64(&path, &[axis], curve.maf(), "1/yr", "mean annual frequency of exceedance")?;
    let file = input.file.as_ref().map(|file| file.display().to_string()).unwrap_or_default();
    writer.attribute(group, "source", curve.source())?;
    writer.attribute(group, "file", file.as_str())?;
    writer.attribute(group, "unit", curve.unit())
}

/// The curve in the group `group`, by the measure `measure`.
///
/// # Errors
/// A file that is damaged.
pub(super) fn read_curve(
    reader: &LabelledReader,
    group: &str,
    measure: IntensityMeasure,
) -> Result<HazardCurve, UpliftError> {
    let fail = |reason: String| UpliftError::input(format!("{}: {group}{reason}", reader.path().display()));
    let maf = reader.array_f64(&format!("{group}/maf_per_year"))?;
    let im = match &maf.dims[..] {
        [axis] => reader.axis_f64(axis)?,
        _ => return Err(fail("/maf_per_year is no curve".to_owned())),
    };
    HazardCurve::new(measure.label(), measure.unit(), "", im, maf.values).map_err(|error| fail(format!(": {error}")))
}

/// Name of an axis of a site and measure: lower-case ASCII, whatever the site is called.
fn axis_name(what: &str, site: &str, measure: &str, taken: &mut BTreeSet<String>) -> String {
    unique_axis(format!("{what}_{}_{measure}", axis_part(site)), taken)
}

/// As much of a name as an axis name can hold: lower-case ASCII.
pub(crate) fn axis_part(name: &str) -> String {
    let fit = |character: char| if character.is_ascii_alphanumeric() { character } else { '_' };
    name.to_lowercase().chars().take(40).map(fit).collect()
}

/// The name of an axis, longer where it is taken: by a name that differs only in what an axis name cannot hold.
pub(crate) fn unique_axis(mut axis: String, taken: &mut BTreeSet<String>) -> String {
    while !taken.insert(axis.clone()) {
        axis.push('x');
    }
    axis
}

/// Write the spectra of the branches of `spectra`, their mean and their fractiles.
pub(super) fn write_branches(
    writer: &mut LabelledWriter,
    outcome: &Outcome<'_>,
    spectra: &Spectra,
) -> Result<(), LabelledError> {
    let key = spectra.measure.key();
    let mut axes = BTreeSet::new();
    for branches in &spectra.branches {
        let site = &outcome.study.sites[branches.site].name;
        let axis = axis_name("branch", site, key, &mut axes);
        writer.axis_text(&axis, &branches.names, "branch of the hazard")?;
        let group = format!("/epistemic/{key}/{site}");
        writer.array_f64(&format!("{group}/weight"), &[&axis], &branches.weights, "1", "weight of the branch")?;
        let long_name = "uniform risk displacement by the branch";
        writer.array_f64(&format!("{group}/u_m"), &[&axis, "poe", "strength"], &branches.spectra_m, "m", long_name)?;
        let dims = ["poe", "strength"];
        writer.array_f64(
            &format!("{group}/mean_m"),
            &dims,
            &branches.mean_m,
            "m",
            "weighted mean over the branches",
        )?;
        for (fractile, values) in FRACTILES.iter().zip(&branches.fractiles_m) {
            let percent = (100.0 * fractile).round();
            let long_name = format!("{percent} % fractile over the branches");
            writer.array_f64(&format!("{group}/u{percent:02}_m"), &dims, values, "m", &long_name)?;
        }
    }
    Ok(())
}
