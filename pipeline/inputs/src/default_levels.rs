//! Default levels, which reach as far as the hazard curves of the sites do.

use std::path::Path;

use uplift_hazard::Extrapolation;

use uplift_study::{AnyStudy, MeasurePlan, Study, StudyError, UniformRiskStudy};

use super::hazard::{are_interchanged, curve_of};
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
    let (mut least, mut most) = (0.0_f64, f64::INFINITY);
    for site in &study.sites {
        let file = site.curve(plan.measure)?;
        for path in file.files() {
            let curve = curve_of(study, file, path)?;
            let is_of_another_unit = of_outside(study, (&site.name, file), plan, &curve).is_some();
            if is_of_another_unit || are_interchanged(study, &site.name, file, plan).unwrap_or(false) {
                return None;
            }
            (least, most) = (least.max(curve.first().im), most.min(curve.last().im));
        }
    }
    let (first, last) = (plan.levels.first()?, plan.levels.last()?);
    let is_near = least <= SHORTER_WITHIN[0] * first && *last <= SHORTER_WITHIN[1] * most;
    is_near.then(|| MeasurePlan::default_within(plan.measure, least, most))?
}
