//! Sixteen numbers at once, in the processor's own vectors.
//!
//! The compiler makes vectors of most loops over arrays by itself. It does not where a comparison of every number ends
//! in one set of bits, which it takes apart number by number. For such loops the operations are named here. Every set
//! of instructions rounds each operation alike, so the bits are the same.

/// Numbers in a [`Vectors::F64s`].
pub const LANES: usize = 16;

/// What a set of instructions does with sixteen numbers at once.
pub trait Vectors: Copy {
    /// Sixteen numbers.
    type F64s: Copy;

    /// The numbers of an array.
    fn load(self, from: &[f64; LANES]) -> Self::F64s;
    /// The numbers as an array.
    fn store(self, from: Self::F64s) -> [f64; LANES];
    /// The same number in all places.
    fn splat(self, number: f64) -> Self::F64s;
    /// `a + b`.
    fn add(self, a: Self::F64s, b: Self::F64s) -> Self::F64s;
    /// `a - b`.
    fn sub(self, a: Self::F64s, b: Self::F64s) -> Self::F64s;
    /// `a · b`.
    fn mul(self, a: Self::F64s, b: Self::F64s) -> Self::F64s;
    /// The places where `a <= b`, a bit each, the first one lowest; never where one is NaN.
    fn at_most(self, a: Self::F64s, b: Self::F64s) -> u32;
}

/// What every processor of the architecture has: the compiler's vectors.
#[derive(Debug, Clone, Copy)]
pub struct Portable;

impl Vectors for Portable {
    type F64s = [f64; LANES];

    #[inline(always)]
    fn load(self, from: &[f64; LANES]) -> Self::F64s {
        *from
    }

    #[inline(always)]
    fn store(self, from: Self::F64s) -> [f64; LANES] {
        from
    }

    #[inline(always)]
    fn splat(self, number: f64) -> Self::F64s {
        [number; LANES]
    }

    #[inline(always)]
    fn add(self, a: Self::F64s, b: Self::F64s) -> Self::F64s {
        std::array::from_fn(|lane| a[lane] + b[lane])
    }

    #[inline(always)]
    fn sub(self, a: Self::F64s, b: Self::F64s) -> Self::F64s {
        std::array::from_fn(|lane| a[lane] - b[lane])
    }

    #[inline(always)]
    fn mul(self, a: Self::F64s, b: Self::F64s) -> Self::F64s {
        std::array::from_fn(|lane| a[lane] * b[lane])
    }

    #[inline(always)]
    fn at_most(self, a: Self::F64s, b: Self::F64s) -> u32 {
        (0..LANES).fold(0, |bits, lane| bits | u32::from(a[lane] <= b[lane]) << lane)
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) use x86_64::{Avx2, Avx512};

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    #[allow(clippy::wildcard_imports, reason = "the instructions have their set in their names")]
    use std::arch::x86_64::*;

    use super::{LANES, Vectors};

    /// The vectors of a set of instructions; there is a value of `$token` only where the processor has the set.
    macro_rules! vectors {
        (
            $token:ident, $vector:ty, $count:literal of $width:literal, $load:ident, $store:ident, $splat:ident,
            $add:ident, $sub:ident, $mul:ident, |$a:ident, $b:ident| $at_most:expr
        ) => {
            #[derive(Debug, Clone, Copy)]
            pub(crate) struct $token(());

            impl $token {
                /// # Safety
                /// The processor must have the set.
                pub(crate) unsafe fn new() -> Self {
                    Self(())
                }
            }

            // SAFETY of each block: `self` says that the processor has the set; `$count` times `$width` numbers are the
            // array's `LANES`.
            impl Vectors for $token {
                type F64s = [$vector; $count];

                #[inline(always)]
                fn load(self, from: &[f64; LANES]) -> Self::F64s {
                    let mut to = self.splat(0.0);
                    for i in 0..$count {
                        to[i] = unsafe { $load(from.as_ptr().add($width * i)) };
                    }
                    to
                }

                #[inline(always)]
                fn store(self, from: Self::F64s) -> [f64; LANES] {
                    let mut to = [0.0; LANES];
                    for i in 0..$count {
                        unsafe { $store(to.as_mut_ptr().add($width * i), from[i]) };
                    }
                    to
                }

                #[inline(always)]
                fn splat(self, number: f64) -> Self::F64s {
                    [unsafe { $splat(number) }; $count]
                }

                #[inline(always)]
                fn add(self, mut a: Self::F64s, b: Self::F64s) -> Self::F64s {
                    for i in 0..$count {
                        a[i] = unsafe { $add(a[i], b[i]) };
                    }
                    a
                }

                #[inline(always)]
                fn sub(self, mut a: Self::F64s, b: Self::F64s) -> Self::F64s {
                    for i in 0..$count {
                        a[i] = unsafe { $sub(a[i], b[i]) };
                    }
                    a
                }

                #[inline(always)]
                fn mul(self, mut a: Self::F64s, b: Self::F64s) -> Self::F64s {
                    for i in 0..$count {
                        a[i] = unsafe { $mul(a[i], b[i]) };
                    }
                    a
                }

                #[inline(always)]
                fn at_most(self, a: Self::F64s, b: Self::F64s) -> u32 {
                    let mut bits = 0;
                    for i in 0..$count {
                        let ($a, $b) = (a[i], b[i]);
                        bits |= unsafe { $at_most } << ($width * i);
                    }
                    bits
                }
            }
        };
    }

    vectors!(
        Avx2, __m256d, 4 of 4, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_set1_pd, _mm256_add_pd, _mm256_sub_pd,
        _mm256_mul_pd, |a, b| _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LE_OQ>(a, b)).cast_unsigned()
    );
    vectors!(
        Avx512, __m512d, 2 of 8, _mm512_loadu_pd, _mm512_storeu_pd, _mm512_set1_pd, _mm512_add_pd, _mm512_sub_pd,
        _mm512_mul_pd, |a, b| u32::from(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b))
    );
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{InstructionSet, Instructions, Work};

    /// All operations on two arrays.
    struct All([f64; LANES], [f64; LANES]);

    impl Work for All {
        type Output = ([[u64; LANES]; 4], [u32; 2]);

        fn run<V: Vectors>(self, vectors: V) -> Self::Output {
            let (a, b) = (vectors.load(&self.0), vectors.load(&self.1));
            let results = [vectors.add(a, b), vectors.sub(a, b), vectors.mul(a, b), vectors.splat(self.1[3])];
            (results.map(|x| vectors.store(x).map(f64::to_bits)), [vectors.at_most(a, b), vectors.at_most(b, a)])
        }
    }

    #[test]
    fn every_set_computes_number_by_number() {
        let a =
            [0.0, -0.0, 1.0, -1.5, 1e-310, 1e308, f64::INFINITY, f64::NAN, 0.1, 0.2, 0.3, 1e16, -7.0, 2.0, 5e-324, 3.0];
        for turn in 0..LANES {
            let mut b = a;
            b.rotate_left(turn);
            let bits = |operation: fn(f64, f64) -> f64| -> [u64; LANES] {
                std::array::from_fn(|lane| operation(a[lane], b[lane]).to_bits())
            };
            let at_most = |a: [f64; LANES], b: [f64; LANES]| -> u32 {
                (0..LANES).filter(|&lane| a[lane] <= b[lane]).map(|lane| 1 << lane).sum()
            };
            for set in InstructionSet::available() {
                let (results, places) = Instructions::from_set(set).unwrap().run(All(a, b));
                let is_nan = |bits: u64| f64::from_bits(bits).is_nan();
                let expected = [bits(|a, b| a + b), bits(|a, b| a - b), bits(|a, b| a * b), [b[3].to_bits(); LANES]];
                for (result, expected) in results.iter().flatten().zip(expected.iter().flatten()) {
                    assert!(result == expected || (is_nan(*result) && is_nan(*expected)), "{set} {turn}");
                }
                assert_eq!(places, [at_most(a, b), at_most(b, a)], "{set} {turn}");
            }
        }
    }
}
