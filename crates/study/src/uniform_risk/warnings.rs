//! What a study may say, but probably does not mean.

use uplift_motion::IntensityMeasure;
use uplift_oscillator::PostUplift;
use uplift_plausible::{
    Range, USUAL_CAPACITY, USUAL_GRAVITY, USUAL_RESTITUTION, USUAL_STRENGTH, USUAL_THRESHOLD, USUAL_TOP_PGA,
    USUAL_TOP_PGV, USUAL_UPLIFT_DISPLACEMENT, USUAL_YEARS, counted,
};

use super::UniformRiskStudy;
use crate::warning::Warning;

/// The warnings of a resolved study; they depend on nothing but its contents.
pub(super) fn from_study(study: &UniformRiskStudy) -> Vec<Warning> {
    let mut warnings: Vec<Warning> =
        numbers(study).into_iter().filter_map(unlikely).map(|found| Warning::unlikely(&found)).collect();
    if study.sites.is_empty() && study.site_table.is_none() {
        warnings.push(Warning::new(
            "no [[sites]]: the responses are computed, but no uniform risk spectrum",
            "add [[sites]] with a hazard curve",
        ));
    }
    let above = study.regression.strength_above;
    let fitted = study.strengths.iter().filter(|&&strength| strength > above);
    let fitted = fitted.count();
    if fitted < 4 {
        warnings.push(Warning::new(
            format!(
                "regression.strength_above = {above} leaves {}, too few to fit 3 coefficients: no fit will be made",
                counted(fitted, "strength")
            ),
            "lower it, or give more strengths.values",
        ));
    }
    warnings
}

fn unlikely((name, value, usual): (&'static str, f64, Range)) -> Option<uplift_plausible::Unlikely> {
    usual.unlikely(name, value)
}

/// The numbers whose unit is easily mistaken, with what they usually are.
fn numbers(study: &UniformRiskStudy) -> Vec<(&'static str, f64, Range)> {
    let oscillator = &study.oscillator;
    let mut numbers = vec![
        ("gravity_m_s2", study.gravity_m_s2, USUAL_GRAVITY),
        ("oscillator.uplift_displacement_m", oscillator.uplift_displacement_m, USUAL_UPLIFT_DISPLACEMENT),
        ("oscillator.restitution", oscillator.restitution, USUAL_RESTITUTION),
        ("risk.years", study.risk.years, USUAL_YEARS),
    ];
    if let PostUplift::Negative { capacity_m } = oscillator.post_uplift {
        numbers.push(("oscillator.capacity_m", capacity_m, USUAL_CAPACITY));
    }
    numbers.extend(study.strengths.last().map(|&most| ("the largest of strengths.values", most, USUAL_STRENGTH)));
    let threshold = study.risk.thresholds_m.last();
    numbers.extend(threshold.map(|&most| ("the largest of risk.thresholds_m", most, USUAL_THRESHOLD)));
    for plan in &study.measures {
        let Some((name, usual)) = usual_top_level(plan.measure) else { continue };
        numbers.extend(plan.levels.last().map(|&top| (name, top, usual)));
    }
    numbers
}

/// What the highest level of a measure is called, and what it usually is; none where that depends on the period, or is
/// told by nobody.
pub fn usual_top_level(measure: IntensityMeasure) -> Option<(&'static str, Range)> {
    match measure {
        IntensityMeasure::Pgv => Some(("the highest of pgv.levels_cm_s", USUAL_TOP_PGV)),
        IntensityMeasure::Pga => Some(("the highest of pga.levels_g", USUAL_TOP_PGA)),
        _ => None,
    }
}
