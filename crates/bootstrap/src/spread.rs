//! Demands that spread about those at hand, for upper limits.

use uplift_risk::PooledDemand;

use crate::walk::Point;

/// √3: where the outer points of a normal variable lie by the quadrature of Gauss and Hermite with three points.
const OUTER: f64 = 1.732_050_807_568_877_2;

/// Steps of 1 in which the factor to the outer points is rounded.
const STEPS: f64 = (1_u64 << 30) as f64;

/// The points at which demands count for upper limits, where `equivalent_units` count alike.
///
/// A set holds no demand between those of its records: where a few of all records carry a rate, a set without one of
/// these shows nothing of it. So for an upper limit each demand is a lognormal distribution about itself (the smoothed
/// bootstrap) with the deviation h = s/∛(2n), of n units that count alike and demands whose logarithms deviate by s at
/// a level: half of ∛(4/n) s, by which the distribution function of a normal variable is known best. Three points stand
/// for it: 2/3 of a demand stays, 1/6 is larger and 1/6 smaller by the factor exp(√3 h).
///
/// # Source
/// B. Efron, Ann. Stat. 7 (1979), 1–26; A. Bowman, P. Hall, T. Prvan, Biometrika 85 (1998), 799–808.
pub(crate) fn spread(demand: &PooledDemand, equivalent_units: f64) -> [Point; 3] {
    let factor = (OUTER * demand.ln_deviation() / (2.0 * equivalent_units).cbrt()).exp();
    // logarithm and exponential of another machine may differ in the last bit
    let factor = (factor * STEPS).round() / STEPS;
    let outer = |factor: f64| Point { factor, share: 1.0 / 6.0 };
    // in this order the shares add up to 1 to the last bit
    [outer(factor), outer(factor.recip()), Point { factor: 1.0, share: 2.0 / 3.0 }]
}

#[cfg(test)]
mod tests {
    use uplift_fragility::Stripes;

    use super::*;

    // Demands 1, e at one level: s = 1/2, of 4 units h = s/2.
    #[test]
    fn two_thirds_of_a_demand_stay_and_the_rest_is_a_factor_away() {
        let stripes = |edp_m: &[f64]| PooledDemand::new(&Stripes::new(&[1.0], edp_m).unwrap()).unwrap();
        let [larger, smaller, same] = spread(&stripes(&[1.0, std::f64::consts::E]), 4.0);
        let expected = (3.0_f64.sqrt() / 4.0).exp();
        assert!((larger.factor - expected).abs() < 1e-9 && (smaller.factor * larger.factor - 1.0).abs() < 1e-15);
        assert_eq!((larger.factor * STEPS).fract(), 0.0);
        assert_eq!((same.factor, larger.share, same.share, smaller.share), (1.0, 1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0));
        // what does not scatter does not spread
        assert!(spread(&stripes(&[0.2; 4]), 4.0).iter().all(|point| point.factor == 1.0));
    }
}
