//! Sums over the runs of largest demand, without adding these one by one.
//!
//! A stronger motion seldom moves a structure less. So the runs that exceed a displacement are, of each record, those
//! from some level on, but for few: stretches of neighbouring levels. With running sums over the levels of each record
//! a stretch is a difference, and thousands of runs are one or two hundred differences. Weights are whole numbers, so
//! that sums and differences are exact.

use crate::demand::Run;

/// Runs between two places at which stretches are noted.
const STRIDE: usize = 64;

/// Runs that are added before the limit is looked at.
const BLOCK: usize = 16;

/// Weights side by side, for the processor to add at once.
pub(crate) const LANES: usize = 8;

/// The stretches of the first runs of a pool, at every [`STRIDE`]-th run: places in the [`LaneWeights`].
#[derive(Debug, Clone)]
pub(crate) struct Stretches {
    /// Places whose sums are added, then those whose sums are taken away; of each noted run in turn.
    places: Vec<u32>,
    /// Where in `places` the former begin, and where the latter do, `[noted run]`; then the end.
    parts: Vec<[usize; 2]>,
    /// Places of a record.
    row: usize,
}

/// Weights of the runs of as many replicates as there are lanes.
///
/// Their places are those of `[record, level]`, with one level more than there are, of no weight.
#[derive(Debug, Clone)]
pub(crate) struct LaneWeights {
    own: Vec<[u64; LANES]>,
    /// Sums of each level and all above, `[record, level]`.
    running: Vec<[u64; LANES]>,
    row: usize,
}

impl LaneWeights {
    /// None yet.
    pub(crate) fn new(record_count: usize, level_count: usize) -> Self {
        let row = level_count + 1;
        let none = vec![[0; LANES]; record_count * row];
        Self { own: none.clone(), running: none, row }
    }

    /// Takes the weight of each record at each level.
    pub(crate) fn fill(&mut self, weights: impl Fn(usize, usize) -> [u64; LANES]) {
        let rows = self.own.chunks_exact_mut(self.row).zip(self.running.chunks_exact_mut(self.row));
        for (record, (own, running)) in rows.enumerate() {
            let mut sums = [0; LANES];
            for level in (0..self.row - 1).rev() {
                own[level] = weights(record, level);
                add(&mut sums, &own[level]);
                running[level] = sums;
            }
        }
    }
}

fn add(sums: &mut [u64; LANES], terms: &[u64; LANES]) {
    for (sum, term) in sums.iter_mut().zip(terms) {
        *sum += term;
    }
}

impl Stretches {
    /// Of all `runs`, by falling demand.
    pub(crate) fn new(runs: &[Run], record_count: usize, level_count: usize) -> Self {
        let row = level_count + 1;
        // the levels at which a stretch begins and those at which none goes on, in turn, rising, `[record]`
        let mut bounds = vec![Vec::<u16>::new(); record_count];
        let (mut places, mut parts) = (Vec::new(), Vec::new());
        for position in 0..=runs.len() {
            if position % STRIDE == 0 {
                let begin = places.len();
                places.extend(places_of(&bounds, 0, row));
                parts.push([begin, places.len()]);
                places.extend(places_of(&bounds, 1, row));
            }
            let Some(run) = runs.get(position) else { break };
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
        Self { places, parts, row }
    }

    /// Positions of the first of the `runs` whose weight lifts the sum of those up to it above `limit`, `[lane]`; the
    /// number of runs where none does.
    ///
    /// - `lanes`: how many of them are asked for.
    /// - `near`: where the first of the answers may be, or a little before: no more than a hint.
    pub(crate) fn crossings(
        &self,
        runs: &[Run],
        weights: &LaneWeights,
        (limit, lanes): (u64, usize),
        near: usize,
    ) -> [usize; LANES] {
        let mut noted = near.min(runs.len()) / STRIDE;
        let mut sums = self.sums(noted, weights);
        let mut leap = 1;
        // before the first run nothing is above
        while sums[..lanes].iter().any(|&sum| sum > limit) {
            noted = noted.saturating_sub(leap);
            leap *= 4;
            sums = self.sums(noted, weights);
        }
        let weights_of = |run: &Run| &weights.own[usize::from(run.record) * self.row + usize::from(run.level)];
        let mut found = [runs.len(); LANES];
        let mut is_open = [false; LANES];
        is_open[..lanes].fill(true);
        let mut start = noted * STRIDE;
        while is_open.contains(&true) && start < runs.len() {
            let block = &runs[start..runs.len().min(start + BLOCK)];
            let mut after = sums;
            for run in block {
                add(&mut after, weights_of(run));
            }
            for lane in 0..lanes {
                if after[lane] > limit && is_open[lane] {
                    let mut sum = sums[lane];
                    let is_within = |run: &&Run| {
                        sum += weights_of(run)[lane];
                        sum <= limit
                    };
                    found[lane] = start + block.iter().take_while(is_within).count();
                    is_open[lane] = false;
                }
            }
            sums = after;
            start += block.len();
        }
        found
    }

    /// Sums of the weights of all runs before a noted one.
    fn sums(&self, noted: usize, weights: &LaneWeights) -> [u64; LANES] {
        let ([begin, middle], [end, _]) = (self.parts[noted], self.parts[noted + 1]);
        let of = |places: &[u32]| {
            let mut sums = [0; LANES];
            for &place in places {
                add(&mut sums, &weights.running[place as usize]);
            }
            sums
        };
        let (added, taken) = (of(&self.places[begin..middle]), of(&self.places[middle..end]));
        std::array::from_fn(|lane| added[lane] - taken[lane])
    }
}

/// Places of every second bound from the `first` on, but for those behind the last level, whose sum is 0.
fn places_of(bounds: &[Vec<u16>], first: usize, row: usize) -> impl Iterator<Item = u32> {
    let all = bounds.iter().enumerate().flat_map(move |(record, bounds)| {
        bounds.iter().skip(first).step_by(2).map(move |&level| (record, usize::from(level)))
    });
    // at most 65 535 records and levels
    let place = move |(record, level): (usize, usize)| u32::try_from(record * row + level).unwrap_or(u32::MAX);
    all.filter(move |(_, level)| level + 1 < row).map(place)
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
            let found = stretches.crossings(runs, &of_lanes, (limit, lanes), near);
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
