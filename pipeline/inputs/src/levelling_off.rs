//! Hazard curves that look like probabilities in some years where rates per year are meant.

use uplift_hazard::HazardCurve;
use uplift_job::text::short;

/// A probability saturates at 1, and a rate goes on rising: a curve that begins between this and 1 …
const NEARLY_CERTAIN: f64 = 0.9;
/// … and hardly falls, by less than this power of the intensity, where rates fall by its first power or so.
const FLAT: f64 = 0.25;

/// Whether the rates of `curve` look like probabilities in many years: `level off just below 1 (0.98 a year at 1 cm/s),
/// as probabilities in many years do`.
pub fn levelling_off(curve: &HazardCurve) -> Option<String> {
    let mut points = curve.points();
    let (first, second) = (points.next()?, points.next()?);
    let slope = (first.maf / second.maf).ln() / (second.im / first.im).ln();
    (first.maf > NEARLY_CERTAIN && first.maf <= 1.0 && slope < FLAT).then(|| {
        format!(
            "level off just below 1 ({} a year at {} {}), as probabilities in many years do",
            first.maf,
            if first.im < 1e-6 { short(first.im) } else { first.im.to_string() },
            curve.unit()
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_that_saturates_below_one_is_recognised_as_probabilities() {
        let look_like_probabilities = |maf: &dyn Fn(f64) -> f64| {
            let im: Vec<f64> = [0.5, 1.0, 2.0, 5.0, 20.0, 100.0].to_vec();
            let maf = im.iter().map(|&level| maf(level)).collect();
            levelling_off(&HazardCurve::new("PGV", "cm/s", "", im, maf).unwrap()).is_some()
        };
        let rate = |level: f64| 0.2 / level;
        assert!(look_like_probabilities(&|level| -(-50.0 * rate(level)).exp_m1()));
        assert!(!look_like_probabilities(&rate));
        // rates that happen to begin near 1, and rates above it
        assert!(!look_like_probabilities(&|level| 0.49 / level));
        assert!(!look_like_probabilities(&|level| 3.0 / level.powf(0.1)));
    }
}
