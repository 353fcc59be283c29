//! Random numbers, one stream for each use.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// A stream that depends on the seed, on what it is for and on its number alone.
pub(crate) struct Stream(ChaCha8Rng);

impl Stream {
    /// `domain` fills the seed behind the 8 bytes of the user's number, so that no other use of the generator shares
    /// the stream.
    pub(crate) fn new(domain: &[u8; 24], seed: u64, number: u64) -> Self {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        bytes[8..].copy_from_slice(domain);
        let mut generator = ChaCha8Rng::from_seed(bytes);
        generator.set_stream(number);
        Self(generator)
    }

    /// 32 random bits.
    pub(crate) fn bits(&mut self) -> u32 {
        self.0.next_u32()
    }

    /// Uniform between 0 and 1, neither of them.
    pub(crate) fn unit(&mut self) -> f64 {
        (f64::from(self.bits()) + 0.5) / TWO_TO_32
    }

    /// Uniform on `0..bound`: the high half of a product, drawn again where the low half falls into the uneven rest
    /// (D. Lemire, ACM Trans. Model. Comput. Simul. 29, 2019).
    #[expect(clippy::cast_possible_truncation, reason = "the halves of the product")]
    pub(crate) fn below(&mut self, bound: u32) -> usize {
        let uneven = bound.wrapping_neg() % bound;
        loop {
            let product = u64::from(self.bits()) * u64::from(bound);
            if product as u32 >= uneven {
                return (product >> 32) as usize;
            }
        }
    }
}

/// 2³².
pub(crate) const TWO_TO_32: f64 = 4_294_967_296.0;
