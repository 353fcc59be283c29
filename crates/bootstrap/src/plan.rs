//! Which records each replicate draws.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use uplift_risk::RecordSample;

use crate::BootstrapError;

/// Fills the seed behind the 8 bytes of the user's number, so that no other use of the generator shares these streams.
const DOMAIN: &[u8; 24] = b"uplift bootstrap records";

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
        let records = u32::try_from(record_count).unwrap_or(u32::MAX);
        let mut samples = Vec::with_capacity(sizes.len() * replicates);
        for &size in sizes {
            for replicate in 0..replicates {
                let mut stream = Stream::new(seed, size, replicate);
                let mut multiplicities = vec![0; record_count];
                for _ in 0..size {
                    multiplicities[stream.below(records) as usize] += 1;
                }
                samples.push(RecordSample::new(multiplicities)?);
            }
        }
        Ok(Self { record_count, replicates, sizes: sizes.to_vec(), samples })
    }

    /// A plan that was stored.
    ///
    /// - `multiplicities`: how often each record was drawn, `[size, replicate, record]`.
    ///
    /// # Errors
    /// As [`ResamplingPlan::draw`]; another number of multiplicities; a replicate that does not draw as many
    /// records as its size says.
    pub fn from_multiplicities(
        record_count: usize,
        sizes: &[u32],
        replicates: usize,
        multiplicities: &[u32],
    ) -> Result<Self, BootstrapError> {
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
                if found != u64::from(size) {
                    return Err(BootstrapError::Draws { size, replicate: index % replicates, found });
                }
                Ok(RecordSample::new(row.to_vec())?)
            })
            .collect::<Result<_, BootstrapError>>()?;
        Ok(Self { record_count, replicates, sizes: sizes.to_vec(), samples })
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
    fn new(seed: u64, size: u32, replicate: usize) -> Self {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        bytes[8..].copy_from_slice(DOMAIN);
        let mut generator = ChaCha8Rng::from_seed(bytes);
        generator.set_stream((u64::from(size) << 32) | replicate as u64);
        Self(generator)
    }

    /// Uniform on `0..bound`, without bias: the high half of a product, where its low half does not fall into the
    /// uneven rest (D. Lemire, ACM Trans. Model. Comput. Simul. 29, 2019).
    fn below(&mut self, bound: u32) -> u32 {
        let uneven = bound.wrapping_neg() % bound;
        loop {
            let product = u64::from(self.0.next_u32()) * u64::from(bound);
            #[expect(clippy::cast_possible_truncation, reason = "the halves of the product")]
            let (high, low) = ((product >> 32) as u32, product as u32);
            if low >= uneven {
                return high;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_replicate_depends_on_nothing_but_its_own_numbers() {
        let plan = ResamplingPlan::draw(7, &[20, 5], 30, 1).unwrap();
        let alone = ResamplingPlan::draw(7, &[5], 3, 1).unwrap();
        assert_eq!(plan.samples()[30..33], alone.samples()[..]);
        assert_ne!(plan.samples()[30..33], ResamplingPlan::draw(7, &[5], 3, 2).unwrap().samples()[..]);
        assert_ne!(plan.samples()[30], plan.samples()[31]);
        let kept = ResamplingPlan::from_multiplicities(7, &[20, 5], 30, &plan.multiplicities()).unwrap();
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
        let kept = |counts: &[u32]| ResamplingPlan::from_multiplicities(2, &[3], 2, counts);
        assert!(kept(&[1, 2, 3, 0]).is_ok());
        assert!(matches!(kept(&[1, 2, 3]), Err(BootstrapError::Shape { found: 3, expected: 4 })));
        assert!(matches!(kept(&[1, 2, 3, 1]), Err(BootstrapError::Draws { size: 3, replicate: 1, found: 4 })));
    }
}
