//! Random numbers that are the same on every machine and independent of threads.
//!
//! Every use has streams of its own of the counter-based generator `ChaCha8`: the numbers of a stream depend on its
//! use, on the user's seed and on its number alone. They are integers, given by the algorithm; each crate makes its
//! variates of them.
//!
//! ```
//! use uplift_random::{Rng, below, stream};
//!
//! let mut third = stream(b"uplift example of a page", 1, 3);
//! assert_eq!(third.next_u32(), stream(b"uplift example of a page", 1, 3).next_u32());
//! assert!(below(&mut third, 6) < 6);
//! ```

pub use rand::Rng;
use rand::SeedableRng;
pub use rand::rngs::ChaCha8Rng;

/// Stream `number` of the use `domain` with the user's `seed`. Streams do not overlap.
///
/// The seed of the generator is that of the user, 8 bytes, before the domain: no two uses share a stream.
pub fn stream(domain: &[u8; 24], seed: u64, number: u64) -> ChaCha8Rng {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    bytes[8..].copy_from_slice(domain);
    let mut generator = ChaCha8Rng::from_seed(bytes);
    generator.set_stream(number);
    generator
}

/// Uniform on `0..bound` without bias, for a `bound` above 0: the high half of a product, drawn again where the low
/// half falls into the uneven rest.
///
/// # Source
/// D. Lemire, ACM Transactions on Modeling and Computer Simulation 29 (2019).
pub fn below(generator: &mut impl Rng, bound: u32) -> u32 {
    let uneven = bound.wrapping_neg() % bound;
    loop {
        let product = u64::from(generator.next_u32()) * u64::from(bound);
        #[expect(clippy::cast_possible_truncation, reason = "the halves of the product")]
        let (high, low) = ((product >> 32) as u32, product as u32);
        if low >= uneven {
            return high;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // The first block of ChaCha8 with a key of zeros and no nonce: the words of the algorithm as published
    // (J. Strombergson, draft-strombergson-chacha-test-vectors-01, TC1, 8 rounds, 256 bits of key).
    #[test]
    fn numbers_are_those_of_the_algorithm() {
        let mut generator = stream(&[0; 24], 0, 0);
        let words = [0; 4].map(|_: u32| generator.next_u32());
        let expected =
            [[0x3e, 0x00, 0xef, 0x2f], [0x89, 0x5f, 0x40, 0xd6], [0x7f, 0x5b, 0xb8, 0xe8], [0x1f, 0x09, 0xa5, 0xa1]];
        assert_eq!(words, expected.map(u32::from_le_bytes));
    }

    #[test]
    fn streams_differ_by_use_seed_and_number() {
        let first = |domain: u8, seed, number| stream(&[domain; 24], seed, number).next_u64();
        let own = first(1, 2, 3);
        assert_eq!(own, first(1, 2, 3));
        assert!([first(2, 2, 3), first(1, 3, 3), first(1, 2, 4)].iter().all(|&other| other != own));
    }

    #[test]
    fn every_number_below_a_bound_is_as_frequent() {
        let mut generator = stream(b"uplift random    a bound", 1, 0);
        let mut counts = [0_u32; 6];
        for _ in 0..60_000 {
            counts[below(&mut generator, 6) as usize] += 1;
        }
        // five standard deviations, √(60 000 · 1/6 · 5/6) = 91
        assert!(counts.iter().all(|count| count.abs_diff(10_000) < 457), "{counts:?}");
    }
}
