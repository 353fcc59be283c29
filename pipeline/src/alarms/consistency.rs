//! Records that do not bring the site's hazard of the other measure: spectra of such a set are true of the set, and not
//! of the site.

use uplift_consistency::Verdict;
use uplift_motion::IntensityMeasure;
use uplift_study::UniformRiskStudy;

use super::evidence::{Evidence, Scope};
use super::{Alarm, Case, Severity};
use crate::bootstrap::MANY_FAILED;
use crate::consistency::{ConsistencyReport, ConsistencyRow};
use crate::inputs::unit_that_explains;
use crate::result::StoredConsistency;

/// The kind of the alarm.
const INCONSISTENT: &str = "hazard-inconsistent";
/// PGA over PGV differs by 3 times between rock near by and soft soil far away: further off than that is a curve in
/// another unit, or one of something else.
const BEYOND_NATURE: f64 = 5.0;

pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let mut cases = Vec::new();
    for consistency in &evidence.consistency {
        for (site, name) in evidence.spectra.sites.iter().enumerate() {
            // one risk is judged by itself, so that the others of a result do not matter to it
            let (times, verdict) = match scope.poe {
                None => (consistency.bias[site], consistency.verdict[site].as_str()),
                Some(poe) => {
                    let ratio = consistency.ratio[[site, poe]];
                    (ratio, Verdict::of(ratio, ratio.ln().abs()).key())
                }
            };
            if scope.holds(site, consistency.scaled_to) && times.is_finite() && verdict == Verdict::Inconsistent.key() {
                let measures = [consistency.scaled_to, consistency.other].map(IntensityMeasure::label);
                let is_opposite =
                    |of: &&StoredConsistency| (of.scaled_to, of.other) == (consistency.other, consistency.scaled_to);
                let opposite = evidence.consistency.iter().find(is_opposite).map(|of| of.bias[site]);
                let biases = (consistency.bias[site], opposite);
                let mistaken = mistaken_curve(&evidence.study, name, measures, biases);
                cases.push(mistaken.unwrap_or_else(|| case(consistency, site, name, times)));
            }
        }
    }
    Alarm::of_cases(INCONSISTENT, cases)
}

/// Curves of a study that is looked at and not run, of which one is probably mistaken.
pub(crate) fn mistaken_curves(study: &UniformRiskStudy, report: &ConsistencyReport) -> Option<Alarm> {
    let case = |row: &ConsistencyRow| {
        let is_opposite = |other: &&ConsistencyRow| {
            (&other.site, other.scaled_to, other.shows) == (&row.site, row.shows, row.scaled_to)
        };
        let opposite = report.rows.iter().find(is_opposite).and_then(|opposite| opposite.bias);
        mistaken_curve(study, &row.site, [row.scaled_to, row.shows], (row.bias?, opposite))
    };
    Alarm::of_cases(INCONSISTENT, report.rows.iter().filter_map(case).collect())
}

/// What is to be raised where records scaled to one measure bring `times` the level of the other that the hazard of
/// `site` has, and that is no property of a site any more.
///
/// * `opposite` — the same of the records scaled to the other measure: a curve that is too high is at the bottom of
///   the one and at the top of the other, and what both have in common is no matter of curves
fn mistaken_curve(
    study: &UniformRiskStudy,
    site: &str,
    measures: [&'static str; 2],
    (times, opposite): (f64, Option<f64>),
) -> Option<Case> {
    let of_curve = opposite.filter(|opposite| opposite.is_finite()).map_or(times, |opposite| (times / opposite).sqrt());
    if !(of_curve.ln().abs() > BEYOND_NATURE.ln()) {
        return None;
    }
    let [scaled_to, other] = measures;
    Some(Case {
        severity: Severity::Mistake,
        badness: times.ln().abs(),
        subject: format!("{site} by {scaled_to}"),
        what: format!(
            "the records bring {times:.2} times the {other} of the site's hazard: sites and records do not differ by \
             so much, units do"
        ),
        what_to_do: unit_that_explains(study, site, measures, of_curve).unwrap_or_else(|| {
            format!(
                "see both curves, of {scaled_to} and of {other}: their units, rates per year, whether they are of one \
                 site and one definition of the measure"
            )
        }),
    })
}

/// Bands of repaired spectra of whose samples many cannot be weighed to the site's hazard.
pub(super) fn failing_samples(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let stored = evidence.bands.as_ref()?;
    let mut cases = Vec::new();
    for bands in &stored.measures {
        let Some(repaired) = &bands.repaired else { continue };
        let records = stored.sizes[stored.largest()];
        let of_joint = repaired.bands.joint.as_ref().and_then(|joint| joint.failed.as_ref());
        let kinds = [
            (Some(&repaired.failed), format!("the site's hazard to {{}} of the samples of {records} records")),
            (of_joint, format!("the hazard to {{}} of the pairs of a sample of {records} records and a hazard curve")),
        ];
        for (site, name) in evidence.spectra.sites.iter().enumerate() {
            for (failed, what) in &kinds {
                let share = failed.map_or(0.0, |failed| failed[[site, stored.largest()]]);
                if scope.holds(site, bands.measure) && share > MANY_FAILED {
                    cases.push(Case {
                        severity: Severity::Caution,
                        badness: share,
                        subject: format!("{name} by {}", bands.measure.label()),
                        what: format!(
                            "no weights bring {}: their spectra are repaired in part only, and so is the band",
                            what.replace("{}", &format!("{:.0} %", 100.0 * share))
                        ),
                        what_to_do: "take more records, or records of another kind (uplift consistency)".to_owned(),
                    });
                }
            }
        }
    }
    Alarm::of_cases("repair-of-samples", cases)
}

/// `times` the level of the other measure do the records bring.
fn case(consistency: &StoredConsistency, site: usize, name: &str, times: f64) -> Case {
    let StoredConsistency { scaled_to, other, u_m, .. } = consistency;
    let (scaled_to, other) = (scaled_to.label(), other.label());
    let is_repaired = consistency.is_repaired(site);
    Case {
        severity: if is_repaired { Severity::Note } else { Severity::Caution },
        badness: times.ln().abs(),
        subject: format!("{name} by {scaled_to}"),
        what: format!(
            "the records bring {times:.1} times the {other} of the site's hazard; spectra by {scaled_to} are not \
             hazard-consistent"
        ),
        what_to_do: match u_m {
            Some(_) if is_repaired => {
                "use the repaired spectra beside them (uplift consistency; uplift design --repaired)"
            }
            Some(_) => "no weights of these records can mend it: uplift consistency says which are missing",
            None => {
                "[consistency] repair = \"weights\" gives spectra that are, beside the plain ones (uplift consistency)"
            }
        }
        .to_owned(),
    }
}
