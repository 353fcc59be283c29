//! The risk integral of a lognormal fragility, exact on a log–log hazard curve.

use uplift_fragility::{LognormalFragility, ln_normal_cdf};
use uplift_hazard::{HazardCurve, HazardPoint};

/// The risk of a lognormal fragility.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LognormalRisk {
    /// Mean annual frequency, 1/yr, upper tail included; intensities below the curve's first
    /// abscissa contribute nothing.
    pub per_year: f64,
    /// The part of it from above the curve's last abscissa, where the fragility is taken as constant: P λ there, 1/yr.
    pub upper_tail_per_year: f64,
}

/// Risk integral (Eq. 4.4) of a lognormal fragility, P(im) = Φ(ln(im/θ)/β), in closed form.
///
/// On a segment the hazard is a power law, λ(x) = λᵢ (x/xᵢ)⁻ᵏ. Integration by parts leaves ∫ λ dΦ, which completes the
/// square: with z = ln(x/θ)/β it is λᵢ exp(k ln(xᵢ/θ) + k²β²/2) [Φ(zᵢ₊₁ + kβ) − Φ(zᵢ + kβ)].
///
/// - `curve`: hazard of the fragility's intensity measure, in the unit of its median.
pub fn lognormal_risk(curve: &HazardCurve, fragility: &LognormalFragility) -> LognormalRisk {
    let (first, last) = (curve.first(), curve.last());
    // Summed from the rare end, where the terms are small.
    let (im, maf) = (curve.im(), curve.maf());
    let segments: f64 = (1..im.len())
        .rev()
        .map(|i| {
            let left = HazardPoint { im: im[i - 1], maf: maf[i - 1] };
            segment_integral(left, HazardPoint { im: im[i], maf: maf[i] }, fragility)
        })
        .sum();
    // ∫ P |dλ| = P₀ λ₀ − Pₙ λₙ + ∫ λ dP; the upper tail gives Pₙ λₙ back.
    let upper_tail_per_year = fragility.probability(last.im) * last.maf;
    LognormalRisk { per_year: segments + fragility.probability(first.im) * first.maf, upper_tail_per_year }
}

/// ∫ λ dP over one power-law segment.
fn segment_integral(left: HazardPoint, right: HazardPoint, fragility: &LognormalFragility) -> f64 {
    let beta = fragility.dispersion();
    let exponent = (left.maf / right.maf).ln() / (right.im / left.im).ln();
    let ln_left = (left.im / fragility.median()).ln();
    let ln_right = (right.im / fragility.median()).ln();
    let shift = exponent * beta;
    let ln_scale = left.maf.ln() + exponent * ln_left + 0.5 * shift * shift;
    let (a, b) = (ln_left / beta + shift, ln_right / beta + shift);
    // The factor may overflow where the tail vanishes: multiply as logarithms, in the tail that is small.
    let term = |z: f64| (ln_scale + ln_normal_cdf(z)).exp();
    if a > 0.0 { term(-a) - term(-b) } else { term(b) - term(a) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_single_power_law_has_the_textbook_closed_form() {
        // λ = k₀ x⁻ᵏ far beyond the fragility on both sides: risk = k₀ θ⁻ᵏ exp(k²β²/2).
        // (Jalayer and Cornell, "A technical framework for probability-based demand and capacity factor design", 2003.)
        let power = |x: f64| 2e-3 * x.powf(-2.5);
        let curve = HazardCurve::new("PGV", "cm/s", "", vec![1e-6, 1e6], vec![power(1e-6), power(1e6)]).unwrap();
        let risk = lognormal_risk(&curve, &LognormalFragility::new(3.0, 0.4).unwrap());
        let expected = power(3.0) * (0.5_f64).exp(); // k β = 1
        assert!((risk.per_year / expected - 1.0).abs() < 1e-12, "{risk:?} {expected}");
    }

    #[test]
    fn steep_hazard_and_wide_fragility_do_not_overflow() {
        let curve = HazardCurve::new("PGV", "cm/s", "", vec![1.0, 2.0], vec![1.0, 2.0_f64.powi(-60)]).unwrap();
        let risk = lognormal_risk(&curve, &LognormalFragility::new(1.5, 2.0).unwrap());
        assert!(risk.per_year > 0.0 && risk.per_year < 1.0, "{risk:?}");
    }

    proptest! {
        /// Against a fine trapezoid in λ on the same log–log curve.
        #[test]
        fn agrees_with_brute_force(
            median in 0.2_f64..8.0, beta in 0.1_f64..1.2, k1 in 0.3_f64..3.0, k2 in 0.3_f64..5.0,
        ) {
            let rates = vec![1.0, 2.0_f64.powf(-k1), 2.0_f64.powf(-k1 - k2)];
            let curve = HazardCurve::new("PGV", "cm/s", "", vec![1.0, 2.0, 4.0], rates).unwrap();
            let fragility = LognormalFragility::new(median, beta).unwrap();
            let steps = 20_000;
            let mut brute = fragility.probability(4.0) * curve.last().maf;
            let at = |i: i32| {
                let x = 4.0_f64.powf(f64::from(i) / f64::from(steps)).min(4.0);
                (fragility.probability(x), curve.rate_at(x).unwrap())
            };
            for i in 0..steps {
                let ((p, rate), (q, next)) = (at(i), at(i + 1));
                brute += 0.5 * (p + q) * (rate - next);
            }
            let risk = lognormal_risk(&curve, &fragility);
            // The trapezoid's own error: a fraction (step/β)² of the risk.
            prop_assert!((risk.per_year / brute - 1.0).abs() < 1e-6, "{} {}", risk.per_year, brute);
            prop_assert!(risk.upper_tail_per_year < risk.per_year);
        }
    }
}
