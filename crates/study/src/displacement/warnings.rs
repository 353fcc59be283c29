//! What a study of displacement spectra may say, but probably does not mean.

use uplift_plausible::{
    Range, USUAL_CAPACITY, USUAL_GRAVITY, USUAL_LENGTH, USUAL_PERCENTILE, USUAL_RESTITUTION, USUAL_SAFETY_FACTOR,
    USUAL_STRENGTH, USUAL_UPLIFT_DISPLACEMENT,
};

use super::{DisplacementStudy, Structures};
use crate::warning::Warning;

/// The warnings of a resolved study; they depend on nothing but its contents.
pub(super) fn from_study(study: &DisplacementStudy) -> Vec<Warning> {
    let mut numbers = vec![("gravity_m_s2", study.gravity_m_s2, USUAL_GRAVITY)];
    match &study.structures {
        Structures::Oscillators(family) => {
            let uplift_m = (USUAL_UPLIFT_DISPLACEMENT, "oscillator.uplift_displacement_m");
            numbers.extend(outermost(&family.uplift_displacement_m, uplift_m));
            // what never overturns has an infinite one
            let capacities: Vec<f64> = family.capacity_m.iter().copied().filter(|value| value.is_finite()).collect();
            numbers.extend(outermost(&capacities, (USUAL_CAPACITY, "oscillator.capacity_m")));
            numbers.push(("oscillator.restitution", family.restitution, USUAL_RESTITUTION));
            numbers.extend(outermost(&family.strengths, (USUAL_STRENGTH, "strengths.values")));
        }
        Structures::Blocks(family) => {
            // one of several may stand for an endless block; a mistake of unit moves them all
            if !family.height_m.iter().any(|&height_m| USUAL_LENGTH.contains(height_m)) {
                numbers.extend(outermost(&family.height_m, (USUAL_LENGTH, "block.height_m")));
            }
            numbers.extend(family.restitution.map(|value| ("block.restitution", value, USUAL_RESTITUTION)));
        }
    }
    let percentile = study.percentiles.last().map(|&most| ("the largest of spectrum.percentiles", most));
    let of_design = study.design.iter().map(|plan| ("design.percentile", plan.percentile));
    numbers.extend(percentile.into_iter().chain(of_design).map(|(name, value)| (name, value, USUAL_PERCENTILE)));
    numbers.extend(study.design.iter().map(|plan| ("design.safety_factor", plan.safety_factor, USUAL_SAFETY_FACTOR)));
    let unlikely = |(name, value, usual): (&'static str, f64, Range)| usual.unlikely(name, value);
    numbers.into_iter().filter_map(unlikely).map(|found| Warning::unlikely(&found)).collect()
}

/// Of ascending values that which lies outside of its usual range, the largest first.
fn outermost(values: &[f64], (usual, name): (Range, &'static str)) -> Option<(&'static str, f64, Range)> {
    let outside = |value: &&f64| !usual.contains(**value);
    values.last().filter(outside).or_else(|| values.first().filter(outside)).map(|&value| (name, value, usual))
}
