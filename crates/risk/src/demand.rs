//! All demands of one oscillator in one sorted pool.

use std::sync::{Arc, OnceLock};

// those of the standard library differ in the last bit from machine to machine
use libm::{exp, log};
use uplift_fragility::Stripes;

use crate::RiskError;
use crate::stretches::Stretches;

/// A demand below this share of the largest finite one at its level is as good as none: what hardly lifts a frame lies
/// orders of magnitude below all else.
const NEGLIGIBLE: f64 = 1e-4;

/// One run: which record at which level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) record: u16,
    pub(crate) level: u16,
}

/// All runs of one oscillator, sorted once by falling demand; shared by all sites, probabilities and resamples.
///
/// Runs without displacement are left out: they exceed no threshold; and so are records at levels that they do not
/// [belong to](Stripes::with_shares).
#[derive(Debug, Clone, PartialEq)]
pub struct PooledDemand {
    /// Demands, m, falling; all above 0, overturned ones (+∞) first.
    edp_m: Vec<f64>,
    /// The run behind each demand.
    runs: Vec<Run>,
    /// Positions of the runs at the first and at the last level, rising: what the tails act on.
    first_level: Vec<u32>,
    last_level: Vec<u32>,
    record_count: u16,
    level_count: u16,
    /// `[level, record]`; none where all records count alike.
    shares: Option<Vec<f64>>,
    stretches: WhenAsked<Stretches>,
    scatter: WhenAsked<Scatter>,
    /// Those [drawn together](PooledDemand::drawn_together) first, with the share kept: the same for all sites.
    drawn: WhenAsked<(f64, Arc<PooledDemand>)>,
}

/// How the logarithms of demands scatter that are finite and not [`NEGLIGIBLE`].
#[derive(Debug, Clone)]
struct Scatter {
    /// The smallest demand at each level that is not, m.
    least_m: Vec<f64>,
    /// Their mean at each level; 0 where there are none.
    means: Vec<f64>,
    /// The root of the mean square about the means of the levels.
    deviation: f64,
}

/// What follows from the runs, made where it is first asked for.
#[derive(Debug, Clone)]
struct WhenAsked<T>(OnceLock<T>);

impl<T> Default for WhenAsked<T> {
    fn default() -> Self {
        Self(OnceLock::new())
    }
}

impl<T> PartialEq for WhenAsked<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Scatter {
    fn counts(&self, edp_m: f64, level: usize) -> bool {
        edp_m.is_finite() && edp_m >= self.least_m[level]
    }
}

impl PooledDemand {
    /// Pools and sorts the demands.
    ///
    /// # Errors
    /// More than 65 535 records or levels, or more than `u32::MAX` runs.
    pub fn new(stripes: &Stripes) -> Result<Self, RiskError> {
        let record_count = index_range("records", stripes.record_count())?;
        let level_count = index_range("levels", stripes.level_count())?;
        let mut pool: Vec<(f64, Run)> = Vec::with_capacity(stripes.record_count() * stripes.level_count());
        for record in 0..record_count {
            let row = stripes.record(usize::from(record));
            let counts = |level: u16| stripes.belongs(usize::from(record), usize::from(level));
            let own = (0..level_count).zip(row).filter(|&(level, &edp)| edp > 0.0 && counts(level));
            pool.extend(own.map(|(level, &edp)| {
                let run = Run { record, level };
                (edp, run)
            }));
        }
        let shares = stripes.shares().map(<[f64]>::to_vec);
        Ok(Self::from_pool(pool, (record_count, level_count), shares))
    }

    /// Sorts the `pool`.
    fn from_pool(mut pool: Vec<(f64, Run)>, (record_count, level_count): (u16, u16), shares: Option<Vec<f64>>) -> Self {
        // The order among ties does not matter: rates are added exactly.
        pool.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        let at_level = |level: u16| {
            // At most 65 535² runs: a position fits u32.
            (0_u32..).zip(&pool).filter(|(_, (_, run))| run.level == level).map(|(position, _)| position).collect()
        };
        Self {
            first_level: at_level(0),
            last_level: at_level(level_count - 1),
            edp_m: pool.iter().map(|&(edp, _)| edp).collect(),
            runs: pool.iter().map(|&(_, run)| run).collect(),
            record_count,
            level_count,
            shares,
            stretches: WhenAsked::default(),
            scatter: WhenAsked::default(),
            drawn: WhenAsked::default(),
        }
    }

    /// The same runs with demands that scatter less: of the distance of ln(demand) from its mean at the level the share
    /// `kept` is left. Overturned and negligible runs stay as they are.
    #[must_use]
    pub fn drawn_together(&self, kept: f64) -> Arc<Self> {
        let (of, drawn) = self.drawn.0.get_or_init(|| (kept, Arc::new(self.with_scatter(kept))));
        if of.total_cmp(&kept).is_eq() { Arc::clone(drawn) } else { Arc::new(self.with_scatter(kept)) }
    }

    fn with_scatter(&self, kept: f64) -> Self {
        let scatter = self.scatter();
        if scatter.deviation == 0.0 {
            return self.clone();
        }
        let drawn = |(&edp_m, &run): (&f64, &Run)| {
            let level = usize::from(run.level);
            let mean = scatter.means[level];
            let edp_m = if scatter.counts(edp_m, level) { exp(mean + kept * (log(edp_m) - mean)) } else { edp_m };
            (edp_m, run)
        };
        let pool = self.edp_m.iter().zip(&self.runs).map(drawn).collect();
        Self::from_pool(pool, (self.record_count, self.level_count), self.shares.clone())
    }

    /// How much each record counts at each level, `[level, record]`; none where all count alike.
    pub fn shares(&self) -> Option<&[f64]> {
        self.shares.as_deref()
    }

    /// To how many records that count alike those at `level` amount, 1/Σp².
    ///
    /// # Panics
    /// If `level` is out of range, which is a bug of the caller.
    pub fn effective_records(&self, level: usize) -> f64 {
        let records = self.record_count();
        self.shares.as_ref().map_or(records as f64, |shares| {
            let of_level = &shares[level * records..(level + 1) * records];
            1.0 / of_level.iter().map(|share| share * share).sum::<f64>()
        })
    }

    /// Number of records.
    pub fn record_count(&self) -> usize {
        usize::from(self.record_count)
    }

    /// Number of stripe levels.
    pub fn level_count(&self) -> usize {
        usize::from(self.level_count)
    }

    /// All demands above zero, m, falling; overturned runs (+∞) come first.
    pub fn edp_m(&self) -> &[f64] {
        &self.edp_m
    }

    /// Every run with a demand above zero, by falling demand: demand, m, record and level by their positions.
    pub fn falling_runs(&self) -> impl Iterator<Item = (f64, usize, usize)> {
        let runs = self.edp_m.iter().zip(&self.runs);
        runs.map(|(&edp_m, run)| (edp_m, usize::from(run.record), usize::from(run.level)))
    }

    /// Record and level, by their positions, of the run at `position` among the falling ones.
    ///
    /// # Panics
    /// If there are not so many, which is a bug of the caller.
    pub fn run(&self, position: usize) -> (usize, usize) {
        let run = self.runs[position];
        (usize::from(run.record), usize::from(run.level))
    }

    /// How much ln(demand) deviates about its mean at a level, over all levels, of the demands that are finite and not
    /// negligible: no less than 1/10,000 of the largest finite one at their level. 0 where there are none.
    pub fn ln_deviation(&self) -> f64 {
        self.scatter().deviation
    }

    fn scatter(&self) -> &Scatter {
        let of_all = || {
            let mut least_m = vec![f64::INFINITY; self.level_count()];
            for (edp_m, _, level) in self.falling_runs().filter(|run| run.0.is_finite()) {
                // the first is the largest
                if least_m[level].is_infinite() {
                    least_m[level] = NEGLIGIBLE * edp_m;
                }
            }
            let mut scatter = Scatter { least_m, means: vec![0.0; self.level_count()], deviation: 0.0 };
            // number, mean and sum of squares about it, of each level (Welford)
            let mut levels = vec![(0.0, 0.0, 0.0); self.level_count()];
            for (edp_m, _, level) in self.falling_runs().filter(|(edp_m, _, level)| scatter.counts(*edp_m, *level)) {
                let (count, mean, squares) = &mut levels[level];
                let ln = log(edp_m);
                let deviation = ln - *mean;
                *count += 1.0;
                *mean += deviation / *count;
                *squares += deviation * (ln - *mean);
            }
            let [count, squares] = levels.iter().fold([0.0_f64, 0.0], |sums, of| [sums[0] + of.0, sums[1] + of.2]);
            scatter.means = levels.iter().map(|(_, mean, _)| *mean).collect();
            scatter.deviation = (squares / count.max(1.0)).sqrt();
            scatter
        };
        self.scatter.0.get_or_init(of_all)
    }

    /// The runs in the order of [`PooledDemand::edp_m`].
    pub(crate) fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The runs as stretches of levels.
    pub(crate) fn stretches(&self) -> &Stretches {
        let make = || Stretches::new(&self.runs, self.record_count(), self.level_count());
        self.stretches.0.get_or_init(make)
    }

    /// Number of runs with a demand above `threshold_m`: they are the first ones.
    pub(crate) fn exceeding(&self, threshold_m: f64) -> usize {
        self.edp_m.partition_point(|&edp| edp > threshold_m)
    }

    /// Records of the first `count` runs that are at the first level.
    pub(crate) fn records_at_first_level(&self, count: usize) -> impl Iterator<Item = u16> {
        self.records_at(&self.first_level, count)
    }

    /// Records of the first `count` runs that are at the last level.
    pub(crate) fn records_at_last_level(&self, count: usize) -> impl Iterator<Item = u16> {
        self.records_at(&self.last_level, count)
    }

    fn records_at(&self, positions: &[u32], count: usize) -> impl Iterator<Item = u16> {
        positions
            .iter()
            .map(|&position| position as usize)
            .take_while(move |&position| position < count)
            .map(|position| self.runs[position].record)
    }
}

/// Fits a number of records or levels into an index.
fn index_range(what: &'static str, found: usize) -> Result<u16, RiskError> {
    u16::try_from(found).map_err(|_| RiskError::TooMany { what, found, limit: usize::from(u16::MAX) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorts_by_falling_demand_and_leaves_out_zeros() {
        let inf = f64::INFINITY;
        let levels = [1.0, 2.0, 3.0];
        let edp = [0.0, 0.2, inf, 0.1, 0.0, 0.3];
        let pool = PooledDemand::new(&Stripes::new(&levels, &edp).unwrap()).unwrap();
        assert_eq!(pool.edp_m(), [inf, 0.3, 0.2, 0.1]);
        let runs: Vec<_> = pool.falling_runs().collect();
        assert_eq!(runs, [(inf, 0, 2), (0.3, 1, 2), (0.2, 0, 1), (0.1, 1, 0)]);
        assert_eq!((pool.exceeding(0.2), pool.exceeding(0.0), pool.exceeding(9.0)), (2, 4, 1));
        assert_eq!(pool.records_at_last_level(4).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(pool.records_at_first_level(3).count(), 0);
        assert_eq!(pool.records_at_first_level(4).collect::<Vec<_>>(), [1]);
    }

    // ln 2 and ln 8 at one level, ln 4 twice at another: √(2 (ln 2)²/4)
    #[test]
    fn demands_deviate_about_the_mean_of_their_level() {
        let levels = [1.0, 2.0, 3.0];
        let edp = [2.0, 4.0, 0.0, 8.0, 4.0, f64::INFINITY];
        let demand = PooledDemand::new(&Stripes::new(&levels, &edp).unwrap()).unwrap();
        let expected = std::f64::consts::LN_2 * 0.5_f64.sqrt();
        assert!((demand.ln_deviation() - expected).abs() < 1e-15, "{}", demand.ln_deviation());
        let alone = PooledDemand::new(&Stripes::new(&levels[..1], &[0.3]).unwrap()).unwrap();
        assert_eq!(alone.ln_deviation(), 0.0);
    }

    // The same with half of the distance kept: ln 2 and ln 8 lie about ln 4, as do 4 and 4.
    #[test]
    fn demands_are_drawn_together_at_their_level() {
        let levels = [1.0, 2.0, 3.0];
        let edp = [2.0, 4.0, 0.0, 8.0, 4.0, f64::INFINITY];
        let demand = PooledDemand::new(&Stripes::new(&levels, &edp).unwrap()).unwrap();
        let drawn = demand.drawn_together(0.5);
        assert!((drawn.ln_deviation() - 0.5 * demand.ln_deviation()).abs() < 1e-15);
        let root = std::f64::consts::SQRT_2;
        for (found, expected) in drawn.falling_runs().zip([(f64::INFINITY, 1, 2), (4.0 * root, 1, 0), (4.0, 0, 1)]) {
            assert!(found.0 == expected.0 || (found.0 - expected.0).abs() < 1e-14, "{found:?}");
            assert!(expected.0 == 4.0 || (found.1, found.2) == (expected.1, expected.2), "{found:?}");
        }
        // 1e-5 beside 2 and 8 is negligible
        let edp = [2.0, 8.0, 1e-5];
        let demand = PooledDemand::new(&Stripes::new(&levels[..1], &edp).unwrap()).unwrap();
        assert!((demand.ln_deviation() - std::f64::consts::LN_2).abs() < 1e-15);
        assert_eq!(demand.drawn_together(0.5).edp_m()[2], 1e-5);
        // what does not scatter stays to the bit
        let alike = PooledDemand::new(&Stripes::new(&levels[..1], &[0.3; 3]).unwrap()).unwrap();
        assert_eq!(alike.drawn_together(0.1).edp_m(), alike.edp_m());
        // another share is worked out anew
        let anew = PooledDemand::new(&Stripes::new(&levels[..1], &edp).unwrap()).unwrap();
        assert_eq!(demand.drawn_together(0.25).edp_m(), anew.drawn_together(0.25).edp_m());
        assert!(demand.drawn_together(0.25).edp_m()[0] < demand.drawn_together(0.5).edp_m()[0]);
    }

    #[test]
    fn too_many_records_are_refused() {
        let levels = [1.0];
        let edp = vec![0.1; 65_536];
        let error = PooledDemand::new(&Stripes::new(&levels, &edp).unwrap()).unwrap_err();
        assert!(matches!(error, RiskError::TooMany { found: 65_536, limit: 65_535, .. }));
    }
}
