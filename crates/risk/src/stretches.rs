//! Sums over the runs of largest demand, without adding these one by one.
//!
//! A stronger motion seldom moves a structure less. So the runs that exceed a displacement are, of each record, those
//! from some level on, but for few: stretches of neighbouring levels. With running sums over the levels of each record
//! a stretch is a difference, and thousands of runs are one or two hundred differences. Weights are whole numbers, so
//! that sums and differences are exact.

use uplift_instructions::{Instructions, Vectors, Work};

use crate::demand::Run;

/// Runs between two places at which stretches are noted.
const STRIDE: usize = 64;

/// Runs that are added before the limit is looked at.
const BLOCK: usize = 16;

/// A limit that no sum is beyond.
const NO_LIMIT: u64 = u64::MAX >> 1;

/// Weights side by side, for the processor to add at once.
pub(crate) const LANES: usize = 8;

/// The stretches of the first runs of a pool, at every [`STRIDE`]-th run: places in the [`LaneWeights`].
#[derive(Debug, Clone)]
pub(crate) struct Stretches {
    /// Place of each run.
    runs: Vec<u32>,
    /// Places whose sums are added, then those whose sums are taken away; of each noted run in turn.
    places: Vec<u32>,
    /// Where in `places` the former begin, and where the latter do, `[noted run]`; then the end.
    parts: Vec<[usize; 2]>,
}

/// Weights of the runs of as many replicates as there are lanes.
///
/// Their places are those of `[record, level]`, with one level more than there are, of no weight.
#[derive(Debug, Clone)]
pub(crate) struct LaneWeights {
    own: Vec<Lanes>,
    /// Sums of each level and all above, `[record, level]`.
    running: Vec<Lanes>,
    row: usize,
}

/// A weight of each replicate, in one line of the processor's cache.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
struct Lanes([u64; LANES]);

impl Lanes {
    /// Whether a sum is beyond its limit; both are below 2^63.
    #[inline(always)]
    fn any_beyond(&self, limits: &[u64; LANES]) -> bool {
        // the sign of the difference, of all together: comparisons are made one by one
        let differences = limits.iter().zip(&self.0).map(|(limit, sum)| limit.wrapping_sub(*sum));
        differences.fold(0, |all, difference| all | difference) >> 63 == 1
    }

    #[inline(always)]
    fn add(&mut self, other: &Self) {
        for (sum, term) in self.0.iter_mut().zip(&other.0) {
            *sum += term;
        }
    }
}

impl LaneWeights {
    /// None yet.
    pub(crate) fn new(record_count: usize, level_count: usize) -> Self {
        let row = level_count + 1;
        let none = vec![Lanes::default(); record_count * row];
        Self { own: none.clone(), running: none, row }
    }

    /// Takes the weight of each record at each level.
    #[inline(always)]
    pub(crate) fn fill(&mut self, weights: impl Fn(usize, usize) -> [u64; LANES]) {
        let rows = self.own.chunks_exact_mut(self.row).zip(self.running.chunks_exact_mut(self.row));
        for (record, (own, running)) in rows.enumerate() {
            let mut sums = Lanes::default();
            for level in (0..self.row - 1).rev() {
                own[level] = Lanes(weights(record, level));
                sums.add(&own[level]);
                running[level] = sums;
            }
        }
    }
}

impl Stretches {
    /// Of all `runs`, by falling demand.
    pub(crate) fn new(runs: &[Run], record_count: usize, level_count: usize) -> Self {
        let row = level_count + 1;
        // the levels at which a stretch begins and those at which none goes on, in turn, rising, `[record]`
        let mut bounds = vec![Vec::<u16>::new(); record_count];
        let (mut of_runs, mut places, mut parts) = (Vec::with_capacity(runs.len()), Vec::new(), Vec::new());
        for position in 0..=runs.len() {
            if position % STRIDE == 0 {
                let begin = places.len();
                places.extend(places_of(&bounds, 0, row));
                parts.push([begin, places.len()]);
                places.extend(places_of(&bounds, 1, row));
            }
            let Some(run) = runs.get(position) else { break };
            of_runs.push(place_of(usize::from(run.record), usize::from(run.level), row));
            let bounds = &mut bounds[usize::from(run.record)];
            // where there is a bound already a stretch becomes longer, or two become one
            for level in [run.level, run.level + 1] {
                match bounds.binary_search(&level) {
                    Ok(place) => drop(bounds.remove(place)),
                    Err(place) => bounds.insert(place, level),
                }
            }
        }
        parts.push([places.len(); 2]);
        Self { runs: of_runs, places, parts }
    }

    /// Positions of the first of the runs whose weight lifts the sum of those up to it above `limit`, `[lane]`; the
    /// number of runs where none does.
    ///
    /// - `lanes`: how many of them are asked for.
    /// - `near`: where the first of the answers may be, or a little before: no more than a hint.
    pub(crate) fn crossings(&self, weights: &LaneWeights, (limit, lanes): (u64, usize), near: usize) -> [usize; LANES] {
        // all weights together fit 62 bits; a lane that is not asked for passes no limit
        let mut limits = [NO_LIMIT; LANES];
        limits[..lanes].fill(limit.min(NO_LIMIT));
        Instructions::chosen().run(Crossings { stretches: self, weights, limits, near })
    }

    #[inline(always)]
    fn cross(&self, weights: &LaneWeights, mut limits: [u64; LANES], near: usize) -> [usize; LANES] {
        let runs = &self.runs;
        let mut noted = near.min(runs.len()) / STRIDE;
        let mut sums = self.sums(noted, weights);
        let mut leap = 1;
        // before the first run nothing is above
        while sums.any_beyond(&limits) {
            noted = noted.saturating_sub(leap);
            leap *= 4;
            sums = self.sums(noted, weights);
        }
        let mut found = [runs.len(); LANES];
        let mut start = noted * STRIDE;
        for block in runs[start..].chunks(BLOCK) {
            let mut after = sums;
            for &run in block {
                after.add(&weights.own[run as usize]);
            }
            if after.any_beyond(&limits) {
                for (lane, (found, limit)) in found.iter_mut().zip(&mut limits).enumerate() {
                    if after.0[lane] > *limit {
                        let mut sum = sums.0[lane];
                        let is_within = |&&run: &&u32| {
                            sum += weights.own[run as usize].0[lane];
                            sum <= *limit
                        };
                        *found = start + block.iter().take_while(is_within).count();
                        *limit = NO_LIMIT;
                    }
                }
                if limits == [NO_LIMIT; LANES] {
                    break;
                }
            }
            sums = after;
            start += block.len();
        }
        found
    }

    /// Sums of the weights of all runs before a noted one.
    #[inline(always)]
    fn sums(&self, noted: usize, weights: &LaneWeights) -> Lanes {
        let ([begin, middle], [end, _]) = (self.parts[noted], self.parts[noted + 1]);
        let of = |places: &[u32]| {
            let mut sums = Lanes::default();
            for &place in places {
                sums.add(&weights.running[place as usize]);
            }
            sums
        };
        let (added, taken) = (of(&self.places[begin..middle]), of(&self.places[middle..end]));
        Lanes(std::array::from_fn(|lane| added.0[lane] - taken.0[lane]))
    }
}

/// What [`Stretches::crossings`] finds.
struct Crossings<'a> {
    stretches: &'a Stretches,
    weights: &'a LaneWeights,
    limits: [u64; LANES],
    near: usize,
}

impl Work for Crossings<'_> {
    type Output = [usize; LANES];

    #[inline(always)]
    fn run<V: Vectors>(self, _: V) -> Self::Output {
        self.stretches.cross(self.weights, self.limits, self.near)
    }
}

/// Places of every second bound from the `first` on, but for those behind the last level, whose sum is 0.
fn places_of(bounds: &[Vec<u16>], first: usize, row: usize) -> impl Iterator<Item = u32> {
    let all = bounds.iter().enumerate().flat_map(move |(record, bounds)| {
        bounds.iter().skip(first).step_by(2).map(move |&level| (record, usize::from(level)))
    });
    all.filter(move |(_, level)| level + 1 < row).map(move |(record, level)| place_of(record, level, row))
}

/// The place of a record at a level, in rows of one record each.
fn place_of(record: usize, level: usize, row: usize) -> u32 {
    // at most 65 535 records and levels
    u32::try_from(record * row + level).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const RECORDS: usize = 5;
    const LEVELS: usize = 60;

    /// All runs, in an order that rises with the level but for what `disorder` makes of it.
    fn runs(disorder: &[f64], share: f64) -> Vec<Run> {
        let demand = |place: usize| (place % LEVELS) as f64 + share * LEVELS as f64 * disorder[place];
        let mut places: Vec<usize> = (0..RECORDS * LEVELS).collect();
        places.sort_by(|a, b| demand(*b).total_cmp(&demand(*a)));
        let index = |place: usize| u16::try_from(place).unwrap_or(0);
        places.into_iter().map(|place| Run { record: index(place / LEVELS), level: index(place % LEVELS) }).collect()
    }

    proptest! {
        /// Wherever the search begins, it finds what adding the runs one by one finds.
        #[test]
        fn a_crossing_is_that_of_the_plain_sums(
            disorder in prop::collection::vec(0.0..1.0_f64, RECORDS * LEVELS),
            share in prop_oneof![Just(0.0), Just(0.1), Just(1.0)],
            weights in prop::collection::vec(prop_oneof![Just(0), 0..1000_u64], LANES * RECORDS * LEVELS),
            limit in 0..200_000_u64,
            left_out in 0..RECORDS * LEVELS,
            near in 0..400_usize,
            lanes in 1..=LANES,
        ) {
            let all = runs(&disorder, share);
            // demands of zero are no runs
            let runs = &all[..all.len() - left_out];
            let weight = |lane: usize, record: usize, level: usize| {
                weights[(record * LEVELS + level) * LANES + lane] * (1 + lane as u64)
            };
            let mut of_lanes = LaneWeights::new(RECORDS, LEVELS);
            // what was there before does not matter
            of_lanes.fill(|_, _| [7; LANES]);
            of_lanes.fill(|record, level| std::array::from_fn(|lane| weight(lane, record, level)));
            let stretches = Stretches::new(runs, RECORDS, LEVELS);
            let found = stretches.crossings(&of_lanes, (limit, lanes), near);
            for (lane, &found) in found.iter().enumerate().take(lanes) {
                let mut sum = 0;
                let is_within = |run: &&Run| {
                    sum += weight(lane, usize::from(run.record), usize::from(run.level));
                    sum <= limit
                };
                prop_assert_eq!(found, runs.iter().take_while(is_within).count(), "lane {}", lane);
            }
        }
    }

    // A motion that moves a structure less than a weaker one does leaves a gap: two stretches.
    #[test]
    fn few_places_are_looked_at() {
        let ordered = runs(&[0.0; RECORDS * LEVELS], 0.0);
        let stretches = Stretches::new(&ordered, RECORDS, LEVELS);
        // one for each record, and none before the first run
        assert_eq!(stretches.places.len(), (ordered.len() / STRIDE) * RECORDS);
        assert!(stretches.parts.windows(2).all(|two| two[0][1] == two[1][0]));
    }
}
