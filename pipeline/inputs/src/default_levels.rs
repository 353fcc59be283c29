//! Default levels, which reach as far as the hazard curves of the sites do.

use std::path::Path;

use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_job::text::rounded;

use uplift_study::{AnyStudy, MeasurePlan, Study, StudyError, UniformRiskStudy};

use super::hazard::{SiteHazard, are_interchanged, curve_of};
use super::other_unit::of_outside;

/// How many times the first default level a curve may begin at, and how many times below the last one it may end: one
/// that is shorter is more likely of another unit, and is refused.
const SHORTER_WITHIN: [f64; 2] = [10.0, 4.0];

/// Reads a study file of any kind, as [`Study::load_any`]; levels that it leaves out, or gives as they are by default,
/// are those that the curves of all its sites cover.
///
/// # Errors
/// As [`Study::load_any`]; of what is wrong with curves their reader tells.
pub fn load_study(file: &Path, overrides: &[String]) -> Result<AnyStudy, StudyError> {
    let mut study = Study::load_any(file, overrides)?;
    if let AnyStudy::UniformRisk(study) = &mut study {
        shorten(study);
    }
    Ok(study)
}

/// As [`load_study`], for a study of uniform risk.
///
/// # Errors
/// As [`Study::load`].
pub fn load_uniform_risk(file: &Path, overrides: &[String]) -> Result<UniformRiskStudy, StudyError> {
    let mut study = Study::load(file, overrides)?;
    shorten(&mut study);
    Ok(study)
}

fn shorten(study: &mut UniformRiskStudy) {
    if study.risk.extrapolate == Extrapolation::Refuse {
        let plans = study.measures.iter().map(|plan| shortened(study, plan).unwrap_or_else(|| plan.clone()));
        study.measures = plans.collect();
    }
}

/// The default levels that the curves of all sites cover; none where `plan` has others, where all are covered, and
/// where a curve cannot be read or looks as if it were of another unit.
fn shortened(study: &UniformRiskStudy, plan: &MeasurePlan) -> Option<MeasurePlan> {
    if !plan.is_default() {
        return None;
    }
    let mut curves = Vec::new();
    for site in &study.sites {
        let file = site.curve(plan.measure)?;
        for path in file.files() {
            let curve = curve_of(study, file, path)?;
            let is_of_another_unit = of_outside(study, (&site.name, file), plan, &curve).is_some();
            if is_of_another_unit || are_interchanged(study, &site.name, file, plan).unwrap_or(false) {
                return None;
            }
            curves.push(curve);
        }
    }
    let [least, most] = covered(&curves);
    let (first, last) = (plan.levels.first()?, plan.levels.last()?);
    let is_near = least <= SHORTER_WITHIN[0] * first && *last <= SHORTER_WITHIN[1] * most;
    is_near.then(|| MeasurePlan::default_within(plan.measure, least, most))?
}

/// That the levels of `plan` are the default ones that the curves of all `sites` cover; none where they are not.
pub(super) fn shortened_note(plan: &MeasurePlan, sites: &[SiteHazard]) -> Option<String> {
    let inputs = sites.iter().flat_map(|site| {
        let branches = site.branches.iter().map(|branch| &branch.input);
        std::iter::once(&site.curve).chain(branches)
    });
    let [least, most] = covered(inputs.map(|input| &input.curve));
    let (first, last) = (plan.levels.first()?, plan.levels.last()?);
    (MeasurePlan::default_within(plan.measure, least, most).as_ref() == Some(plan)).then(|| {
        format!(
            "levels of {}: {} to {} {}, as far as the hazard curves reach",
            plan.measure.label(),
            rounded(*first, 4),
            rounded(*last, 4),
            plan.measure.unit()
        )
    })
}

/// The levels between which all `curves` lie.
fn covered<'a>(curves: impl IntoIterator<Item = &'a HazardCurve>) -> [f64; 2] {
    curves
        .into_iter()
        .fold([0.0, f64::INFINITY], |[least, most], curve| [least.max(curve.first().im), most.min(curve.last().im)])
}
