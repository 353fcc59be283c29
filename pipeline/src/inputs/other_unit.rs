//! Hazard curves and levels whose numbers are probably of another unit than the one that they are read in.

use uplift_hazard::{CurveUnit, HazardCurve};
use uplift_plausible::Range;
use uplift_study::{CurveFile, MeasurePlan, UniformRiskStudy, levels_key, usual_top_level};

use super::hazard::{implausible, implausible_if};

/// What is further off than so many times is not explained by a unit: sites and records differ by some, units by more.
const FITS_WITHIN: f64 = 2.0;

/// A unit that numbers may be of, and how many times too large they then are as they are read.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OtherUnit {
    unit: CurveUnit,
    too_large: f64,
}

/// The units that the numbers of `file` may be of instead of its own.
fn of_file(file: &CurveFile, gravity_m_s2: f64) -> impl Iterator<Item = OtherUnit> {
    file.other_units().filter_map(move |unit| {
        let too_large = unit.times_too_large_as(file.unit, gravity_m_s2)?;
        Some(OtherUnit { unit, too_large })
    })
}

/// What to write where the numbers of `file` are in `unit`.
fn said_in_site(file: &CurveFile, unit: CurveUnit) -> String {
    let input = if file.file.is_some() { "file = …, " } else { "…, " };
    format!("{} = {{ {input}unit = \"{}\" }}", file.measure.key(), unit.symbol())
}

/// What is said first where levels of `plan` lie outside `curve`, which is read from `file`: that they, or the curve,
/// would fit in another unit. None where no unit is better.
pub(super) fn of_outside(
    study: &UniformRiskStudy,
    file: &CurveFile,
    plan: &MeasurePlan,
    curve: &HazardCurve,
) -> Option<String> {
    let (&least, &most) = (plan.levels.first()?, plan.levels.last()?);
    let (first, last) = (curve.first().im, curve.last().im);
    let gravity_m_s2 = study.gravity_m_s2;
    let covers = |&OtherUnit { too_large, .. }: &OtherUnit| {
        let is_plausible = implausible_if(curve, plan.measure, too_large).is_none();
        first / too_large <= least && most <= last / too_large && is_plausible
    };
    if let Some(other) = of_file(file, gravity_m_s2).find(covers) {
        return Some(format!(
            "are its numbers in {}? As such they cover the levels: say so in [[sites]]: {}; read as {}, ",
            other.unit.symbol(),
            said_in_site(file, other.unit),
            file.unit.symbol()
        ));
    }
    // the levels are to blame where they look so themselves, and the curve does not
    let is_usual = |(_, usual): (&str, Range)| usual.contains(most);
    if usual_top_level(plan.measure).is_some_and(is_usual) || implausible(curve, plan.measure).is_some() {
        return None;
    }
    let (own, key) = (CurveUnit::parse(plan.measure.unit())?, levels_key(plan.measure));
    let holds = |unit: &CurveUnit| {
        unit.times_too_large_as(own, gravity_m_s2)
            .is_some_and(|too_large| *unit != own && first <= least / too_large && most / too_large <= last)
    };
    let unit = file.other_units().chain([file.unit]).find(holds)?;
    Some(format!(
        "is {key} in {}? As such it lies within the curve: give it in {}; as it is, ",
        unit.symbol(),
        own.symbol()
    ))
}

/// What to do where the records bring `times` the level of measure `shown` that the hazard of a site has, scaled to
/// that of measure `scaled_to`, and a curve of the site in another unit explains it; none where none does.
pub(crate) fn unit_that_explains(
    study: &UniformRiskStudy,
    site: &str,
    [scaled_to, shown]: [&str; 2],
    times: f64,
) -> Option<String> {
    let site = study.sites.iter().find(|listed| listed.name == site)?;
    let mut explained: Option<(f64, String)> = None;
    // levels of `shown` that are too large let the records bring too little, and of `scaled_to` too much
    for (label, power) in [(shown, -1.0), (scaled_to, 1.0)] {
        let Some(file) = site.curves.iter().find(|file| file.measure.label() == label) else { continue };
        for other in of_file(file, study.gravity_m_s2) {
            let left = (times / other.too_large.powf(power)).ln().abs();
            if left < FITS_WITHIN.ln() && explained.as_ref().is_none_or(|(least, _)| left < *least) {
                let unit = other.unit.symbol();
                let said = said_in_site(file, other.unit);
                explained = Some((
                    left,
                    format!(
                        "if the {label} of the curve is in {unit}, which would explain it, say so in [[sites]]: {said}"
                    ),
                ));
            }
        }
    }
    explained.map(|(_, what_to_do)| what_to_do)
}
