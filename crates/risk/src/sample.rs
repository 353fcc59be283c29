//! Which records count, and how often.

use uplift_instructions::LANES;

use crate::RiskError;
use crate::fixed_point::MAX_SAMPLE_SIZE;

/// Numbers side by side where the processor reads them at once.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lanes(pub(crate) [f64; LANES]);

impl Lanes {
    /// `numbers` in whole lanes, with zeros after them.
    pub(crate) fn from_numbers(numbers: &[f64]) -> impl Iterator<Item = Self> {
        numbers.chunks(LANES).map(|chunk| {
            let mut lanes = [0.0; LANES];
            lanes[..chunk.len()].copy_from_slice(chunk);
            Self(lanes)
        })
    }
}

/// A sample of the records, drawn with replacement: how often each record was drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordSample {
    multiplicities: Vec<u32>,
    size: u32,
    /// The multiplicities in double precision.
    lanes: Vec<Lanes>,
}

impl RecordSample {
    /// From the multiplicity of each record, `[record]`; their sum is the sample size.
    ///
    /// # Errors
    /// A sample of no draws, or of more than 2²⁴.
    pub fn new(multiplicities: Vec<u32>) -> Result<Self, RiskError> {
        let total: u64 = multiplicities.iter().map(|&count| u64::from(count)).sum();
        match u32::try_from(total) {
            Ok(size) if (1..=MAX_SAMPLE_SIZE).contains(&total) => {
                let counts: Vec<f64> = multiplicities.iter().map(|&count| f64::from(count)).collect();
                Ok(Self { multiplicities, size, lanes: Lanes::from_numbers(&counts).collect() })
            }
            _ => Err(RiskError::SampleSize { size: total }),
        }
    }

    /// How often each record was drawn, `[record]`.
    pub fn multiplicities(&self) -> &[u32] {
        &self.multiplicities
    }

    /// The shares of the sample's records where one counts by `shares` at each level, `[level, record]`: as often as it
    /// was drawn, so that those of a level add up to 1 again.
    ///
    /// # Errors
    /// A level none of whose records was drawn.
    pub(crate) fn weigh(&self, shares: &[f64]) -> Result<Vec<f64>, RiskError> {
        let mut weighed = Vec::with_capacity(shares.len());
        for (level, row) in shares.chunks_exact(self.multiplicities.len()).enumerate() {
            let drawn = row.iter().zip(&self.multiplicities).map(|(share, &count)| share * f64::from(count));
            let sum: f64 = drawn.clone().sum();
            if sum <= 0.0 {
                return Err(RiskError::EmptyLevel { level });
            }
            weighed.extend(drawn.map(|share| share / sum));
        }
        Ok(weighed)
    }

    pub(crate) fn lanes(&self) -> &[Lanes] {
        &self.lanes
    }

    /// Number of draws n.
    pub fn size(&self) -> u32 {
        self.size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_the_draws_and_refuses_none_or_too_many() {
        assert_eq!(RecordSample::new(vec![2, 0, 1]).unwrap().size(), 3);
        assert_eq!(RecordSample::new(vec![0, 0]).unwrap_err(), RiskError::SampleSize { size: 0 });
        assert_eq!(RecordSample::new(vec![1 << 24, 1]).unwrap_err(), RiskError::SampleSize { size: (1 << 24) + 1 });
        assert!(RecordSample::new(vec![u32::MAX; 3]).is_err());
    }
}
