//! Hazard curves by which the extreme shaking is frequent, or the faintest rare.

use uplift_inputs::{hardly_possible, unit_that_covers, units_that_make_possible};
use uplift_job::alarm::{Case, Severity};
use uplift_motion::IntensityMeasure;
use uplift_plausible::USUAL_GRAVITY;
use uplift_study::UniformRiskStudy;

use super::curves_at_site::CurvesAtSite;

/// What is raised of the curves of a site, where some say what is hardly possible.
pub(super) fn case(study: &UniformRiskStudy, curves: &CurvesAtSite<'_>) -> Option<Case> {
    let measure = curves.measure;
    // another gravity than the Earth's moves every acceleration, and has an alarm of its own
    if measure != IntensityMeasure::Pgv && !USUAL_GRAVITY.contains(study.gravity_m_s2) {
        return None;
    }
    let Some(found) = curves.first_that(|curve| hardly_possible(curve, measure).is_some()) else {
        let what_to_do = unit_that_covers(study, (curves.site, measure), curves.curve)?;
        return Some(Case {
            severity: Severity::Mistake,
            badness: 1.0,
            subject: curves.subject(),
            what: "the hazard curve is extrapolated far".to_owned(),
            what_to_do,
        });
    };
    let odd = hardly_possible(found.curve, measure)?;
    Some(Case {
        severity: Severity::Mistake,
        badness: odd.times,
        subject: curves.subject(),
        what: format!("by {} {}, which is hardly possible", found.name, odd.what),
        what_to_do: if odd.is_faint_and_frequent {
            "Are its rates in per cent? Divide them by 100; else check its unit and measure".to_owned()
        } else {
            units_that_make_possible(study, (curves.site, measure), found.curve)
                .unwrap_or_else(|| "Check its unit, its measure, and that it gives annual rates".to_owned())
        },
    })
}
