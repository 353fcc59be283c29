//! Hazard curves that look like probabilities in some years where rates per year are meant.

use uplift_inputs::{POE, curve_line, levelling_off};
use uplift_job::alarm::{Case, Severity};

use super::curves_at_site::CurvesAtSite;

/// What is raised of the curves of a site, where some look so.
pub(super) fn case(curves: &CurvesAtSite<'_>) -> Option<Case> {
    let key = curves.measure.key();
    let found = curves.first_that(|curve| levelling_off(curve).is_some())?;
    let line = curve_line(curves.measure, !curves.branches.is_empty(), POE);
    let what_to_do = if found.is_all {
        format!("If so, write {line} with the years of the file, and poe for maf in its head")
    } else {
        format!(
            "If all curves of {key} are, write {line}, and poe for maf in their heads; if not all, write rates per \
             year into the files of those that are"
        )
    };
    Some(Case {
        severity: Severity::Mistake,
        badness: found.curve.first().maf,
        subject: curves.subject(),
        what: format!("the rates of {} {}", found.name, levelling_off(found.curve)?),
        what_to_do,
    })
}

#[cfg(test)]
mod tests {
    use uplift_hazard::HazardCurve;
    use uplift_motion::IntensityMeasure;

    use super::*;

    fn curve(maf: impl Fn(f64) -> f64) -> HazardCurve {
        let im: Vec<f64> = [0.5, 1.0, 2.0, 5.0, 20.0, 100.0].to_vec();
        let maf = im.iter().map(|&level| maf(level)).collect();
        HazardCurve::new("PGV", "cm/s", "", im, maf).unwrap()
    }

    #[test]
    fn the_weighted_curve_that_looks_so_is_named() {
        let rates = curve(|level| 0.2 / level);
        let probabilities = curve(|level| -(-50.0 * 0.2 / level).exp_m1());
        let said = |branches: &[(&'static str, &HazardCurve)]| {
            let curves = CurvesAtSite {
                site: "Here",
                measure: IntensityMeasure::Pgv,
                curve: &rates,
                branches: branches.to_vec(),
            };
            case(&curves).map_or_else(String::new, |case| case.what)
        };
        assert_eq!(said(&[("a", &rates), ("b", &rates)]), "");
        let what = said(&[("a", &rates), ("b", &probabilities)]);
        assert!(what.starts_with("the rates of the weighted curve \"b\" level off just below 1"), "{what}");
        let what = said(&[("a", &probabilities), ("b", &rates), ("c", &probabilities)]);
        assert!(what.starts_with("the rates of the weighted curve \"a\" (and 1 more of 3) level off"), "{what}");
    }
}
