//! Hazard curves of PGV and of PGA that cannot be of one site: one of them is in another unit, or of something else.

use uplift_inputs::unit_that_explains;
use uplift_job::alarm::{Alarm, Case, Severity};
use uplift_job::text::{rate, short};
use uplift_motion::IntensityMeasure::{Pga, Pgv};
use uplift_plausible::USUAL_GRAVITY;
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::consistency::ConsistencyReport;

use super::curves_at_site::CurvesAtSite;
use super::evidence::{Evidence, Scope};

/// PGA over PGV differs by 3 times between rock near by and soft soil far away, of which records bring some.
const BEYOND_NATURE: f64 = 5.0;

pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let sites = evidence.spectra.sites.iter().enumerate().filter(|(site, _)| scope.holds_site(*site));
    let case = |(site, name): (usize, &String)| case(&evidence.study, name, biases(evidence, site));
    Alarm::from_cases("curves-disagree", sites.filter_map(case).collect())
}

/// Whether the curves of a site are reported not to belong together.
pub(super) fn are_apart(evidence: &Evidence, site: usize) -> bool {
    beyond_nature(&evidence.study, biases(evidence, site)).is_some()
}

fn biases(evidence: &Evidence, site: usize) -> [Option<f64>; 2] {
    [(Pgv, Pga), (Pga, Pgv)].map(|(scaled_to, other)| {
        let of = evidence.consistency.iter().find(|of| (of.scaled_to, of.other) == (scaled_to, other));
        of.map(|of| of.bias[site])
    })
}

/// The same of a study that is looked at and not run.
pub fn curves_alarm(study: &UniformRiskStudy, report: &ConsistencyReport) -> Option<Alarm> {
    let case = |site: &String| {
        let biases = [(Pgv, Pga), (Pga, Pgv)].map(|(scaled_to, other)| {
            let wanted = (site, scaled_to.label(), other.label());
            report.rows.iter().find(|row| (&row.site, row.scaled_to, row.shows) == wanted)?.bias
        });
        case(study, site, biases)
    };
    let sites = study.sites.iter().map(|site| &site.name);
    Alarm::from_cases("curves-disagree", sites.filter_map(case).collect())
}

/// How many times too high the curve of PGA is for that of PGV, by what the records bring of the site's level of the
/// one scaled to the other: of PGA scaled to PGV, and of PGV scaled to PGA.
///
/// A curve that is too high is below the line in the first and above it in the second; what both have in common is no
/// matter of curves.
fn too_high([of_pga, of_pgv]: [Option<f64>; 2]) -> Option<f64> {
    let [of_pga, of_pgv] = [of_pga, of_pgv].map(|bias| bias.filter(|bias| bias.is_finite() && *bias > 0.0));
    match (of_pga, of_pgv) {
        (Some(of_pga), Some(of_pgv)) => Some((of_pgv / of_pga).sqrt()),
        (Some(of_pga), None) => Some(1.0 / of_pga),
        (None, of_pgv) => of_pgv,
    }
}

/// [`too_high`] where that is more, or less, than sites are.
fn beyond_nature(study: &UniformRiskStudy, biases: [Option<f64>; 2]) -> Option<f64> {
    let too_high = too_high(biases)?;
    // another gravity than the Earth's moves every acceleration, and has an alarm of its own
    let is_usual = USUAL_GRAVITY.contains(study.gravity_m_s2);
    (too_high.max(1.0 / too_high) > BEYOND_NATURE && is_usual).then_some(too_high)
}

fn case(study: &UniformRiskStudy, site: &str, biases: [Option<f64>; 2]) -> Option<Case> {
    let too_high = beyond_nature(study, biases)?;
    let times = too_high.max(1.0 / too_high);
    let direction = if too_high > 1.0 { "high" } else { "low" };
    Some(Case {
        severity: Severity::Mistake,
        badness: times,
        subject: site.to_owned(),
        what: format!(
            "its curve of PGA is {} times too {direction} for its curve of PGV and these records; sites differ by 2 or \
             3 times",
            if times < 1e6 { format!("{times:.1}") } else { short(times) }
        ),
        what_to_do: unit_that_explains(study, site, too_high)
            .unwrap_or_else(|| "Check both curves: unit, annual rates, site, and definition of the measure".to_owned()),
    })
}

/// Curves of a site of which one is rarer at all its levels than the other at any: nothing of them can be compared.
pub(super) fn without_common_rate(curves: &[CurvesAtSite<'_>]) -> Vec<Case> {
    let mut cases = Vec::new();
    for (position, one) in curves.iter().enumerate() {
        for other in curves[position + 1..].iter().filter(|other| other.site == one.site) {
            let ends = |of: &CurvesAtSite<'_>| [of.curve.first().maf, of.curve.last().maf];
            let [high, low] = [ends(one), ends(other)];
            let apart = (low[1] / high[0]).max(high[1] / low[0]);
            if apart > 1.0 {
                let range = |of: &CurvesAtSite<'_>, [most, least]: [f64; 2]| {
                    format!("{} from {} to {}", of.measure.label(), rate(most), rate(least))
                };
                cases.push(Case {
                    severity: Severity::Mistake,
                    badness: apart,
                    subject: one.site.to_owned(),
                    what: format!(
                        "its curves of {} and {} a year have no rate in common",
                        range(one, high),
                        range(other, low)
                    ),
                    what_to_do: "Check both curves: annual rates, unit, and site".to_owned(),
                });
            }
        }
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_that_is_too_high_differs_from_a_bias_of_both_measures() {
        // the records bring a tenth of its PGA, and ten times its PGV
        assert_eq!(too_high([Some(0.1), Some(10.0)]), Some(10.0));
        assert_eq!(too_high([Some(10.0), Some(0.1)]), Some(0.1));
        // too much of both
        assert_eq!(too_high([Some(6.0), Some(6.0)]), Some(1.0));
        // one alone
        assert_eq!(too_high([Some(0.1), None]), Some(10.0));
        assert_eq!(too_high([None, Some(8.0)]), Some(8.0));
        assert_eq!(too_high([Some(0.5), Some(f64::NAN)]), Some(2.0));
        assert_eq!(too_high([None, Some(f64::INFINITY)]), None);
    }

    fn study(pgv: &str, pga: &str, gravity_m_s2: f64) -> UniformRiskStudy {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("curve.csv"), "iml,maf\n").unwrap();
        let curve = |unit: &str| format!("{{ file = \"curve.csv\", unit = \"{unit}\" }}");
        let text = format!(
            "gravity_m_s2 = {gravity_m_s2}\n[pgv]\n[[sites]]\nname = \"Sion 2.1\"\npgv = {}\npga = {}\n",
            curve(pgv),
            curve(pga)
        );
        let path = folder.path().join("study.toml");
        std::fs::write(&path, text).unwrap();
        uplift_study::Study::load(&path, &[]).unwrap()
    }

    /// What is reported where the records bring so much of PGA and of PGV.
    fn told(units: [&str; 2], biases: [Option<f64>; 2]) -> Option<String> {
        case(&study(units[0], units[1], 9.81), "Sion 2.1", biases)
            .map(|case| format!("{}; {}", case.what, case.what_to_do))
    }

    #[test]
    fn the_warning_names_the_unit_that_explains_it() {
        for (units, biases, words) in [
            (["cm/s", "g"], [Some(0.09), Some(14.0)], ["12.5 times too high", "numbers of its PGA in m/s2"]),
            (
                ["cm/s", "g"],
                [Some(0.001), None],
                ["numbers of its PGA in cm/s2 (pga = {", "or of its PGV in m/s and of its PGA in m/s2 (pgv = {"],
            ),
            (
                ["cm/s", "m/s2"],
                [Some(9.0), None],
                ["9.0 times too low", "of its PGV in mm/s (divide its levels by 10 into cm/s), or of its PGA in g ("],
            ),
            (
                ["cm/s", "g"],
                [Some(0.012), Some(90.0)],
                [
                    "86.6 times too high",
                    "or of its PGA in per cent of g (divide its levels by 100 into g)? Each would explain it",
                ],
            ),
            (["m/s", "g"], [Some(120.0), Some(0.01)], ["109.5 times too low", "numbers of its PGV in cm/s"]),
            (["cm/s", "g"], [Some(9.0), Some(0.1)], ["9.5 times too low", "of its PGV in mm/s"]),
            (["cm/s", "g"], [Some(300.0), None], ["300.0 times too low", "Check both curves"]),
        ] {
            let told = told(units, biases).unwrap();
            assert!(words.iter().all(|word| told.contains(word)), "{told}");
        }
        let remedy =
            "Then pga = { file = …, unit = \"m/s2\" } in [[sites]], or --set 'sites.\"Sion 2.1\".pga.unit=m/s2'";
        assert!(told(["cm/s", "g"], [Some(0.1), None]).unwrap().contains(remedy));
    }

    #[test]
    fn probabilities_may_be_of_other_years() {
        let text = "[pgv]\n[[sites]]\nname = \"Here\"\npgv = \"c.csv\"\n\
                    pga = { file = \"c.csv\", kind = \"poe\", years = 50 }\n";
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("c.csv"), "iml,maf\n").unwrap();
        let path = folder.path().join("study.toml");
        std::fs::write(&path, text).unwrap();
        let case = case(&uplift_study::Study::load(&path, &[]).unwrap(), "Here", [Some(9.0), None]).unwrap();
        assert!(case.what_to_do.ends_with("divide its levels by 10 into cm/s; or is PGA not of 50 years?"));
    }

    #[test]
    fn curves_without_a_common_rate_are_reported() {
        use uplift_hazard::HazardCurve;
        let curve = |rates: [f64; 2]| HazardCurve::new("IM", "g", "", vec![1.0, 10.0], rates.to_vec()).unwrap();
        let told = |pgv: [f64; 2], pga: [f64; 2]| {
            let both = [(Pgv, "Here", curve(pgv)), (Pga, "Here", curve(pga)), (Pga, "There", curve([1e-9, 1e-10]))];
            let curves: Vec<CurvesAtSite<'_>> = both
                .iter()
                .map(|(measure, site, curve)| CurvesAtSite { site, measure: *measure, curve, branches: Vec::new() })
                .collect();
            without_common_rate(&curves).into_iter().map(|case| (case.subject, case.what)).collect::<Vec<_>>()
        };
        assert_eq!(told([0.1, 1e-4], [1e-4, 1e-6]), []);
        let what =
            "its curves of PGV from 1.0e-1 to 1.0e-4 and PGA from 9.9e-5 to 1.0e-6 a year have no rate in common";
        assert_eq!(told([0.1, 1e-4], [9.9e-5, 1e-6]), [("Here".to_owned(), what.to_owned())]);
        assert_eq!(told([1e-5, 1e-6], [0.1, 1e-4]).len(), 1);
    }

    #[test]
    fn possible_sites_and_another_gravity_are_not_reported() {
        for biases in [[Some(0.21), None], [Some(4.9), Some(0.21)], [Some(9.0), Some(9.0)], [None, None]] {
            assert_eq!(told(["cm/s", "g"], biases), None, "{biases:?}");
        }
        assert_eq!(case(&study("cm/s", "g", 981.0), "Sion 2.1", [Some(0.01), None]), None);
    }
}
