//! What the second component does: the wobbling peak over the larger of the planar ones (Section 6.2).

use serde::Serialize;
use uplift_fragility::quantile;

/// `U` wobbling over the larger `u` in the plane of each component, of all pairs and levels at which the frame rocks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DirectionEffect {
    /// Pairs and levels that are counted: all but those at which nothing uplifts, or both models overturn.
    pub runs: usize,
    /// The ratio at 16, 50 and 84 %: infinite where the wobbling frame alone overturns, 0 where it alone stands.
    pub ratio: [f64; 3],
    /// Pairs and levels at which both models overturn.
    pub both_overturn: usize,
    /// Those at which the wobbling frame alone does.
    pub wobbling_overturns: usize,
    /// Those at which the planar one alone does.
    pub planar_overturns: usize,
}

impl DirectionEffect {
    /// From the wobbling peak and the larger planar one of every pair and level, m.
    pub(super) fn of(directions_m: &[[f64; 2]]) -> Self {
        let mut ratios: Vec<f64> = directions_m
            .iter()
            .filter(|[wobbling, planar]| wobbling.max(*planar) > 0.0 && wobbling.min(*planar).is_finite())
            .map(|[wobbling, planar]| wobbling / planar)
            .collect();
        ratios.sort_by(f64::total_cmp);
        let count = |of: fn(bool, bool) -> bool| {
            directions_m.iter().filter(|[wobbling, planar]| of(wobbling.is_infinite(), planar.is_infinite())).count()
        };
        Self {
            runs: ratios.len(),
            ratio: [0.16, 0.5, 0.84].map(|probability| quantile(&ratios, probability)),
            both_overturn: count(|wobbling, planar| wobbling && planar),
            wobbling_overturns: count(|wobbling, planar| wobbling && !planar),
            planar_overturns: count(|wobbling, planar| !wobbling && planar),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overturns_is_counted_and_never_dropped() {
        let inf = f64::INFINITY;
        let found = DirectionEffect::of(&[[0.0, 0.0], [0.2, 0.1], [inf, 0.3], [inf, inf], [0.4, inf], [0.1, 0.1]]);
        assert_eq!((found.runs, found.both_overturn, found.wobbling_overturns, found.planar_overturns), (4, 1, 1, 1));
        // of 0, 1, 2 and infinite
        assert_eq!(found.ratio[1], 1.5);
        assert_eq!(found.ratio[2], inf);
    }
}
