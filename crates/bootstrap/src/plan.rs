//! Which records each replicate draws.

use uplift_random::{ChaCha8Rng, below, stream};
use uplift_risk::RecordSample;

use crate::unit::{units, units_in_sample};
use crate::{BootstrapError, Unit, left_out, left_out_together};

/// Fills the seed behind the 8 bytes of the user's number, so that no other use of the generator shares these streams.
const RECORDS: &[u8; 24] = b"uplift bootstrap records";
/// The same for draws of earthquakes.
const EVENTS: &[u8; 24] = b"uplift bootstrap  events";

/// The same for draws of pairs.
const PAIRS: &[u8; 24] = b"uplift bootstrap   pairs";

/// The same for samples that are drawn again.
const ANEW: &[u8; 24] = b"uplift bootstrap    anew";

/// How often a sample is drawn again, at most.
const MOST_DRAWS: u32 = 1000;

/// Largest sample size.
const LARGEST_SIZE: u32 = 100_000;

/// The draws of every replicate of every sample size.
///
/// Each replicate has its own stream of the counter-based generator `ChaCha8`, numbered by its size and its number. So
/// it depends on nothing but the seed, the size, its number and the number of records: not on the other sizes, on the
/// number of replicates or on threads.
#[derive(Debug, Clone, PartialEq)]
pub struct ResamplingPlan {
    record_count: usize,
    replicates: usize,
    sizes: Vec<u32>,
    /// `[size, replicate]`.
    samples: Vec<RecordSample>,
    /// What is drawn with all its records, and these of each; none where records are drawn one by one.
    groups: Option<(Unit, Vec<Vec<usize>>)>,
}

impl ResamplingPlan {
    /// Draws with replacement.
    ///
    /// - `record_count`: records to draw from.
    /// - `sizes`: records in a sample, each size once; a size may exceed `record_count`.
    /// - `replicates`: samples of each size (N of Section 4.5).
    ///
    /// # Errors
    /// No records, sizes or replicates; a size of 0, above 100 000, or given twice.
    pub fn draw(record_count: usize, sizes: &[u32], replicates: usize, seed: u64) -> Result<Self, BootstrapError> {
        check(record_count, sizes, replicates)?;
        let records: Vec<Vec<usize>> = (0..record_count).map(|record| vec![record]).collect();
        let samples = draw(&records, record_count, (sizes, replicates), |size, replicate| {
            (Stream::new(RECORDS, seed, size, replicate), size)
        })?;
        Ok(Self { record_count, replicates, sizes: sizes.to_vec(), samples, groups: None })
    }

    /// Draws earthquakes with all their records.
    ///
    /// - `event_of`: the earthquake of each record, `[record]`: any numbers, alike for the records of one.
    /// - `sizes`: records in a sample on average: as many earthquakes are drawn as have so many records on average, at
    ///   least one ([`ResamplingPlan::units_drawn`]).
    /// - `replicates`: samples of each size.
    ///
    /// # Errors
    /// As [`ResamplingPlan::draw`]; a single earthquake, of which no other choice can be drawn.
    pub fn draw_events(
        event_of: &[usize],
        sizes: &[u32],
        replicates: usize,
        seed: u64,
    ) -> Result<Self, BootstrapError> {
        Self::draw_groups((Unit::Event, event_of, EVENTS), BootstrapError::OneEvent, (sizes, replicates), seed)
    }

    /// Draws pairs with all their records, as [`draw_events`](Self::draw_events) draws earthquakes.
    ///
    /// - `pair_of`: the pair of each record, `[record]`: any numbers, alike for the records of one.
    ///
    /// # Errors
    /// As [`ResamplingPlan::draw`]; a single pair, of which no other choice can be drawn.
    pub fn draw_pairs(pair_of: &[usize], sizes: &[u32], replicates: usize, seed: u64) -> Result<Self, BootstrapError> {
        Self::draw_groups((Unit::Pair, pair_of, PAIRS), BootstrapError::OnePair, (sizes, replicates), seed)
    }

    /// Draws groups of records; the error `of_one` where there is but one.
    fn draw_groups(
        (unit, group_of, domain): (Unit, &[usize], &[u8; 24]),
        of_one: BootstrapError,
        (sizes, replicates): (&[u32], usize),
        seed: u64,
    ) -> Result<Self, BootstrapError> {
        let records = group_of.len();
        check(records, sizes, replicates)?;
        let groups = units(group_of);
        if groups.len() < 2 {
            return Err(of_one);
        }
        let samples = draw(&groups, records, (sizes, replicates), |size, replicate| {
            (Stream::new(domain, seed, size, replicate), units_in_sample(size, groups.len(), records))
        })?;
        let groups = Some((unit, groups));
        Ok(Self { record_count: records, replicates, sizes: sizes.to_vec(), samples, groups })
    }

    /// The same with every sample that `is_whole` refuses, given how often it draws each record, drawn again until it
    /// is taken, from a stream of its own; and how many these are. One that is refused 1000 times stays as it is.
    ///
    /// # Errors
    /// None is known: the samples are those of a plan.
    pub fn drawn_anew(mut self, seed: u64, is_whole: impl Fn(&[u32]) -> bool) -> Result<(Self, usize), BootstrapError> {
        let units = self.units();
        let count = u32::try_from(units.len()).unwrap_or(u32::MAX);
        let mut refused = 0;
        for index in 0..self.samples.len() {
            if is_whole(self.samples[index].multiplicities()) {
                continue;
            }
            refused += 1;
            let size = self.sizes[index / self.replicates];
            let mut stream = Stream::new(ANEW, seed, size, index % self.replicates);
            for _ in 0..MOST_DRAWS {
                let drawn = stream.sample(&units, (count, self.units_drawn(size)), self.record_count);
                if is_whole(&drawn) {
                    self.samples[index] = RecordSample::new(drawn)?;
                    break;
                }
            }
        }
        Ok((self, refused))
    }

    /// A plan that was stored.
    ///
    /// - `multiplicities`: how often each record was drawn, `[size, replicate, record]`.
    /// - `group_of`: the earthquake or pair of each record, where these were drawn with all their records.
    ///
    /// # Errors
    /// As [`ResamplingPlan::draw`]; another number of multiplicities; a replicate that does not draw as many
    /// records as its size says, or other records of an earthquake than all.
    pub fn from_multiplicities(
        record_count: usize,
        sizes: &[u32],
        replicates: usize,
        multiplicities: &[u32],
        group_of: Option<(Unit, &[usize])>,
    ) -> Result<Self, BootstrapError> {
        let groups = group_of.map(|(unit, group_of)| (unit, units(group_of)));
        check(record_count, sizes, replicates)?;
        let expected = sizes.len() * replicates * record_count;
        if multiplicities.len() != expected {
            return Err(BootstrapError::Shape { found: multiplicities.len(), expected });
        }
        let samples = multiplicities
            .chunks_exact(record_count)
            .enumerate()
            .map(|(index, row)| {
                let size = sizes[index / replicates];
                let found: u64 = row.iter().map(|&count| u64::from(count)).sum();
                let is_drawn = match &groups {
                    None => found == u64::from(size),
                    Some((_, groups)) => {
                        let is_whole = |group: &Vec<usize>| group.iter().all(|&record| row[record] == row[group[0]]);
                        let drawn: u64 = groups.iter().map(|group| u64::from(row[group[0]])).sum();
                        let expected = units_in_sample(size, groups.len(), record_count);
                        groups.iter().all(is_whole) && drawn == u64::from(expected)
                    }
                };
                if !is_drawn {
                    return Err(BootstrapError::Draws { size, replicate: index % replicates, found });
                }
                Ok(RecordSample::new(row.to_vec())?)
            })
            .collect::<Result<_, BootstrapError>>()?;
        Ok(Self { record_count, replicates, sizes: sizes.to_vec(), samples, groups })
    }

    /// What was drawn.
    pub fn unit(&self) -> Unit {
        self.groups.as_ref().map_or(Unit::Record, |(unit, _)| *unit)
    }

    /// The records of each earthquake or pair, `[group]`; none where records are drawn one by one.
    fn groups(&self) -> Option<&[Vec<usize>]> {
        self.groups.as_ref().map(|(_, groups)| groups.as_slice())
    }

    /// The records of each unit that is drawn, `[unit]`, by their positions: one each, or those of an earthquake or
    /// pair.
    pub fn units(&self) -> Vec<Vec<usize>> {
        let each = || (0..self.record_count).map(|record| vec![record]).collect();
        self.groups().map_or_else(each, <[_]>::to_vec)
    }

    /// How many units there are to draw from: records, pairs or earthquakes.
    pub fn unit_count(&self) -> usize {
        self.groups().map_or(self.record_count, <[_]>::len)
    }

    /// How many units a sample of `size` records has: itself, or as many earthquakes or pairs as have so many records
    /// on average.
    pub fn units_drawn(&self, size: u32) -> u32 {
        match self.groups() {
            None => size,
            Some(groups) => units_in_sample(size, groups.len(), self.record_count),
        }
    }

    /// The records without each of the units in turn, `[unit]`; none where there is but one.
    ///
    /// # Errors
    /// More than 2²⁴ records.
    pub fn left_out(&self) -> Result<Vec<RecordSample>, BootstrapError> {
        let Some(groups) = self.groups() else { return Ok(left_out(self.record_count)?) };
        Ok(left_out_together(self.record_count, groups)?)
    }

    /// Records drawn from.
    pub fn record_count(&self) -> usize {
        self.record_count
    }

    /// Replicates of each size.
    pub fn replicates(&self) -> usize {
        self.replicates
    }

    /// Sample sizes, in the order given.
    pub fn sizes(&self) -> &[u32] {
        &self.sizes
    }

    /// All samples, `[size, replicate]`.
    pub fn samples(&self) -> &[RecordSample] {
        &self.samples
    }

    /// How often each record was drawn, `[size, replicate, record]`: what
    /// [`ResamplingPlan::from_multiplicities`] takes.
    pub fn multiplicities(&self) -> Vec<u32> {
        self.samples.iter().flat_map(|sample| sample.multiplicities().iter().copied()).collect()
    }
}

/// Samples of units, `[size, replicate]`; `stream` says from which numbers, and how many units are drawn.
fn draw(
    units: &[Vec<usize>],
    record_count: usize,
    (sizes, replicates): (&[u32], usize),
    stream: impl Fn(u32, usize) -> (Stream, u32),
) -> Result<Vec<RecordSample>, BootstrapError> {
    let count = u32::try_from(units.len()).unwrap_or(u32::MAX);
    let mut samples = Vec::with_capacity(sizes.len() * replicates);
    for &size in sizes {
        for replicate in 0..replicates {
            let (mut stream, drawn) = stream(size, replicate);
            samples.push(RecordSample::new(stream.sample(units, (count, drawn), record_count))?);
        }
    }
    Ok(samples)
}

fn check(record_count: usize, sizes: &[u32], replicates: usize) -> Result<(), BootstrapError> {
    if record_count == 0 || sizes.is_empty() || replicates == 0 {
        return Err(BootstrapError::Empty { records: record_count, sizes: sizes.len(), replicates });
    }
    for (index, &size) in sizes.iter().enumerate() {
        if size == 0 || size > LARGEST_SIZE || sizes[..index].contains(&size) {
            return Err(BootstrapError::Size { size, limit: LARGEST_SIZE });
        }
    }
    Ok(())
}

/// The random numbers of one replicate.
struct Stream(ChaCha8Rng);

impl Stream {
    fn new(domain: &[u8; 24], seed: u64, size: u32, replicate: usize) -> Self {
        Self(stream(domain, seed, (u64::from(size) << 32) | replicate as u64))
    }

    /// How often each record is drawn with so many of the `count` units.
    fn sample(&mut self, units: &[Vec<usize>], (count, drawn): (u32, u32), record_count: usize) -> Vec<u32> {
        let mut multiplicities = vec![0; record_count];
        for _ in 0..drawn {
            for &record in &units[below(&mut self.0, count) as usize] {
                multiplicities[record] += 1;
            }
        }
        multiplicities
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_replicate_depends_on_nothing_but_its_own_numbers() {
        let plan = ResamplingPlan::draw(7, &[20, 5], 30, 1).unwrap();
        let alone = ResamplingPlan::draw(7, &[5], 3, 1).unwrap();
        assert_eq!(plan.samples()[30..33], alone.samples()[..]);
        assert_ne!(plan.samples()[30..33], ResamplingPlan::draw(7, &[5], 3, 2).unwrap().samples()[..]);
        assert_ne!(plan.samples()[30], plan.samples()[31]);
        let kept = ResamplingPlan::from_multiplicities(7, &[20, 5], 30, &plan.multiplicities(), None).unwrap();
        assert_eq!(kept, plan);
    }

    /// Pinned: whoever changes the draws changes every published band.
    #[test]
    fn the_draws_are_pinned() {
        let plan = ResamplingPlan::draw(5, &[10], 2, 1).unwrap();
        assert_eq!(plan.multiplicities(), [2, 3, 2, 1, 2, 3, 1, 1, 1, 4]);
    }

    #[test]
    fn every_record_is_drawn_alike() {
        // 105 records, 105 · 1000 draws: each is expected 1000 times, with a standard deviation of 31.5
        let plan = ResamplingPlan::draw(105, &[105], 1000, 3).unwrap();
        let mut counts = vec![0; 105];
        for sample in plan.samples() {
            for (count, drawn) in counts.iter_mut().zip(sample.multiplicities()) {
                *count += drawn;
            }
        }
        let chi_squared: f64 = counts.iter().map(|&count| (f64::from(count) - 1000.0).powi(2) / 1000.0).sum();
        // 104 degrees of freedom: 104 ± 14.4
        assert!((50.0..160.0).contains(&chi_squared), "{chi_squared}");
        assert_eq!(counts.iter().sum::<u32>(), 105_000);
    }

    #[test]
    fn refuses_what_is_no_plan() {
        for (records, sizes, replicates) in [(0, &[5][..], 1), (3, &[], 1), (3, &[5], 0)] {
            let error = ResamplingPlan::draw(records, sizes, replicates, 1).unwrap_err();
            assert!(matches!(error, BootstrapError::Empty { .. }), "{error}");
        }
        for sizes in [[0, 1], [4, 4], [1, 100_001]] {
            assert!(matches!(ResamplingPlan::draw(3, &sizes, 2, 1), Err(BootstrapError::Size { .. })));
        }
        let kept = |counts: &[u32]| ResamplingPlan::from_multiplicities(2, &[3], 2, counts, None);
        assert!(kept(&[1, 2, 3, 0]).is_ok());
        assert!(matches!(kept(&[1, 2, 3]), Err(BootstrapError::Shape { found: 3, expected: 4 })));
        assert!(matches!(kept(&[1, 2, 3, 1]), Err(BootstrapError::Draws { size: 3, replicate: 1, found: 4 })));
    }

    #[test]
    fn earthquakes_are_drawn_with_all_their_records() {
        // three earthquakes of 4, 1 and 2 records
        let event_of = [8, 8, 3, 8, 5, 5, 8];
        let plan = ResamplingPlan::draw_events(&event_of, &[7, 2, 14], 400, 1).unwrap();
        assert_eq!((plan.unit(), plan.unit_count()), (Unit::Event, 3));
        // 3/7 of 2 records is one earthquake, 3/7 of 14 six
        assert_eq!([7, 2, 14].map(|size| plan.units_drawn(size)), [3, 1, 6]);
        for (index, sample) in plan.samples().iter().enumerate() {
            let drawn = sample.multiplicities();
            assert!([1, 3, 6].iter().all(|&record| drawn[record] == drawn[0]) && drawn[4] == drawn[5]);
            assert_eq!(drawn[0] + drawn[2] + drawn[4], [3, 1, 6][index / 400]);
        }
        // as often each: 2400 draws of 3, with a standard deviation of 23
        let of_last: u32 = plan.samples()[800..].iter().map(|sample| sample.multiplicities()[2]).sum();
        assert!(of_last.abs_diff(800) < 100, "{of_last}");
        let stored = |counts: &[u32]| {
            ResamplingPlan::from_multiplicities(7, &[7, 2, 14], 400, counts, Some((Unit::Event, &event_of)))
        };
        let mut counts = plan.multiplicities();
        assert_eq!(stored(&counts), Ok(plan.clone()));
        counts[0] += 1;
        assert!(matches!(stored(&counts), Err(BootstrapError::Draws { size: 7, replicate: 0, .. })));
        let without: Vec<Vec<u32>> =
            plan.left_out().unwrap().iter().map(|sample| sample.multiplicities().to_vec()).collect();
        assert_eq!(without, [[0, 0, 1, 0, 1, 1, 0], [1, 1, 0, 1, 1, 1, 1], [1, 1, 1, 1, 0, 0, 1]]);
        assert_eq!(ResamplingPlan::draw_events(&[1, 1], &[2], 5, 1), Err(BootstrapError::OneEvent));
    }

    #[test]
    fn pairs_are_drawn_with_all_their_records_from_a_stream_of_their_own() {
        let pair_of = [0, 0, 0, 1, 1, 1, 2, 2, 2];
        let plan = ResamplingPlan::draw_pairs(&pair_of, &[9, 3], 40, 1).unwrap();
        assert_eq!((plan.unit(), plan.unit_count(), plan.units_drawn(3)), (Unit::Pair, 3, 1));
        for sample in plan.samples() {
            assert!(sample.multiplicities().chunks(3).all(|pair| pair.iter().all(|&times| times == pair[0])));
        }
        let events = ResamplingPlan::draw_events(&pair_of, &[9, 3], 40, 1).unwrap();
        assert_ne!(events.multiplicities(), plan.multiplicities());
        let stored = (Unit::Pair, &pair_of[..]);
        let again = ResamplingPlan::from_multiplicities(9, &[9, 3], 40, &plan.multiplicities(), Some(stored));
        assert_eq!(again, Ok(plan));
        assert_eq!(ResamplingPlan::draw_pairs(&[1, 1], &[2], 5, 1), Err(BootstrapError::OnePair));
    }

    #[test]
    fn earthquakes_of_one_record_are_records_from_another_stream() {
        let events = ResamplingPlan::draw_events(&[0, 1, 2, 3], &[4], 50, 1).unwrap();
        let records = ResamplingPlan::draw(4, &[4], 50, 1).unwrap();
        assert!(events.samples().iter().all(|sample| sample.size() == 4));
        assert_ne!(events.multiplicities(), records.multiplicities());
        assert_eq!(events.left_out().unwrap(), records.left_out().unwrap());
    }
}
