//! Default levels, which are cut to what the hazard curves of the sites cover.

use std::path::Path;

use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_study::{AnyStudy, MeasurePlan, Study, StudyError, UniformRiskStudy, usual_top_level};

use super::curve_file::{are_interchanged, curve_of};
use super::other_unit::from_outside;

/// At how many times the first default level a curve may begin: one that begins later is more likely of another unit,
/// and is refused.
const LATER_WITHIN: f64 = 10.0;
/// How many times the end of a curve the last default level may be.
const SHORTER_WITHIN: f64 = 4.0;

/// Reads a study file of any kind, as [`Study::load_any`]; default levels, named or left out, are cut to what the
/// curves of all `[[sites]]` cover.
///
/// # Errors
/// As [`Study::load_any`]. Mistakes in the curves are errors of [`read_hazard`](crate::read_hazard).
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

/// The default levels that the curves of all sites cover; none where `plan` has others, and where all are covered.
/// Curves that cannot be read, or look as if they were of another unit, cut nothing: they are refused.
fn shortened(study: &UniformRiskStudy, plan: &MeasurePlan) -> Option<MeasurePlan> {
    if !plan.is_default() {
        return None;
    }
    let (first, last) = (plan.levels.first()?, plan.levels.last()?);
    let (mut least, mut most) = (*first, *last);
    for site in &study.sites {
        let Some(file) = site.curve(plan.measure) else { continue };
        let is_doubtful = |curve: &HazardCurve| {
            let end = curve.last().im;
            *first * LATER_WITHIN < curve.first().im
                || end * SHORTER_WITHIN < *last
                || usual_top_level(plan.measure).is_some_and(|(_, usual)| !usual.contains(end))
                || from_outside(study, (&site.name, file), plan, curve).is_some()
                || are_interchanged(study, &site.name, file, plan).unwrap_or(false)
        };
        // most curves cut nothing, and whether they are doubtful takes further files to say
        let cuts = |curve: &HazardCurve| *first < curve.first().im || curve.last().im < *last;
        let curves = file.files().filter_map(|path| curve_of(study, (&site.name, file), path));
        for curve in curves.filter(|curve| cuts(curve) && !is_doubtful(curve)) {
            (least, most) = (least.max(curve.first().im), most.min(curve.last().im));
        }
    }
    MeasurePlan::default_within(plan.measure, least, most)
}
