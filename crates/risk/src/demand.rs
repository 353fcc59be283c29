//! All demands of one oscillator in one sorted pool.

use std::sync::OnceLock;

use uplift_fragility::Stripes;

use crate::RiskError;
use crate::stretches::Stretches;

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
    ln_deviation: WhenAsked<f64>,
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
        // The order among ties does not matter: rates are added exactly.
        pool.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));

        let at_level = |level: u16| {
            // At most 65 535² runs: a position fits u32.
            (0_u32..).zip(&pool).filter(|(_, (_, run))| run.level == level).map(|(position, _)| position).collect()
        };
        Ok(Self {
            first_level: at_level(0),
            last_level: at_level(level_count - 1),
            edp_m: pool.iter().map(|&(edp, _)| edp).collect(),
            runs: pool.iter().map(|&(_, run)| run).collect(),
            record_count,
            level_count,
            shares: stripes.shares().map(<[f64]>::to_vec),
            stretches: WhenAsked::default(),
            ln_deviation: WhenAsked::default(),
        })
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

    /// How much ln(demand) deviates about its mean at a level, over all levels, of the demands that are finite; 0 where
    /// there are none.
    pub fn ln_deviation(&self) -> f64 {
        let deviation = || {
            // number, mean and sum of squares about it, of each level (Welford)
            let mut levels = vec![(0.0, 0.0, 0.0); self.level_count()];
            for (edp_m, _, level) in self.falling_runs().filter(|run| run.0.is_finite()) {
                let (count, mean, squares) = &mut levels[level];
                let deviation = edp_m.ln() - *mean;
                *count += 1.0;
                *mean += deviation / *count;
                *squares += deviation * (edp_m.ln() - *mean);
            }
            let [count, squares] = levels.iter().fold([0.0_f64, 0.0], |sums, of| [sums[0] + of.0, sums[1] + of.2]);
            (squares / count.max(1.0)).sqrt()
        };
        *self.ln_deviation.0.get_or_init(deviation)
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

    #[test]
    fn too_many_records_are_refused() {
        let levels = [1.0];
        let edp = vec![0.1; 65_536];
        let error = PooledDemand::new(&Stripes::new(&levels, &edp).unwrap()).unwrap_err();
        assert!(matches!(error, RiskError::TooMany { found: 65_536, limit: 65_535, .. }));
    }
}
