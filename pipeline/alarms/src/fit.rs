//! Fitted curves (Eq. 4.11) that leave their spectrum: how far, where, and where they stay with it.

use serde::Serialize;
use uplift_job::alarm::{Alarm, Case, Severity};
use uplift_regression::Exponential;
use uplift_uniform_risk::fit_ordinates;

use super::evidence::{Evidence, Scope};

/// A curve is with its spectrum where it is this near, relative to the ordinate: no further than half of a 90 % band by
/// PGV with 105 records.
const WITH_SPECTRUM: f64 = 0.1;
/// Further off than this, as a factor to either side, a curve says something else than its spectrum does.
const FAR: f64 = 1.5;
/// Further off than this it must not be used.
const FAR_OFF: f64 = 3.0;

/// How far a fitted curve goes with its spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FitReach {
    /// Curve over ordinate where they are furthest apart, of the strengths fitted whose ordinate is above the uplift
    /// displacement.
    pub worst_ratio: f64,
    /// The strength where that is.
    pub worst_at_strength: f64,
    /// The longest stretch of fitted strengths over which the curve stays within 10 % of the ordinates, first and last;
    /// none where it is with no ordinate.
    pub within_ten_percent: Option<(f64, f64)>,
}

/// How far `curve` goes with the spectrum `u_m`, m, over the `strengths` above `above`; ordinates up to
/// `uplift_displacement_m` do not count, for nothing rocks there. None where no ordinate counts.
pub fn reach_of_fit(
    curve: &Exponential,
    (strengths, u_m): (&[f64], &[f64]),
    above: f64,
    uplift_displacement_m: f64,
) -> Option<FitReach> {
    let counted: Vec<(f64, f64)> = strengths
        .iter()
        .zip(u_m)
        .filter(|(strength, u_m)| **strength > above && u_m.is_finite() && **u_m > uplift_displacement_m)
        .map(|(&strength, u_m)| (strength, curve.at(strength) / u_m))
        .collect();
    let distance = |ratio: f64| if ratio > 0.0 { ratio.ln().abs() } else { f64::INFINITY };
    let &(worst_at_strength, worst_ratio) = counted.iter().max_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
    let is_with = |ratio: f64| (ratio - 1.0).abs() <= WITH_SPECTRUM;
    let longest = counted
        .chunk_by(|a, b| is_with(a.1) == is_with(b.1))
        .filter(|stretch| is_with(stretch[0].1))
        .max_by(|a, b| length(a).total_cmp(&length(b)));
    let within_ten_percent = longest.map(|stretch| (stretch[0].0, stretch[stretch.len() - 1].0));
    Some(FitReach { worst_ratio, worst_at_strength, within_ten_percent })
}

/// How much of the strengths a stretch covers.
fn length(stretch: &[(f64, f64)]) -> f64 {
    stretch[stretch.len() - 1].0 - stretch[0].0
}

pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Vec<Alarm> {
    let (mut far, mut none, mut meaningless) = (Vec::new(), Vec::new(), Vec::new());
    let above = evidence.study.regression.strength_above;
    let uplift_m = evidence.study.oscillator.uplift_displacement_m;
    let strengths = &evidence.spectra.strengths;
    for place in evidence.places(scope) {
        let (site, poe) = (place.site, place.poe);
        let u_m = place.of_measure.u_m.block([site, poe]);
        let case = |severity, badness, what: String, what_to_do: &str| Case {
            severity,
            badness,
            subject: place.name.clone(),
            what,
            what_to_do: what_to_do.to_owned(),
        };
        // the file has no word for why there is no fit; the same ordinates give the same answer again
        let again = fit_ordinates(strengths, u_m, above);
        let Some(curve) = place.of_measure.fits[[site, poe]].curve() else {
            let reason = again.err().unwrap_or_else(|| "the file has none".to_owned());
            none.push(case(
                Severity::Note,
                1.0,
                format!("no fit: {reason}"),
                "Use the ordinates, lower regression.strength_above, or add strengths.values",
            ));
            continue;
        };
        if again.is_ok_and(|fit| fit.at_search_limit) {
            meaningless.push(case(
                Severity::Note,
                1.0,
                "the spectrum is not a decaying exponential, so single coefficients mean nothing".to_owned(),
                "Use the ordinates",
            ));
        }
        let Some(reach) = reach_of_fit(&curve, (strengths, u_m), above, uplift_m) else { continue };
        // a curve below zero is off by any factor
        let times =
            if reach.worst_ratio > 0.0 { reach.worst_ratio.max(1.0 / reach.worst_ratio) } else { f64::INFINITY };
        if times > FAR {
            let severity = if times > FAR_OFF { Severity::Caution } else { Severity::Note };
            far.push(case(severity, times, leaves(&reach), "Use the ordinates outside that range: uplift spectrum"));
        }
    }
    let kinds = [("fit-leaves-spectrum", far), ("no-fit", none), ("no-exponential", meaningless)];
    kinds.into_iter().filter_map(|(kind, cases)| Alarm::from_cases(kind, cases)).collect()
}

/// A curve that leaves its spectrum, in words.
fn leaves(reach: &FitReach) -> String {
    let FitReach { worst_ratio, worst_at_strength, within_ten_percent } = reach;
    let digits = if *worst_ratio < 0.1 { 3 } else { 2 };
    let range = match within_ten_percent {
        Some((from, to)) if from < to => format!("within 10 % from {from:.3} to {to:.3}"),
        Some((at, _)) => format!("within 10 % at {at:.3} only"),
        None => "nowhere within 10 %".to_owned(),
    };
    format!("the fitted curve is {worst_ratio:.digits$} times the ordinate at strength {worst_at_strength:.3}, {range}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u = exp(−η ln 2 · 10) + 0: 1/2 at 0.1, 1/4 at 0.2, 1/8 at 0.3, 1/16 at 0.4.
    const CURVE: Exponential = Exponential { c0: 1.0, c1: -6.931_471_805_599_453, c2: 0.0 };
    const STRENGTHS: [f64; 6] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5];

    #[test]
    fn the_worst_ratio_and_the_range_of_validity() {
        // half of the first, which is not fitted; with the second to fourth; a third of it; below uplift
        let u_m = [2.0, 0.5, 0.26, 0.12, 0.1875, 0.0004];
        let reach = reach_of_fit(&CURVE, (&STRENGTHS, &u_m), 0.05, 0.0005).unwrap();
        assert!((reach.worst_ratio - 1.0 / 3.0).abs() < 1e-12, "{reach:?}");
        assert_eq!((reach.worst_at_strength, reach.within_ten_percent), (0.4, Some((0.1, 0.3))));
        assert!(leaves(&reach).contains("0.33 times the ordinate at strength 0.400, within 10 %"));
        // a smaller displacement at uplift lets the last one count: 1/32 over 0.0004
        let reach = reach_of_fit(&CURVE, (&STRENGTHS, &u_m), 0.05, 0.0001).unwrap();
        assert!(reach.worst_at_strength == 0.5 && reach.worst_ratio > 70.0, "{reach:?}");
        // nothing to compare with
        assert_eq!(reach_of_fit(&CURVE, (&STRENGTHS, &[f64::INFINITY; 6]), 0.05, 0.0005), None);
        assert_eq!(reach_of_fit(&CURVE, (&STRENGTHS, &[1.0; 6]), 0.05, 0.0005).unwrap().within_ten_percent, None);
    }
}
