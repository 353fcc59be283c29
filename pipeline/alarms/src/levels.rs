//! Ordinates that rest on what lies outside the analysed levels, and spectra without ordinates.

use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_job::Array;
use uplift_job::alarm::{Alarm, Case, Severity};
use uplift_job::text::{rate, rounded, share};
use uplift_risk::{BEYOND_LIMIT, DECISIVE_SHARE, OrdinateFlag, TAIL_SHARE_LIMIT};
use uplift_study::{MeasurePlan, levels_key};

use super::evidence::{Evidence, Place, Scope};
use crate::error::AlarmsError;

/// The kind of the alarm about the first level.
pub const BELOW_FIRST_LEVEL: &str = "below-first-level";
/// The kind of the alarm about the last level.
pub const BEYOND_LAST_LEVEL: &str = "beyond-last-level";

pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Result<Vec<Alarm>, AlarmsError> {
    let (mut below, mut beyond, mut censored, mut zero) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for place in evidence.places(scope) {
        let target_per_year = evidence.target_per_year(place.poe)?;
        below.extend(below_first(evidence, &place));
        beyond.extend(beyond_last(evidence, &place, target_per_year)?);
        censored.extend(without_ordinate(&place));
        zero.extend(never_exceeded(&place, &evidence.spectra.strengths, target_per_year));
    }
    let kinds =
        [("censored", censored), ("no-exceedance", zero), (BEYOND_LAST_LEVEL, beyond), (BELOW_FIRST_LEVEL, below)];
    Ok(kinds.into_iter().filter_map(|(kind, cases)| Alarm::from_cases(kind, cases)).collect())
}

/// The largest of the shares of a spectrum.
fn most(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}

/// The shares of the ordinates that are asked about.
fn at_strengths(shares: &Array<3>, place: &Place<'_>) -> Vec<f64> {
    let shares = shares.block([place.site, place.poe]);
    place.strengths.iter().map(|&strength| shares[strength]).collect()
}

fn severity(share: f64) -> Severity {
    if share > DECISIVE_SHARE { Severity::Caution } else { Severity::Note }
}

fn below_first(evidence: &Evidence, place: &Place<'_>) -> Option<Case> {
    let plan = evidence.study.measures.iter().find(|plan| plan.measure == place.of_measure.measure)?;
    let shares = at_strengths(&place.of_measure.lower_tail_share, place);
    below_first_case((plan, place.curve), &place.name, &shares)
}

/// What is to be raised of the spectrum `name`, whose ordinates take the `shares` of their risk from motions weaker
/// than the first level, where the fragility is a straight line: too large.
pub fn below_first_case((plan, curve): (&MeasurePlan, &HazardCurve), name: &str, shares: &[f64]) -> Option<Case> {
    let (measure, first, most) = (plan.measure, *plan.levels.first()?, most(shares));
    (most > TAIL_SHARE_LIMIT).then(|| Case {
        severity: severity(most),
        badness: most,
        subject: name.to_owned(),
        what: format!("displacements too large ({} of the risk below {first} {})", share(most), measure.unit()),
        what_to_do: if curve.first().im >= first {
            format!("Use a hazard curve that begins below {} {}", curve.first().im, measure.unit())
        } else {
            format!("Lower {} (uplift check)", levels_key(measure))
        },
    })
}

/// Ordinates that rest on motions stronger than the last level, or than the hazard curve goes.
fn beyond_last(evidence: &Evidence, place: &Place<'_>, target_per_year: f64) -> Result<Option<Case>, AlarmsError> {
    let Some(plan) = evidence.study.measures.iter().find(|plan| plan.measure == place.of_measure.measure) else {
        return Ok(None);
    };
    let end = UpperEnd { plan, curve: place.curve, extrapolate: evidence.study.risk.extrapolate, target_per_year };
    end.case(&place.name, &at_strengths(&place.of_measure.upper_tail_share, place))
}

/// Where the levels and the hazard curve of a measure end, and the rate that spectra are asked at.
pub struct UpperEnd<'a> {
    /// The measure with its levels.
    pub plan: &'a MeasurePlan,
    /// The hazard curve.
    pub curve: &'a HazardCurve,
    /// How the curve is extrapolated.
    pub extrapolate: Extrapolation,
    /// The target rate, 1/yr.
    pub target_per_year: f64,
}

impl UpperEnd<'_> {
    /// What is to be raised of the spectrum `name`, whose ordinates take the `shares` of their risk from above the last
    /// level; no shares where none is tried.
    ///
    /// # Errors
    /// A curve that cannot be read at the last level.
    pub fn case(&self, name: &str, shares: &[f64]) -> Result<Option<Case>, AlarmsError> {
        let &Self { plan, curve, target_per_year, .. } = self;
        let (measure, unit, end) = (plan.measure, plan.measure.unit(), curve.last());
        let most = most(shares);
        let Some(&last) = plan.levels.last() else { return Ok(None) };
        // what is known of the hazard ends with the curve, though levels go on
        let is_extrapolated = end.im < last;
        let per_year = if is_extrapolated { end.maf } else { curve.rate_at_extrapolated(last, self.extrapolate)? };
        let beyond = per_year / target_per_year;
        if most <= TAIL_SHARE_LIMIT && beyond <= BEYOND_LIMIT {
            return Ok(None);
        }
        let of_target = if beyond > 1.0 { format!("{beyond:.1} times") } else { format!("{} of", share(beyond)) };
        let why = if is_extrapolated {
            format!("the hazard curve ends at {} {unit}, at {of_target} the target rate, and is extrapolated", end.im)
        } else if most > TAIL_SHARE_LIMIT {
            format!("{} of the risk above {last} {unit}", share(most))
        } else {
            format!("the last level, {last} {unit}, is exceeded at {of_target} the target rate")
        };
        // no more of the risk lies above a level than its rate is of the target
        let enough_per_year = target_per_year * if most > TAIL_SHARE_LIMIT { TAIL_SHARE_LIMIT } else { BEYOND_LIMIT };
        Ok(Some(Case {
            severity: severity(most.max(beyond)),
            badness: most.max(beyond),
            subject: name.to_owned(),
            // a straight line beyond a curve that bends down has too much hazard
            what: format!("displacements may be too {} ({why})", if is_extrapolated { "large" } else { "small" }),
            what_to_do: if end.im > last {
                let enough = curve.im_at_rate(enough_per_year).map_or(end.im, |im| rounded_up(im).min(end.im));
                format!("Raise the last of {} to {enough}", levels_key(measure))
            } else {
                format!(
                    "Use a hazard curve down to {} per year, and raise {}",
                    rate(enough_per_year),
                    levels_key(measure)
                )
            },
        }))
    }
}

/// The next number of two digits.
fn rounded_up(value: f64) -> f64 {
    let nearest = rounded(value, 2);
    let unit = 10_f64.powf(value.log10().floor() - 1.0);
    if nearest < value { rounded(nearest + unit, 2) } else { nearest }
}

/// Spectra that are infinite in places.
fn without_ordinate(place: &Place<'_>) -> Option<Case> {
    let flags = place.of_measure.flags.block([place.site, place.poe]);
    let count = place.strengths.iter().filter(|&&strength| flags[strength] == OrdinateFlag::Censored).count();
    (count > 0).then(|| Case {
        severity: Severity::Caution,
        badness: count as f64,
        subject: place.name.clone(),
        what: format!(
            "{count} of {} ordinates are censored: overturning exceeds the target risk",
            place.strengths.len()
        ),
        what_to_do: "Raise strengths.values, oscillator.capacity_m or risk.thresholds_m".to_owned(),
    })
}

/// Spectra that are zero although something rocks: the hazard curve begins above the target.
fn never_exceeded(place: &Place<'_>, strengths: &[f64], target_per_year: f64) -> Option<Case> {
    let flags = place.of_measure.flags.block([place.site, place.poe]);
    let zero = |strength: &&usize| flags[**strength] == OrdinateFlag::NoExceedance && strengths[**strength] > 0.0;
    let count = place.strengths.iter().filter(zero).count();
    let foot = place.curve.first();
    (count > 0).then(|| Case {
        severity: Severity::Caution,
        badness: count as f64,
        subject: place.name.clone(),
        what: format!(
            "{count} of {} ordinates are 0: the hazard curve begins with {} a year at {} {}, below the target rate \
             of {}",
            place.strengths.len(),
            rate(foot.maf),
            foot.im,
            place.curve.unit(),
            rate(target_per_year)
        ),
        what_to_do: "Extend the hazard curve to lower levels, or lower risk.poe".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::rounded_up;

    #[test]
    fn levels_are_proposed_with_two_digits() {
        for (value, next) in [(250.0, 250.0), (251.0, 260.0), (0.996, 1.0), (1.31, 1.4), (0.0834, 0.084)] {
            assert_eq!(rounded_up(value), next);
        }
    }
}
