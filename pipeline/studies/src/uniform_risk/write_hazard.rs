//! Hazard curves in the result file.

use std::collections::BTreeSet;
use std::path::Path;

use uplift_hazard::HazardCurve;
use uplift_inputs::{HazardInput, OtherHazard, SiteHazard};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::layout::attribute::curve as attribute;
use uplift_result::layout::axis;
use uplift_result::{HAZARD_CURVE, branch_curve_name, curve_name};

/// Write the curves `[measure][site]` with their branches.
pub(super) fn write_hazard(writer: &mut LabelledWriter, hazard: &[Vec<SiteHazard>]) -> Result<(), LabelledError> {
    let mut axes = BTreeSet::new();
    for site in hazard.iter().flatten() {
        let label = site.measure.label();
        let axis = axis::hazard(&site.site, site.measure, &mut axes);
        write_curve(writer, curve_and_file(&site.curve), &curve_name(&site.site, site.measure), &axis, label)?;
        for (index, branch) in site.branches.iter().enumerate() {
            let name = branch_curve_name(&site.site, site.measure, index);
            write_curve(writer, curve_and_file(&branch.input), &name, &format!("{axis}_{}", index + 1), label)?;
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

fn curve_and_file(input: &HazardInput) -> (&HazardCurve, Option<&Path>) {
    (&input.curve, input.file.as_deref())
}
