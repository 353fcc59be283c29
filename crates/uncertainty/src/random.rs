//! Random numbers, one stream for each use.

use uplift_random::{ChaCha8Rng, Rng, below, stream};

/// A stream that depends on the seed, on what it is for and on its number alone.
pub(crate) struct Stream(ChaCha8Rng);

impl Stream {
    pub(crate) fn new(domain: &[u8; 24], seed: u64, number: u64) -> Self {
        Self(stream(domain, seed, number))
    }

    /// 32 random bits.
    pub(crate) fn bits(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// Uniform between 0 and 1, neither of them.
    pub(crate) fn unit(&mut self) -> f64 {
        (f64::from(self.bits()) + 0.5) / TWO_TO_32
    }

    /// Uniform on `0..bound`.
    pub(crate) fn below(&mut self, bound: u32) -> usize {
        below(&mut self.0, bound) as usize
    }
}

/// 2³².
pub(crate) const TWO_TO_32: f64 = 4_294_967_296.0;
