//! Hazard curves in the result file, and the spectra of weighted ones.

use std::collections::BTreeSet;
use std::path::Path;

use uplift_hazard::HazardCurve;
use uplift_inputs::{HazardInput, OtherHazard, SiteHazard};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::declared::of_measure;
use uplift_result::layout::attribute::curve as attribute;
use uplift_result::layout::axis;
use uplift_result::{
    BRANCH_WEIGHTS, EPISTEMIC, EPISTEMIC_SPECTRA, HAZARD_CURVE, UNCERTAINTY, UNCERTAINTY_SPECTRA, branch_curve_name,
    curve_name,
};
use uplift_uniform_risk::{BRANCHES, Spectra, write_branch_spectra};

use super::ComputedStudy;

/// Write the curves `[measure][site]` with their branches.
pub(super) fn write_hazard(writer: &mut LabelledWriter, hazard: &[Vec<SiteHazard>]) -> Result<(), LabelledError> {
    let mut axes = BTreeSet::new();
    for site in hazard.iter().flatten() {
        let label = site.measure.label();
        let axis = axis::hazard(&site.site, site.measure, &mut axes);
        write_curve(writer, of_input(&site.curve), &curve_name(&site.site, site.measure), &axis, label)?;
        for (index, branch) in site.branches.iter().enumerate() {
            let name = branch_curve_name(&site.site, site.measure, index);
            write_curve(writer, of_input(&branch.input), &name, &format!("{axis}_{}", index + 1), label)?;
            attribute::NAME.write(writer, &[("<curve>", &name)], branch.name.as_str())?;
            attribute::WEIGHT.write(writer, &[("<curve>", &name)], branch.weight)?;
        }
    }
    Ok(())
}

/// Write the curves of measures that the study is not analysed by.
pub(super) fn write_other_hazard(writer: &mut LabelledWriter, hazard: &[OtherHazard]) -> Result<(), LabelledError> {
    let mut axes = BTreeSet::new();
    for other in hazard {
        let axis = axis::hazard(&other.site, other.measure, &mut axes);
        let file = other.file.as_deref();
        let name = curve_name(&other.site, other.measure);
        write_curve(writer, (&other.curve, file), &name, &axis, other.measure.label())?;
    }
    Ok(())
}

/// Write a curve of this name.
fn write_curve(
    writer: &mut LabelledWriter,
    (curve, file): (&HazardCurve, Option<&Path>),
    name: &str,
    axis: &str,
    label: &str,
) -> Result<(), LabelledError> {
    let names = [("<curve>", name), ("<axis>", axis), ("<unit>", curve.unit()), ("<label>", label)];
    axis::HAZARD.write(writer, &names, curve.im())?;
    HAZARD_CURVE.write(writer, &names, &[(axis, curve.maf().len())], curve)?;
    let file = file.map(|file| file.display().to_string()).unwrap_or_default();
    attribute::SOURCE.write(writer, &names, curve.source())?;
    attribute::FILE.write(writer, &names, file)?;
    attribute::UNIT.write(writer, &names, curve.unit())
}

fn of_input(input: &HazardInput) -> (&HazardCurve, Option<&Path>) {
    (&input.curve, input.file.as_deref())
}

/// Write the spectra of the branches of `spectra`, their mean and their fractiles.
pub(super) fn write_branches(
    writer: &mut LabelledWriter,
    outcome: &ComputedStudy<'_>,
    spectra: &Spectra,
) -> Result<(), LabelledError> {
    let mut axes = BTreeSet::new();
    for branches in &spectra.branches {
        let site = &outcome.study.sites[branches.site].name;
        let axis = axis::branch(site, spectra.measure, &mut axes);
        let own = [of_measure(spectra.measure)[0], ("<site>", site), ("<branches>", &axis)];
        axis::BRANCH.write_texts(writer, &own, &branches.names)?;
        BRANCH_WEIGHTS.write_array(writer, &own, &branches.weights)?;
        let groups = (&EPISTEMIC_SPECTRA, &EPISTEMIC);
        write_branch_spectra(writer, branches, groups, &[&own[..], &BRANCHES].concat())?;
    }
    Ok(())
}

/// Write the spectra of the possible structures, their mean and their fractiles.
pub(super) fn write_structures(
    writer: &mut LabelledWriter,
    outcome: &ComputedStudy<'_>,
    spectra: &Spectra,
) -> Result<(), LabelledError> {
    for structures in &spectra.structures {
        let site = &outcome.study.sites[structures.site].name;
        let words = [("<one>", "structure"), ("<many>", "structures")];
        let own = [of_measure(spectra.measure)[0], ("<site>", site), ("<branches>", axis::STRUCTURE.name)];
        let groups = (&UNCERTAINTY_SPECTRA, &UNCERTAINTY);
        write_branch_spectra(writer, structures, groups, &[own.as_slice(), &words].concat())?;
    }
    Ok(())
}
