//! Hazard curves that look like probabilities in some years where rates per year are meant.

use uplift_hazard::HazardCurve;
use uplift_inputs::{POE, curve_line};
use uplift_job::alarm::{Case, Severity};
use uplift_job::text::short;

use super::curves_at_site::CurvesAtSite;

/// A probability saturates at 1, and a rate goes on rising: a curve that begins between this and 1 …
const NEARLY_CERTAIN: f64 = 0.9;
/// … and hardly falls, by less than this power of the intensity, where rates fall by its first power or so.
const FLAT: f64 = 0.25;

/// Whether the rates of `curve` look like probabilities in many years.
fn look_like_probabilities(curve: &HazardCurve) -> bool {
    let mut points = curve.points();
    let (Some(first), Some(second)) = (points.next(), points.next()) else { return false };
    let slope = (first.maf / second.maf).ln() / (second.im / first.im).ln();
    first.maf > NEARLY_CERTAIN && first.maf <= 1.0 && slope < FLAT
}

/// What is raised of the curves of a site, where some look so.
pub(super) fn case(curves: &CurvesAtSite<'_>) -> Option<Case> {
    let key = curves.measure.key();
    let found = curves.first_that(look_like_probabilities)?;
    let line = curve_line(curves.measure, !curves.branches.is_empty(), POE);
    let what_to_do = if found.is_all {
        format!("If so, write {line} with the years of the file, and poe for maf in its head")
    } else {
        format!(
            "If all curves of {key} are, write {line}, and poe for maf in their heads; if not all, write rates per \
             year into the files of those that are"
        )
    };
    let first = found.curve.first();
    Some(Case {
        severity: Severity::Mistake,
        badness: first.maf,
        subject: curves.subject(),
        what: format!(
            "the rates of {} level off just below 1 ({} a year at {} {}), as probabilities in many years do",
            found.name,
            first.maf,
            if first.im < 1e-6 { short(first.im) } else { first.im.to_string() },
            found.curve.unit()
        ),
        what_to_do,
    })
}

#[cfg(test)]
mod tests {
    use uplift_motion::IntensityMeasure;

    use super::*;

    fn curve(maf: impl Fn(f64) -> f64) -> HazardCurve {
        let im: Vec<f64> = [0.5, 1.0, 2.0, 5.0, 20.0, 100.0].to_vec();
        let maf = im.iter().map(|&level| maf(level)).collect();
        HazardCurve::new("PGV", "cm/s", "", im, maf).unwrap()
    }

    #[test]
    fn a_curve_that_saturates_below_one_is_recognised_as_probabilities() {
        let rate = |level: f64| 0.2 / level;
        assert!(look_like_probabilities(&curve(|level| -(-50.0 * rate(level)).exp_m1())));
        assert!(!look_like_probabilities(&curve(rate)));
        // rates that happen to begin near 1, and rates above it
        assert!(!look_like_probabilities(&curve(|level| 0.49 / level)));
        assert!(!look_like_probabilities(&curve(|level| 3.0 / level.powf(0.1))));
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
