//! The intensity to design for where the risk is given, not the hazard: the risk-targeted ground motion.

use uplift_fragility::{LognormalFragility, normal_quantile};
use uplift_hazard::HazardCurve;

use crate::{LognormalRisk, RiskError, check_target, lognormal_risk};

/// Standard deviations of ln im beyond the hazard curve at which no risk is left.
const BEYOND: f64 = 40.0;

/// A lognormal fragility placed so that its risk is the one asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RiskTargetedLevel {
    /// The level at which the fragility has its given probability, in the unit of the curve.
    pub level: f64,
    /// The fragility.
    pub fragility: LognormalFragility,
    /// Its risk: the target, to rounding.
    pub risk: LognormalRisk,
}

/// The level x at which a structure may fail with `probability`, so that with the lognormal fragility
/// `P(im) = Φ(ln(im/x)/β + Φ⁻¹(probability))` it fails as often as `target_per_year` (Eq. 4.4 turned round).
///
/// - `curve`: hazard of the intensity measure; the level is in its unit.
/// - `target_per_year`: mean annual frequency of failure, 1/yr.
/// - `probability`: of failure at the level, between 0 and 1; 0.1 in building codes.
/// - `dispersion`: β of the fragility.
///
/// # Errors
/// A probability or dispersion that is none; a target that is not positive and finite, or not below the rate of the
/// curve's first abscissa, which no fragility exceeds.
///
/// # Source
/// N. Luco et al., "Risk-targeted versus current seismic design maps for the conterminous United States", SEAOC
/// Convention Proceedings (2007).
pub fn risk_targeted_level(
    curve: &HazardCurve,
    target_per_year: f64,
    probability: f64,
    dispersion: f64,
) -> Result<RiskTargetedLevel, RiskError> {
    if !(probability > 0.0 && probability < 1.0) {
        return Err(RiskError::Probability { index: 0, probability });
    }
    let (first, last) = (curve.first(), curve.last());
    check_target(target_per_year)?;
    if target_per_year >= first.maf {
        return Err(RiskError::AboveHazard { target: target_per_year, most: first.maf });
    }
    let of = |ln_median: f64| LognormalFragility::new(ln_median.exp(), dispersion);
    let mut low = first.im.ln() - BEYOND * dispersion;
    let mut high = last.im.ln() + BEYOND * dispersion;
    // the risk falls with the median: halved until no number is left between
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let exceeds = lognormal_risk(curve, &of(middle)?).per_year > target_per_year;
        if exceeds { low = middle } else { high = middle }
    }
    let fragility = of(high)?;
    let level = fragility.median() * (normal_quantile(probability) * dispersion).exp();
    Ok(RiskTargetedLevel { level, fragility, risk: lognormal_risk(curve, &fragility) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_a_closed_form() {
        // risk = k₀ θ⁻ᵏ exp(k²β²/2) for λ = k₀ x⁻ᵏ on both sides far beyond the fragility
        let (k0, k, beta, target) = (2e-3, 2.5, 0.4, 1e-4);
        let power = |x: f64| k0 * x.powf(-k);
        let curve = HazardCurve::new("PGV", "cm/s", "", vec![1e-6, 1e6], vec![power(1e-6), power(1e6)]).unwrap();
        let found = risk_targeted_level(&curve, target, 0.5, beta).unwrap();
        let median = (k0 * (0.5_f64 * k * k * beta * beta).exp() / target).powf(1.0 / k);
        assert!((found.level / median - 1.0).abs() < 1e-12, "{} {median}", found.level);
        assert!((found.risk.per_year / target - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_invalid_target_is_refused() {
        let curve = HazardCurve::new("PGV", "cm/s", "", vec![1.0, 10.0], vec![0.1, 1e-3]).unwrap();
        let found = |target, probability, beta| risk_targeted_level(&curve, target, probability, beta).unwrap_err();
        assert_eq!(found(0.1, 0.1, 0.6), RiskError::AboveHazard { target: 0.1, most: 0.1 });
        assert!(matches!(found(0.0, 0.1, 0.6), RiskError::Target { .. }));
        assert!(matches!(found(0.01, 1.0, 0.6), RiskError::Probability { .. }));
        assert!(matches!(found(0.01, 0.1, -0.6), RiskError::Fragility(_)));
    }
}
