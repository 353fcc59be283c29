//! Hazard curves in a result file.

use std::collections::BTreeSet;

use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;

use crate::error::UpliftError;
use uplift_labelled::LabelledReader;

/// Where the branch at `index` of a site and measure is.
pub(crate) fn branch_group(site: &str, measure: &str, index: usize) -> String {
    format!("/hazard/{site}/{measure}/branches/{}", index + 1)
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

/// As much of a name as an axis name can hold: lower-case ASCII.
pub fn axis_part(name: &str) -> String {
    let fit = |character: char| if character.is_ascii_alphanumeric() { character } else { '_' };
    name.to_lowercase().chars().take(40).map(fit).collect()
}

/// The name of an axis, longer where it is taken: by a name that differs only in what an axis name cannot hold.
pub fn unique_axis(mut axis: String, taken: &mut BTreeSet<String>) -> String {
    while !taken.insert(axis.clone()) {
        axis.push('x');
    }
    axis
}
