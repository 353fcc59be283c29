//! Hazard curves that look like probabilities in some years where rates per year are meant.

use uplift_hazard::HazardCurve;

use super::evidence::{Evidence, Scope};
use super::{Alarm, Case, Severity};

/// A probability saturates at 1, and a rate goes on rising: a curve that begins between this and 1 …
const NEARLY_CERTAIN: f64 = 0.9;
/// … and hardly falls, by less than this power of the intensity, where rates fall by its first power or so.
const FLAT: f64 = 0.25;

/// Whether the rates of `curve` look like probabilities in many years.
pub(crate) fn look_like_probabilities(curve: &HazardCurve) -> bool {
    let mut points = curve.points();
    let (Some(first), Some(second)) = (points.next(), points.next()) else { return false };
    let slope = (first.maf / second.maf).ln() / (second.im / first.im).ln();
    first.maf > NEARLY_CERTAIN && first.maf <= 1.0 && slope < FLAT
}

/// What is said of such a curve.
pub(crate) fn what_of_probabilities(curve: &HazardCurve) -> String {
    let first = curve.first();
    format!(
        "the rates of the hazard curve level off just below 1 ({} a year at {} {}): they look like probabilities in \
         many years, 50 mostly, and the spectra would be far too large",
        first.maf,
        first.im,
        curve.unit()
    )
}

pub(super) fn alarms(evidence: &Evidence, scope: &Scope) -> Option<Alarm> {
    let mut cases = Vec::new();
    for hazard in &evidence.hazard {
        for (site, curves) in hazard.sites.iter().enumerate() {
            let measure = hazard.measure;
            let mut all = std::iter::once(&curves.curve).chain(curves.branches.iter().map(|(_, curve)| curve));
            let Some(curve) = all.find(|curve| look_like_probabilities(curve)) else { continue };
            if scope.holds(site, measure) {
                cases.push(Case {
                    severity: Severity::Mistake,
                    badness: curve.first().maf,
                    subject: format!("{}, {}", evidence.spectra.sites[site], measure.label()),
                    what: what_of_probabilities(curve),
                    what_to_do: format!(
                        "if so, say so in [[sites]]: {} = {{ file = …, kind = \"poe\", years = 50 }}",
                        measure.key()
                    ),
                });
            }
        }
    }
    Alarm::of_cases("hazard-probabilities", cases)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn curve(maf: impl Fn(f64) -> f64) -> HazardCurve {
        let im: Vec<f64> = [0.5, 1.0, 2.0, 5.0, 20.0, 100.0].to_vec();
        let maf = im.iter().map(|&level| maf(level)).collect();
        HazardCurve::new("PGV", "cm/s", "", im, maf).unwrap()
    }

    #[test]
    fn a_curve_that_saturates_below_one_is_told_from_rates() {
        let rate = |level: f64| 0.2 / level;
        assert!(look_like_probabilities(&curve(|level| -(-50.0 * rate(level)).exp_m1())));
        assert!(!look_like_probabilities(&curve(rate)));
        // rates that happen to begin near 1, and rates above it
        assert!(!look_like_probabilities(&curve(|level| 0.49 / level)));
        assert!(!look_like_probabilities(&curve(|level| 3.0 / level.powf(0.1))));
    }
}
