//! Records that do not bring the site's hazard of the other measure: spectra of such a set are true of the set, and not
//! of the site.

use super::evidence::{Evidence, Scope};
use super::{Alarm, Case, Severity};
use crate::result::StoredConsistency;

pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let mut cases = Vec::new();
    for consistency in &evidence.consistency {
        for (site, name) in evidence.spectra.sites.iter().enumerate() {
            if scope.holds(site, consistency.scaled_to) && consistency.verdict[site] == "inconsistent" {
                cases.push(case(consistency, site, name));
            }
        }
    }
    Alarm::of_cases("hazard-inconsistent", cases)
}

fn case(consistency: &StoredConsistency, site: usize, name: &str) -> Case {
    let StoredConsistency { scaled_to, other, bias, u_m, .. } = consistency;
    let (scaled_to, other) = (scaled_to.label(), other.label());
    let is_repaired = u_m.as_ref().is_some_and(|u_m| u_m.block([site]).iter().any(|u_m| !u_m.is_nan()));
    Case {
        severity: if is_repaired { Severity::Note } else { Severity::Caution },
        badness: bias[site].ln().abs(),
        subject: format!("{name} by {scaled_to}"),
        what: format!(
            "the records bring {:.1} times the {other} of the site's hazard; spectra by {scaled_to} are not \
             hazard-consistent",
            bias[site]
        ),
        what_to_do: if is_repaired {
            "use the repaired spectra beside them (uplift consistency)".to_owned()
        } else {
            "[consistency] repair = \"weights\" gives spectra that are, beside the plain ones (uplift consistency)"
                .to_owned()
        },
    }
}
