//! Hazard curves that are probably mistaken, each by itself or among its weighted alternatives.

use uplift_job::alarm::Alarm;
use uplift_study::UniformRiskStudy;

use super::curves::without_common_rate;
use super::curves_at_site::CurvesAtSite;
use super::evidence::{Evidence, Scope};
use super::{branches, implausible, probabilities};

/// What is raised of all `curves`.
pub fn hazard_alarms(study: &UniformRiskStudy, curves: &[CurvesAtSite<'_>]) -> Vec<Alarm> {
    let (mut levelling_off, mut disagreeing, mut hardly_possible) = (Vec::new(), Vec::new(), Vec::new());
    for curves in curves {
        levelling_off.extend(probabilities::case(curves));
        let disagrees = branches::case(study, curves);
        // what is held against its alternatives says more of a unit than that it is hardly possible
        if disagrees.is_none() {
            hardly_possible.extend(implausible::case(study, curves));
        }
        disagreeing.extend(disagrees);
    }
    let alarms = [
        Alarm::from_cases("hazard-probabilities", levelling_off),
        Alarm::from_cases("branches-disagree", disagreeing),
        Alarm::from_cases("hazard-implausible", hardly_possible),
        Alarm::from_cases("no-common-rate", without_common_rate(curves)),
    ];
    alarms.into_iter().flatten().collect()
}

/// All that is raised of the curves of a result: those of each measure, and those of PGV and PGA side by side.
pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Vec<Alarm> {
    let mut all = Vec::new();
    for hazard in &evidence.hazard {
        for (site, curves) in hazard.sites.iter().enumerate() {
            if scope.holds(site, hazard.measure) {
                all.push(CurvesAtSite {
                    site: &evidence.spectra.sites[site],
                    measure: hazard.measure,
                    curve: &curves.curve,
                    branches: curves.branches.iter().map(|branch| (branch.name.as_str(), &branch.curve)).collect(),
                });
            }
        }
    }
    for (site, measure, curve) in &evidence.other_curves {
        if scope.holds(*site, *measure) {
            let site = &evidence.spectra.sites[*site];
            all.push(CurvesAtSite { site, measure: *measure, curve, branches: Vec::new() });
        }
    }
    let mut alarms = hazard_alarms(&evidence.study, &all);
    alarms.extend(super::curves::alarms(evidence, scope));
    alarms
}
