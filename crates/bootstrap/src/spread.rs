//! Demands that spread about those at hand, for upper limits.

use std::sync::Arc;

// those of the standard library differ in the last bit from machine to machine
use libm::{cbrt, exp};
use uplift_risk::PooledDemand;

use crate::walk::{Point, Walk};

/// √3: where the outer points of a normal variable lie by the quadrature of Gauss and Hermite with three points.
const OUTER: f64 = 1.732_050_807_568_877_2;

/// Demands that spread, for upper limits.
///
/// A set holds no demand between those of its records: where a few of all records carry a rate, a set without one of
/// these shows nothing of it. So for an upper limit each demand is a lognormal distribution with the deviation
/// h = s/∛n, of n units that count alike and demands whose logarithms deviate by s at their levels, over all levels and
/// unweighted (the smoothed bootstrap). For all of them to scatter no more than they do, its median lies nearer to the
/// mean of its level: √(1 − h²/s²) of the distance is kept (the shrunk smoothed bootstrap). Three points stand for the
/// distribution: 2/3 of a demand lies at the median, 1/6 is larger and 1/6 smaller by the factor exp(√3 h).
///
/// # Source
/// B. Efron, Ann. Stat. 7 (1979), 1–26; B. W. Silverman, G. A. Young, Biometrika 74 (1987), 469–479.
#[derive(Debug)]
pub(crate) struct Spread {
    /// The medians.
    demand: Arc<PooledDemand>,
    points: [Point; 3],
}

impl Spread {
    /// Of demands where `equivalent_units` count alike.
    pub(crate) fn new(demand: &PooledDemand, equivalent_units: f64) -> Self {
        let root = cbrt(equivalent_units).max(1.0);
        let factor = exp(OUTER * demand.ln_deviation() / root);
        let outer = |factor: f64| Point { factor, share: 1.0 / 6.0 };
        Self {
            demand: demand.drawn_together((1.0 - 1.0 / (root * root)).sqrt()),
            // in this order the shares add up to 1 to the last bit
            points: [outer(factor), outer(factor.recip()), Point { factor: 1.0, share: 2.0 / 3.0 }],
        }
    }

    /// A walk through them, from the displacement `from_m` on, m.
    pub(crate) fn walk(&self, from_m: f64) -> Walk<'_, 3> {
        Walk::new(&self.demand, self.points, from_m)
    }
}

#[cfg(test)]
mod tests {
    use uplift_fragility::Stripes;

    use super::*;

    // Demands 1, e² at one level: s = 1, of 8 units h = 1/2, and the medians e^(1 ± √3/2).
    #[test]
    fn two_thirds_of_a_demand_lie_at_its_median_and_the_rest_is_a_factor_away() {
        let stripes = |edp_m: &[f64]| PooledDemand::new(&Stripes::new(&[1.0], edp_m).unwrap()).unwrap();
        let spread = Spread::new(&stripes(&[1.0, 1.0_f64.exp().powi(2)]), 8.0);
        let [larger, smaller, same] = spread.points;
        let half_root = 0.75_f64.sqrt();
        assert!(
            (larger.factor - half_root.exp()).abs() < 1e-15 && (smaller.factor * larger.factor - 1.0).abs() < 1e-15
        );
        assert_eq!((same.factor, larger.share, same.share, smaller.share), (1.0, 1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0));
        let expected = [1.0 + half_root, 1.0 - half_root].map(f64::exp);
        for (found, expected) in spread.demand.edp_m().iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
        // what does not scatter does not spread, and a single unit spreads all about its mean
        assert!(Spread::new(&stripes(&[0.2; 4]), 4.0).points.iter().all(|point| point.factor == 1.0));
        let alone = Spread::new(&stripes(&[1.0, 4.0]), 1.0);
        assert!(alone.demand.edp_m().iter().all(|edp_m| (edp_m - 2.0).abs() < 1e-15));
    }
}
