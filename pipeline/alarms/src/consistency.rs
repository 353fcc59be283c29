//! Records that miss the site's hazard of the other measure: spectra of such a set are true of the set, and not
//! of the site.

use uplift_consistency::Verdict;
use uplift_job::alarm::{Alarm, Case, RESULT, Severity};
use uplift_job::text::risk_name;
use uplift_result::StoredConsistency;
use uplift_uniform_risk::MANY_FAILED;
use uplift_uniform_risk::consistency::times_in_words;

use super::curves;
use super::evidence::{Evidence, Scope};

/// The kind of the warning that the weights of a repair leave few effective records.
pub const FEW_EFFECTIVE_RECORDS: &str = "few-effective-records";

pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let mut cases = Vec::new();
    // of one risk the number is its own, and no mean
    let at = scope.poe.map_or_else(String::new, |poe| {
        format!(" at {}", risk_name(evidence.spectra.poes[poe], evidence.spectra.years))
    });
    for consistency in &evidence.consistency {
        for (site, name) in evidence.spectra.sites.iter().enumerate() {
            if let Some(times) = missed(evidence, scope, consistency, site) {
                cases.push(case(consistency, scope, (site, name, &at), times));
            }
        }
    }
    Alarm::from_cases("hazard-inconsistent", cases)
}

/// How many times the site's level of the other measure the records have, where that is raised: it is within the
/// scope, too far from 1, and not the fault of the curves.
fn missed(evidence: &Evidence, scope: &Scope, consistency: &StoredConsistency, site: usize) -> Option<f64> {
    if !scope.holds(site, consistency.scaled_to) || curves::are_apart(evidence, site) {
        return None;
    }
    // one risk is judged by itself, so that the others of a result do not matter to it
    let (times, verdict) = match scope.poe {
        None => (consistency.bias[site], consistency.verdict[site].as_str()),
        Some(poe) => {
            let ratio = consistency.ratio[[site, poe]];
            (ratio, Verdict::from_bias(ratio, ratio.ln().abs()).key())
        }
    };
    (times.is_finite() && verdict == Verdict::Inconsistent.key()).then_some(times)
}

/// Spectra that no weights repair, though the study or a command asked for it.
pub(super) fn without_repair(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let mut cases = Vec::new();
    for consistency in evidence.consistency.iter().filter(|own| own.u_m.is_some()) {
        for (site, name) in evidence.spectra.sites.iter().enumerate() {
            if scope.holds(site, consistency.scaled_to) && !consistency.is_repaired(site) {
                cases.push(Case {
                    severity: Severity::Caution,
                    badness: consistency.max[site],
                    subject: format!("{name} by {}", consistency.scaled_to.label()),
                    what: "too few records match both hazard curves: no repaired spectrum".to_owned(),
                    what_to_do: format!("See why: uplift consistency {RESULT} --details"),
                });
            }
        }
    }
    Alarm::from_cases("no-repair", cases)
}

/// What limits the trust in repaired spectra.
pub(super) fn repair_alarms(evidence: &Evidence, scope: &Scope) -> impl Iterator<Item = Alarm> {
    few_effective(evidence, scope).into_iter().chain(failing_samples(evidence, scope))
}

/// Repairs whose weights leave few records that count.
pub(super) fn few_effective(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let (mut cases, advised) = (Vec::new(), evidence.study.consistency.least_effective);
    for (consistency, least) in evidence.consistency.iter().zip(&evidence.least_effective) {
        for (site, (name, &least)) in evidence.spectra.sites.iter().zip(least.iter().flatten()).enumerate() {
            if scope.holds(site, consistency.scaled_to) && consistency.is_repaired(site) && least < advised as f64 {
                cases.push(Case {
                    severity: Severity::Caution,
                    badness: 1.0 / least,
                    subject: format!("{name} by {}, repaired", consistency.scaled_to.label()),
                    what: format!("the weights leave {least:.1} effective records ({advised} advised)"),
                    what_to_do: format!("See where: uplift consistency {RESULT} --details"),
                });
            }
        }
    }
    Alarm::from_cases(FEW_EFFECTIVE_RECORDS, cases)
}

/// Bands of repaired spectra of whose samples many cannot be weighed to the site's hazard.
fn failing_samples(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let stored = evidence.bands.as_ref()?;
    let mut cases = Vec::new();
    for bands in &stored.measures {
        let Some(repaired) = &bands.repaired else { continue };
        let records = stored.sizes[stored.largest()];
        let of_joint = repaired.bands.joint.as_ref().and_then(|joint| joint.failed.as_ref());
        let kinds = [
            (Some(&repaired.failed), format!("of resamples of {records} records")),
            (of_joint, format!("of resamples of {records} records with a hazard curve")),
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
                            "weights fail for {:.0} % {what}, so the band is repaired only in part",
                            100.0 * share
                        ),
                        what_to_do: "Add records".to_owned(),
                    });
                }
            }
        }
    }
    Alarm::from_cases("repair-of-samples", cases)
}

/// `times` the level of the other measure do the records bring.
fn case(consistency: &StoredConsistency, scope: &Scope, (site, name, at): (usize, &str, &str), times: f64) -> Case {
    let StoredConsistency { scaled_to, other, .. } = consistency;
    let (scaled_to, other) = (scaled_to.label(), other.label());
    let is_repaired = consistency.is_repaired(site);
    Case {
        severity: if is_repaired { Severity::Note } else { Severity::Caution },
        badness: times.ln().abs(),
        subject: format!("{name} by {scaled_to}"),
        what: format!("scaled records have {} times the site's {other}{at}", times_in_words(consistency, site, times)),
        what_to_do: remedy(consistency, scope, site),
    }
}

/// What mends the spectrum of a site whose records miss its hazard of the other measure.
fn remedy(consistency: &StoredConsistency, scope: &Scope, site: usize) -> String {
    match &consistency.u_m {
        Some(_) if consistency.is_repaired(site) => {
            let key = consistency.scaled_to.key();
            let command = if scope.for_design { String::new() } else { format!(": uplift spectrum {RESULT}") };
            format!("Use{command} --repaired --measure {key}")
        }
        Some(_) => format!("See what is missing: uplift consistency {RESULT} --details"),
        None => format!("Repair: uplift consistency {RESULT} --repair"),
    }
}

/// The same where a spectrum by PGV and one by PGA disagree at a `site`: of repaired spectra by the measure asked
/// about, or by that which leaves most effective records; else of records that miss the hazard by that measure, or by
/// the worse; none where neither is so.
pub(super) fn remedy_of_gap(evidence: &Evidence, scope: &Scope, site: usize) -> Option<String> {
    let misses =
        |of: &StoredConsistency| of.bias[site].is_finite() && of.verdict[site].as_str() == Verdict::Inconsistent.key();
    let is_asked = |of: &StoredConsistency| scope.measure == Some(of.scaled_to);
    let effective = |of: &Option<Vec<f64>>| of.as_ref().map_or(0.0, |least| least[site]);
    let rank = |(of, least): &(&StoredConsistency, &Option<Vec<f64>>)| {
        let is_repaired = of.is_repaired(site);
        let last = if is_repaired { effective(least) } else { of.bias[site].ln().abs() };
        (is_repaired, is_asked(of), last)
    };
    let all = evidence.consistency.iter().zip(&evidence.least_effective);
    let found = all.filter(|(of, _)| misses(of) || of.is_repaired(site)).max_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2))
    });
    Some(remedy(found?.0, scope, site))
}
