//! A displacement that goes up or down through the runs of a set.

use uplift_risk::PooledDemand;

/// A point at which a demand counts: at `factor` times itself, `share` of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    pub(crate) factor: f64,
    pub(crate) share: f64,
}

/// Where demands count as they are.
pub(crate) const AS_THEY_ARE: [Point; 1] = [Point { factor: 1.0, share: 1.0 }];

/// A run that is exceeded from here on, or no more: at the record and the level of these positions, by `share` of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Run {
    pub(crate) record: usize,
    pub(crate) level: usize,
    pub(crate) share: f64,
}

/// A displacement between two demands that follow each other, each demand counted at its points.
#[derive(Debug, Clone)]
pub(crate) struct Walk<'a, const N: usize> {
    demand: &'a PooledDemand,
    points: [Point; N],
    /// How many runs lie above the displacement, at each point.
    above: [usize; N],
}

impl<'a, const N: usize> Walk<'a, N> {
    /// At the displacement `from_m`, m.
    pub(crate) fn new(demand: &'a PooledDemand, points: [Point; N], from_m: f64) -> Self {
        let above = points.map(|point| demand.edp_m().partition_point(|edp_m| point.factor * edp_m > from_m));
        Self { demand, points, above }
    }

    /// The runs of which a share lies above the displacement.
    pub(crate) fn runs(&self) -> impl Iterator<Item = Run> {
        let most = self.above.iter().copied().max().unwrap_or(0);
        self.demand.falling_runs().take(most).enumerate().map(|(position, (_, record, level))| {
            let share = |(point, &above): (&Point, &usize)| if position < above { point.share } else { 0.0 };
            Run { record, level, share: self.points.iter().zip(&self.above).map(share).sum() }
        })
    }

    /// The next demand below the displacement, m; 0 where there is none.
    pub(crate) fn below_m(&self) -> f64 {
        let at = |(point, &above): (&Point, &usize)| {
            self.demand.edp_m().get(above).map_or(0.0, |edp_m| point.factor * edp_m)
        };
        self.points.iter().zip(&self.above).map(at).fold(0.0, f64::max)
    }

    /// The next demand above the displacement, m; infinite where there is none.
    pub(crate) fn above_m(&self) -> f64 {
        let at = |(point, &above): (&Point, &usize)| {
            above.checked_sub(1).map_or(f64::INFINITY, |last| point.factor * self.demand.edp_m()[last])
        };
        self.points.iter().zip(&self.above).map(at).fold(f64::INFINITY, f64::min)
    }

    /// Goes below the demand `below_m`, the [next](Self::below_m): `take` gets the runs that are exceeded from here on.
    pub(crate) fn down(&mut self, below_m: f64, mut take: impl FnMut(Run)) {
        for (point, above) in self.points.iter().zip(&mut self.above) {
            while self.demand.edp_m().get(*above).is_some_and(|edp_m| point.factor * edp_m == below_m) {
                let (record, level) = self.demand.run(*above);
                take(Run { record, level, share: point.share });
                *above += 1;
            }
        }
    }

    /// Goes above the demand `above_m`, the [next](Self::above_m): `take` gets the runs that are exceeded no more.
    pub(crate) fn up(&mut self, above_m: f64, mut take: impl FnMut(Run)) {
        for (point, above) in self.points.iter().zip(&mut self.above) {
            while *above > 0 && point.factor * self.demand.edp_m()[*above - 1] == above_m {
                *above -= 1;
                let (record, level) = self.demand.run(*above);
                take(Run { record, level, share: point.share });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use uplift_fragility::Stripes;

    use super::*;

    fn count<const N: usize>(walk: &Walk<'_, N>) -> f64 {
        walk.runs().map(|run| run.share).sum()
    }

    // Demands 1, 2, 2 and one that overturns, each also at 1.5 times itself: 1, 1.5, 2, 3, ∞.
    #[test]
    fn every_demand_is_passed_at_each_of_its_points() {
        let demand = PooledDemand::new(&Stripes::new(&[1.0], &[1.0, 2.0, f64::INFINITY, 2.0]).unwrap()).unwrap();
        let points = [Point { factor: 1.0, share: 0.75 }, Point { factor: 1.5, share: 0.25 }];
        let mut walk = Walk::new(&demand, points, 0.0);

        assert_eq!((count(&walk), walk.below_m()), (4.0, 0.0));
        let mut left = Vec::new();
        for (next_m, rest) in [(1.0, 3.25), (1.5, 3.0), (2.0, 1.5), (3.0, 1.0)] {
            assert_eq!(walk.above_m(), next_m);
            walk.up(next_m, |run| left.push(run));
            assert_eq!((count(&walk), walk.below_m()), (rest, next_m));
        }
        assert_eq!(walk.above_m(), f64::INFINITY);
        let mut back = Vec::new();
        for next_m in [3.0, 2.0, 1.5, 1.0] {
            walk.down(next_m, |run| back.push(run));
        }
        assert_eq!((count(&walk), left.len(), back.len()), (4.0, 6, 6));
        // at a demand it is not exceeded
        assert_eq!((count(&Walk::new(&demand, points, 2.0)), count(&Walk::new(&demand, AS_THEY_ARE, 2.0))), (1.5, 1.0));
    }
}
