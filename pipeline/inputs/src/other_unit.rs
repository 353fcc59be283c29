//! Hazard curves and levels whose numbers are probably of another unit than the one that they are read in.

use uplift_hazard::{CurveUnit, HazardCurve, HazardError};
use uplift_job::text::rounded;
use uplift_motion::IntensityMeasure;
use uplift_study::{CurveFile, CurveKind, MeasurePlan, UniformRiskStudy, levels_key, usual_top_level};

use super::hardly_possible::{hardly_possible, hardly_possible_if};

/// What is further off than so many times is not explained by a unit: sites and records differ by some, units by more.
const FITS_WITHIN: f64 = 2.0;
/// Levels that leave a curve by less than so many times do so with the right unit, too.
const FAR_OUTSIDE: f64 = 5.0;

/// What a study says of a curve of probabilities.
pub const POE: &str = "kind = \"poe\", years = …";

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
    fn remedy(self, study: &UniformRiskStudy, site: &str, file: &CurveFile) -> String {
        match self {
            Self::Parts(_, parts, unit) => {
                let line =
                    if unit == file.unit { String::new() } else { format!(", and write {}", unit_line(file, unit)) };
                format!("divide its levels by {parts} into {}{line}", unit.symbol())
            }
            Self::Unit(unit) if file.branches.is_empty() => format!(
                "{}, or {} (and in the head of the file, if it says another)",
                unit_line(file, unit),
                unit_setting(study, site, file, unit)
            ),
            Self::Unit(unit) => format!(
                "if those of all branches are, {}; if not all, convert the files of those that are",
                unit_line(file, unit)
            ),
        }
    }
}

/// `pga = { file = …, unit = "m/s2" } in [[sites]]`.
fn unit_line(file: &CurveFile, unit: CurveUnit) -> String {
    curve_line(file.measure, !file.branches.is_empty(), &format!("unit = \"{}\"", unit.symbol()))
}

/// The line of a study that says `what` of a curve of one file or of several.
pub fn curve_line(measure: IntensityMeasure, has_branches: bool, what: &str) -> String {
    let input = if has_branches { "…" } else { "file = …" };
    format!("{} = {{ {input}, {what} }} in [[sites]]", measure.key())
}

/// `--set 'sites.Athens.pga.unit=m/s2'`.
fn unit_setting(study: &UniformRiskStudy, site: &str, file: &CurveFile, unit: CurveUnit) -> String {
    format!("--set '{}.{}.unit={}'", study.key_of_site(site), file.measure.key(), unit.symbol())
}

/// What is wrong with a curve of a `site` that the study says as `file`: where the file says something else, with the
/// line that agrees with it.
pub(super) fn with_remedy(error: &HazardError, study: &UniformRiskStudy, site: &str, file: &CurveFile) -> String {
    let HazardError::Contradiction { place, what, found, declared } = error else { return error.to_string() };
    let read_as = if *what == "second column" && file.kind == CurveKind::Maf {
        "without kind = \"poe\" and years the study means annual rates".to_owned()
    } else {
        format!("the study reads {declared}")
    };
    let remedy = match *what {
        "unit" => {
            let found = found.trim_matches('"');
            let unit = CurveUnit::parse(found).filter(|found| file.other_units().any(|unit| unit == *found));
            match unit {
                Some(unit) if file.branches.is_empty() => {
                    format!("write {}, or {}", unit_line(file, unit), unit_setting(study, site, file, unit))
                }
                Some(unit) => format!("write {} if all branches are so, or convert this file", unit_line(file, unit)),
                None => format!("convert its levels into {}, and write that into its head", file.unit.symbol()),
            }
        }
        "second column" if file.kind == CurveKind::Maf => {
            let line = curve_line(file.measure, !file.branches.is_empty(), POE);
            if file.branches.is_empty() {
                format!("write {line}, with the years that they are of")
            } else {
                format!("write {line} if all branches are so, or rates per year into this file")
            }
        }
        "second column" => format!("leave out `kind` and `years` of {} in [[sites]]", file.measure.key()),
        _ => return error.to_string(),
    };
    format!(
        "{place}: the file declares its {what} as {found}, but {read_as}: if the file is right, \
         {remedy}; else correct the file"
    )
}

/// The units that the numbers of `file` may be of instead of its own.
fn units_of_file(file: &CurveFile, gravity_m_s2: f64) -> impl Iterator<Item = OtherUnit> {
    let parts = [NumbersIn::PER_CENT_OF_G, NumbersIn::MM_PER_S];
    file.other_units().map(NumbersIn::Unit).chain(parts).filter_map(move |unit| {
        let too_large = unit.times_too_large_as(file.unit, gravity_m_s2)?;
        Some(OtherUnit { unit, too_large })
    })
}

/// What is said where levels of `plan` lie far outside the `curve` of a `site`, which is read from `file`: that they,
/// or the curve, would fit in another unit. None where no unit is better.
pub(super) fn from_outside(
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
    let outside = plan.levels.iter().find(|level| !(first..=last).contains(*level))?;
    let fact = format!(
        "{0} = {outside} {1} lies outside the hazard curve, which spans {2} to {3} {1}",
        plan.measure.label(),
        plan.measure.unit(),
        rounded(first, 6),
        rounded(last, 6)
    );
    // the levels are to blame where they look so themselves, and the curve does not
    let is_unusual = usual_top_level(plan.measure).is_some_and(|(_, usual)| !usual.contains(most));
    if is_unusual && hardly_possible(curve, plan.measure).is_none() {
        let own = CurveUnit::parse(plan.measure.unit())?;
        let holds = |unit: &CurveUnit| {
            unit.times_too_large_as(own, gravity_m_s2)
                .is_some_and(|too_large| *unit != own && first <= least / too_large && most / too_large <= last)
        };
        if let Some(unit) = file.other_units().chain([file.unit]).find(holds) {
            return Some(format!(
                "is {} in {}? Then it is within the curve: give it in {}. As it is, {fact}",
                levels_key(plan.measure),
                unit.symbol(),
                own.symbol()
            ));
        }
    }
    let covers = |&OtherUnit { too_large, .. }: &OtherUnit| {
        let is_plausible = hardly_possible_if(curve, plan.measure, too_large).is_none();
        first / too_large <= least && most <= last / too_large && is_plausible
    };
    let other = units_of_file(file, gravity_m_s2).find(covers)?;
    Some(format!(
        "are its numbers in {}? Then they cover the levels: {}. Read as {}, {fact}",
        other.unit.name(),
        other.unit.remedy(study, site, file),
        file.unit.symbol()
    ))
}

/// What is said where the `curve` of a site is extrapolated far, and would cover the levels in another unit: as
/// [`read_hazard`](crate::read_hazard) refuses it where it is not to be extrapolated.
pub fn unit_that_covers(
    study: &UniformRiskStudy,
    (site, measure): (&str, IntensityMeasure),
    curve: &HazardCurve,
) -> Option<String> {
    let plan = study.measures.iter().find(|plan| plan.measure == measure)?;
    from_outside(study, (site, file_of(study, site, measure)?), plan, curve)
}

/// What to do where the curve of PGA of a site is `too_high` times what goes with its curve of PGV, and another unit of
/// one of them, or of both, explains it; none where none does.
pub fn unit_that_explains(study: &UniformRiskStudy, site: &str, too_high: f64) -> Option<String> {
    let [pgv, pga] = [IntensityMeasure::Pgv, IntensityMeasure::Pga].map(|measure| file_of(study, site, measure));
    let (pgv, pga) = (pgv?, pga?);
    let explains = |times: f64| is_near(too_high, times);
    let others = |file| units_of_file(file, study.gravity_m_s2);
    let numbers = |file: &CurveFile, unit: NumbersIn| format!("of its {} in {}", file.measure.label(), unit.name());
    // what, and what to write then
    let mut explanations: Vec<(String, String)> = Vec::new();
    let of_pgv = others(pgv).filter(|other| explains(1.0 / other.too_large)).map(|other| (pgv, other.unit));
    let of_pga = others(pga).filter(|other| explains(other.too_large)).map(|other| (pga, other.unit));
    explanations.extend(of_pgv.chain(of_pga).map(|(file, unit)| (numbers(file, unit), unit.remedy(study, site, file))));
    // who works in m/s and m/s2 forgets both
    for of_pgv in others(pgv) {
        for of_pga in others(pga) {
            if let (NumbersIn::Unit(velocity), NumbersIn::Unit(acceleration)) = (of_pgv.unit, of_pga.unit)
                && explains(of_pga.too_large / of_pgv.too_large)
            {
                let what = format!("{} and {}", numbers(pgv, of_pgv.unit), numbers(pga, of_pga.unit));
                explanations.push((what, format!("{}, {}", unit_line(pgv, velocity), unit_line(pga, acceleration))));
            }
        }
    }
    // probabilities and rates that are taken for those of other years do the same
    let of_probabilities = |file: &CurveFile| match file.kind {
        CurveKind::Poe { years } => Some(format!("; or is {} not of {years} years?", file.measure.label())),
        CurveKind::Maf => None,
    };
    let mut years: String = [pgv, pga].into_iter().filter_map(of_probabilities).collect();
    if years.is_empty() {
        years += "; or are the rates of one curve those of another number of years?";
    }
    match &explanations[..] {
        [] => None,
        [(what, remedy)] => Some(format!("are the numbers {what}, which would explain it? Then {remedy}{years}")),
        several => {
            let several: Vec<String> = several.iter().map(|(what, remedy)| format!("{what} ({remedy})")).collect();
            Some(format!("are the numbers {}? Each would explain it: see both files{years}", several.join(", or ")))
        }
    }
}

/// Whether a unit that makes numbers so many `times` too large explains that they are `found` to be.
fn is_near(found: f64, times: f64) -> bool {
    (found / times).ln().abs() < FITS_WITHIN.ln()
}

/// The curve of a site in a `measure`, as its study says it; none where it has none.
pub fn file_of<'s>(study: &'s UniformRiskStudy, site: &str, measure: IntensityMeasure) -> Option<&'s CurveFile> {
    study.sites.iter().find(|listed| listed.name == site)?.curve(measure)
}

/// What to do where a curve of a site says what is hardly possible, and would not in other units; none where it would
/// in each.
pub fn units_that_make_possible(
    study: &UniformRiskStudy,
    (site, measure): (&str, IntensityMeasure),
    curve: &HazardCurve,
) -> Option<String> {
    let file = file_of(study, site, measure)?;
    let is_possible = |other: &OtherUnit| hardly_possible_if(curve, measure, other.too_large).is_none();
    let units: Vec<NumbersIn> =
        units_of_file(file, study.gravity_m_s2).filter(is_possible).map(|other| other.unit).collect();
    match &units[..] {
        [] => None,
        [one] => Some(format!("are its numbers in {}? Then {}", one.name(), one.remedy(study, site, file))),
        several => {
            let names: Vec<&str> = several.iter().map(|unit| unit.name()).collect();
            Some(format!(
                "are its numbers in {}? See the file, and say so with unit = … of {} in [[sites]], or convert them",
                names.join(", or "),
                measure.key()
            ))
        }
    }
}

/// What to do where some of the weighted curves of a site are `apart` from the others, and another unit of them or of
/// the others explains that; none where none does.
pub fn unit_of_branch(
    study: &UniformRiskStudy,
    (site, measure): (&str, IntensityMeasure),
    too_large: f64,
) -> Option<String> {
    let file = file_of(study, site, measure)?;
    let explains = |of_unit: f64| is_near(too_large, of_unit);
    let units = units_of_file(file, study.gravity_m_s2).filter_map(|other| {
        let whose = if explains(other.too_large) {
            "these numbers"
        } else if explains(1.0 / other.too_large) {
            "the numbers of the others"
        } else {
            return None;
        };
        Some(format!("{whose} in {}", other.unit.name()))
    });
    let units: Vec<String> = units.collect();
    (!units.is_empty()).then(|| {
        format!(
            "are {}, which would explain it? All files of {} are read in {}: convert those that are in another unit",
            units.join(", or "),
            measure.key(),
            file.unit.symbol()
        )
    })
}
