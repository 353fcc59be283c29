//! Hazard curves and levels whose numbers are probably of another unit than the one that they are read in.

use uplift_hazard::{CurveUnit, HazardCurve};
use uplift_motion::IntensityMeasure;
use uplift_study::{CurveFile, MeasurePlan, UniformRiskStudy, levels_key, usual_top_level};

use super::hazard::{implausible, implausible_if};

/// What is further off than so many times is not explained by a unit: sites and records differ by some, units by more.
const FITS_WITHIN: f64 = 2.0;
/// Levels that leave a curve by less than so many times do so with the right unit, too.
const FAR_OUTSIDE: f64 = 5.0;

/// A unit that numbers may be of, and how many times too large they then are as they are read.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OtherUnit {
    unit: NumbersIn,
    too_large: f64,
}

/// What numbers may be in.
#[derive(Debug, Clone, Copy, PartialEq)]
enum NumbersIn {
    /// A unit that a study can say.
    Unit(CurveUnit),
    /// One that it cannot: its name, and by what levels are to be divided for which unit.
    Parts(&'static str, f64, CurveUnit),
}

impl NumbersIn {
    const PER_CENT_OF_G: Self = Self::Parts("per cent of g", 100.0, CurveUnit::G);
    const MM_PER_S: Self = Self::Parts("mm/s", 10.0, CurveUnit::CmPerS);

    fn name(self) -> &'static str {
        match self {
            Self::Unit(unit) => unit.symbol(),
            Self::Parts(name, ..) => name,
        }
    }

    /// How many times too large they are where they are read as `read`; none where they measure something else.
    fn times_too_large_as(self, read: CurveUnit, gravity_m_s2: f64) -> Option<f64> {
        match self {
            Self::Unit(unit) => unit.times_too_large_as(read, gravity_m_s2),
            Self::Parts(_, parts, unit) => Some(parts * unit.times_too_large_as(read, gravity_m_s2)?),
        }
    }

    /// What to write where the numbers of the `file` of a site are so.
    fn remedy(self, site: &str, file: &CurveFile) -> String {
        let key = file.measure.key();
        let is_bare = !site.contains(['.', '[', '"']);
        let site = if is_bare { site.to_owned() } else { format!("\"{site}\"") };
        match self {
            Self::Parts(_, parts, unit) => format!("divide its levels by {parts} into {}", unit.symbol()),
            Self::Unit(unit) if file.branches.is_empty() => format!(
                "unit = \"{unit}\" of {key} in [[sites]], or --set 'sites.{site}.{key}.unit={unit}' (and in the \
                 head of the file, if it says another)",
                unit = unit.symbol()
            ),
            Self::Unit(unit) => format!(
                "if those of all branches are, unit = \"{}\" of {key} in [[sites]]; if not all, convert the files of \
                 those that are",
                unit.symbol()
            ),
        }
    }
}

/// The units that the numbers of `file` may be of instead of its own.
fn of_file(file: &CurveFile, gravity_m_s2: f64) -> impl Iterator<Item = OtherUnit> {
    let parts = [NumbersIn::PER_CENT_OF_G, NumbersIn::MM_PER_S];
    file.other_units().map(NumbersIn::Unit).chain(parts).filter_map(move |unit| {
        let too_large = unit.times_too_large_as(file.unit, gravity_m_s2)?;
        Some(OtherUnit { unit, too_large })
    })
}

/// What is said first where levels of `plan` lie far outside the `curve` of a `site`, which is read from `file`: that
/// they, or the curve, would fit in another unit. None where no unit is better.
pub(super) fn of_outside(
    study: &UniformRiskStudy,
    (site, file): (&str, &CurveFile),
    plan: &MeasurePlan,
    curve: &HazardCurve,
) -> Option<String> {
    let (&least, &most) = (plan.levels.first()?, plan.levels.last()?);
    let (first, last) = (curve.first().im, curve.last().im);
    if (first / least).max(most / last) < FAR_OUTSIDE {
        return None;
    }
    let gravity_m_s2 = study.gravity_m_s2;
    // the levels are to blame where they look so themselves, and the curve does not
    let is_unusual = usual_top_level(plan.measure).is_some_and(|(_, usual)| !usual.contains(most));
    if is_unusual && implausible(curve, plan.measure).is_none() {
        let own = CurveUnit::parse(plan.measure.unit())?;
        let holds = |unit: &CurveUnit| {
            unit.times_too_large_as(own, gravity_m_s2)
                .is_some_and(|too_large| *unit != own && first <= least / too_large && most / too_large <= last)
        };
        if let Some(unit) = file.other_units().chain([file.unit]).find(holds) {
            return Some(format!(
                "is {} in {}? As such it lies within the curve: give it in {}. As it is, ",
                levels_key(plan.measure),
                unit.symbol(),
                own.symbol()
            ));
        }
    }
    let covers = |&OtherUnit { too_large, .. }: &OtherUnit| {
        let is_plausible = implausible_if(curve, plan.measure, too_large).is_none();
        first / too_large <= least && most <= last / too_large && is_plausible
    };
    let other = of_file(file, gravity_m_s2).find(covers)?;
    Some(format!(
        "are its numbers in {}? As such they cover the levels: {}. Read as {}, ",
        other.unit.name(),
        other.unit.remedy(site, file),
        file.unit.symbol()
    ))
}

/// What to do where the curve of PGA of a site is `too_high` times what goes with its curve of PGV, and another unit of
/// one of them explains it; none where none does.
pub(crate) fn unit_that_explains(study: &UniformRiskStudy, site: &str, too_high: f64) -> Option<String> {
    let curves = &study.sites.iter().find(|listed| listed.name == site)?.curves;
    let explanations = curves.iter().flat_map(|file| {
        of_file(file, study.gravity_m_s2).filter_map(move |other| {
            let explained = match file.measure {
                IntensityMeasure::Pga => other.too_large,
                IntensityMeasure::Pgv => 1.0 / other.too_large,
                _ => return None,
            };
            let left = (too_high / explained).ln().abs();
            (left < FITS_WITHIN.ln()).then_some((file, other.unit))
        })
    });
    let explanations: Vec<(&CurveFile, NumbersIn)> = explanations.collect();
    let numbers =
        |&(file, unit): &(&CurveFile, NumbersIn)| format!("of its {} in {}", file.measure.label(), unit.name());
    match &explanations[..] {
        [] => None,
        [one @ (file, unit)] => {
            let remedy = unit.remedy(site, file);
            Some(format!("are the numbers {}, which would explain it? Then {remedy}", numbers(one)))
        }
        several => {
            let several: Vec<String> = several.iter().map(numbers).collect();
            Some(format!("are the numbers {}? Each would explain it: see both files", several.join(", or ")))
        }
    }
}
