//! Hazard curves in the result file, and the spectra of weighted ones.

use std::collections::BTreeSet;

use uplift_labelled::{LabelledError, LabelledWriter};

use super::{FRACTILES, Outcome, Spectra};
use crate::inputs::{HazardInput, SiteHazard};
use crate::result::{axis_part, branch_group, unique_axis};

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

/// Name of an axis of a site and measure: lower-case ASCII, whatever the site is called.
fn axis_name(what: &str, site: &str, measure: &str, taken: &mut BTreeSet<String>) -> String {
    unique_axis(format!("{what}_{}_{measure}", axis_part(site)), taken)
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
