//! The band of an ordinate, by inverting the interval of the rate at which it is exceeded.

use std::rc::Rc;

use uplift_risk::PooledDemand;

use crate::rates::Rates;
use crate::skewed_mean::SkewedMean;
use crate::spread::Spread;
use crate::walk::{AS_THEY_ARE, Walk};

/// The rate at which a displacement is exceeded, by one hazard curve or several of which one holds.
pub(crate) struct Inversion<'a> {
    demand: &'a PooledDemand,
    /// By each curve.
    rates: Vec<Rates>,
    /// Of the runs beyond the displacement that is looked at, by each curve.
    means: Vec<SkewedMean>,
    /// The demands spread for so many units each.
    spreads: Vec<(f64, Rc<Spread>)>,
}

impl<'a> Inversion<'a> {
    /// By at least one curve.
    pub(crate) fn new(demand: &'a PooledDemand, rates: Vec<Rates>) -> Self {
        Self { demand, means: Vec::with_capacity(rates.len()), rates, spreads: Vec::new() }
    }

    /// Lower and upper limit, m, of bands about an ordinate: from it down to where the rate is first too large, and up
    /// to where it is first too small, and from there that of demands that [spread] too.
    ///
    /// - `sizes`: of each band, how many times as many units a set has whose demands spread as far.
    /// - `place`: where the target lies in what the means leave open for a band: above 1 where they are too large for
    ///   it, below −1 where they are too small.
    pub(crate) fn limits_m(
        &mut self,
        ordinate_m: f64,
        sizes: &[f64],
        place: impl Fn(usize, &[SkewedMean]) -> f64,
    ) -> Vec<[f64; 2]> {
        let mut limits_m = vec![[ordinate_m; 2]; sizes.len()];
        let all = || (0..sizes.len()).collect();
        let mut walk = self.start(Walk::new(self.demand, AS_THEY_ARE, ordinate_m));
        let (mut open, mut lower_m): (Vec<usize>, f64) = (all(), ordinate_m);
        while lower_m > 0.0 && !open.is_empty() {
            // just below this demand
            walk.down(lower_m, |run| self.rates.iter_mut().for_each(|rates| rates.add(run)));
            let means = self.means();
            open.retain(|&band| place(band, means) <= 1.0);
            lower_m = walk.below_m();
            for &band in &open {
                limits_m[band][0] = lower_m;
            }
        }

        let walk = self.start(Walk::new(self.demand, AS_THEY_ARE, ordinate_m));
        self.up(walk, ordinate_m, all(), &mut limits_m, &place);
        for (band, size) in sizes.iter().enumerate() {
            let (upper_m, spread) = (limits_m[band][1], self.spread(size * self.equivalent_units()));
            let walk = self.start(spread.walk(upper_m));
            self.up(walk, upper_m, vec![band], &mut limits_m, &place);
        }
        limits_m
    }

    /// Moves the upper limits of the `open` bands up, from where the walk stands to where the rate is too small.
    fn up<const N: usize>(
        &mut self,
        mut walk: Walk<'_, N>,
        mut upper_m: f64,
        mut open: Vec<usize>,
        limits_m: &mut [[f64; 2]],
        place: impl Fn(usize, &[SkewedMean]) -> f64,
    ) {
        while upper_m < f64::INFINITY {
            let means = self.means();
            open.retain(|&band| place(band, means) >= -1.0);
            if open.is_empty() {
                break;
            }
            upper_m = walk.above_m();
            walk.up(upper_m, |run| self.rates.iter_mut().for_each(|rates| rates.take_away(run)));
            for &band in &open {
                limits_m[band][1] = upper_m;
            }
        }
    }

    /// The limits of the rate at which `threshold_m` is exceeded, 1/yr, that `interval` makes of its means: the upper
    /// one by demands that [spread], if that is larger; 0 where no run exceeds it.
    pub(crate) fn rate_limits(&mut self, threshold_m: f64, interval: impl Fn(&[SkewedMean]) -> [f64; 2]) -> [f64; 2] {
        self.start(Walk::new(self.demand, AS_THEY_ARE, threshold_m));
        let [lower, upper] = interval(self.means());
        if upper == 0.0 {
            return [lower, upper];
        }
        let spread = self.spread(self.equivalent_units());
        self.start(spread.walk(threshold_m));
        [lower, upper.max(interval(self.means())[1])]
    }

    /// The least displacement that is exceeded no more often than a target, 1/yr, by each curve, m.
    pub(crate) fn ordinates_m(&self, target_per_year: f64) -> Vec<f64> {
        let of = |rates: &Rates| {
            let mut per_year = 0.0;
            let exceeds = |&(_, record, level): &(f64, usize, usize)| {
                per_year += rates.run_per_year(record, level);
                per_year > target_per_year
            };
            self.demand.falling_runs().find(exceeds).map_or(0.0, |(edp_m, ..)| edp_m)
        };
        self.rates.iter().map(of).collect()
    }

    /// The demands spread for so many units, which is worked out once.
    fn spread(&mut self, units: f64) -> Rc<Spread> {
        let known = self.spreads.iter().find(|(of, _)| of.total_cmp(&units).is_eq());
        if let Some((_, spread)) = known {
            return Rc::clone(spread);
        }
        let spread = Rc::new(Spread::new(self.demand, units));
        self.spreads.push((units, Rc::clone(&spread)));
        spread
    }

    /// The rates of the runs that lie above the displacement of the `walk`.
    fn start<'w, const N: usize>(&mut self, walk: Walk<'w, N>) -> Walk<'w, N> {
        self.rates.iter_mut().for_each(|rates| rates.start(walk.runs()));
        walk
    }

    /// To how many units that count alike those of the set amount: the same by all curves.
    fn equivalent_units(&self) -> f64 {
        self.rates[0].equivalent_units()
    }

    fn means(&mut self) -> &[SkewedMean] {
        self.means.clear();
        self.means.extend(self.rates.iter().map(Rates::mean));
        &self.means
    }
}
