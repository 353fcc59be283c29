//! Several numbers at once, in the processor's own vectors.
//!
//! The compiler makes vectors of most loops over arrays by itself. It does not where a comparison of every number ends
//! in one set of bits, which it takes apart number by number, nor from long chains of loops. For those the operations
//! are named here. Every set of instructions rounds each operation alike, so the bits are the same.

use std::array::from_fn;

use crate::larger;

/// Numbers in a [`Vectors::F64s`](Numbers::F64s).
pub const LANES: usize = 16;

/// Numbers of the shorter vectors.
pub const FEW: usize = 8;

/// What a set of instructions does with `N` numbers at once.
pub trait Numbers<const N: usize>: Copy {
    /// `N` numbers.
    type F64s: Copy;

    /// The numbers of an array.
    fn load(self, from: &[f64; N]) -> Self::F64s;
    /// The numbers as an array.
    fn store(self, from: Self::F64s) -> [f64; N];
    /// One of the numbers.
    fn number(self, from: &Self::F64s, place: usize) -> f64;
    /// The same number in all places.
    fn splat(self, number: f64) -> Self::F64s;
    /// `a + b`.
    fn add(self, a: Self::F64s, b: Self::F64s) -> Self::F64s;
    /// `a - b`.
    fn sub(self, a: Self::F64s, b: Self::F64s) -> Self::F64s;
    /// `a · b`.
    fn mul(self, a: Self::F64s, b: Self::F64s) -> Self::F64s;
    /// `|a|`.
    fn abs(self, a: Self::F64s) -> Self::F64s;
    /// `a` where `a > b`, else `b`.
    fn larger(self, a: Self::F64s, b: Self::F64s) -> Self::F64s;
    /// `x` where `a <= b`, else `y`.
    fn if_at_most(self, a: Self::F64s, b: Self::F64s, x: Self::F64s, y: Self::F64s) -> Self::F64s;
    /// The places where `a <= b`, a bit each, the first one lowest; never where one is NaN.
    fn at_most(self, a: Self::F64s, b: Self::F64s) -> u32;
}

/// What a set of instructions does with [`LANES`] numbers at once, and with [`FEW`].
pub trait Vectors: Numbers<LANES> {
    /// The same set's shorter vectors.
    type Few: Numbers<FEW>;

    /// The same set's shorter vectors.
    fn few(self) -> Self::Few;
}

/// What every processor of the architecture has: the compiler's vectors.
#[derive(Debug, Clone, Copy)]
pub struct Portable;

impl Vectors for Portable {
    type Few = Self;

    #[inline(always)]
    fn few(self) -> Self {
        self
    }
}

impl<const N: usize> Numbers<N> for Portable {
    type F64s = [f64; N];

    #[inline(always)]
    fn load(self, from: &[f64; N]) -> Self::F64s {
        *from
    }

    #[inline(always)]
    fn store(self, from: Self::F64s) -> [f64; N] {
        from
    }

    #[inline(always)]
    fn number(self, from: &Self::F64s, place: usize) -> f64 {
        from[place]
    }

    #[inline(always)]
    fn splat(self, number: f64) -> Self::F64s {
        [number; N]
    }

    #[inline(always)]
    fn add(self, a: Self::F64s, b: Self::F64s) -> Self::F64s {
        from_fn(|lane| a[lane] + b[lane])
    }

    #[inline(always)]
    fn sub(self, a: Self::F64s, b: Self::F64s) -> Self::F64s {
        from_fn(|lane| a[lane] - b[lane])
    }

    #[inline(always)]
    fn mul(self, a: Self::F64s, b: Self::F64s) -> Self::F64s {
        from_fn(|lane| a[lane] * b[lane])
    }

    #[inline(always)]
    fn abs(self, a: Self::F64s) -> Self::F64s {
        a.map(f64::abs)
    }

    #[inline(always)]
    fn larger(self, a: Self::F64s, b: Self::F64s) -> Self::F64s {
        from_fn(|lane| larger(a[lane], b[lane]))
    }

    #[inline(always)]
    fn if_at_most(self, a: Self::F64s, b: Self::F64s, x: Self::F64s, y: Self::F64s) -> Self::F64s {
        from_fn(|lane| if a[lane] <= b[lane] { x[lane] } else { y[lane] })
    }

    #[inline(always)]
    fn at_most(self, a: Self::F64s, b: Self::F64s) -> u32 {
        (0..N).fold(0, |bits, lane| bits | u32::from(a[lane] <= b[lane]) << lane)
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) use x86_64::{Avx2, Avx512};

#[cfg(target_arch = "x86_64")]
mod x86_64 {
    #[allow(clippy::wildcard_imports, reason = "the instructions have their set in their names")]
    use std::arch::x86_64::*;

    use super::{FEW, LANES, Numbers, Vectors};

    /// The vectors of a set of instructions; there is a value of `$token` only where the processor has the set.
    macro_rules! vectors {
        (
            $token:ident, [$($lanes:ident),*], $vector:ty, $width:literal, $load:ident, $store:ident, $splat:ident,
            $add:ident, $sub:ident, $mul:ident, $larger:ident, $and_not:ident, |$a:ident, $b:ident| $at_most:expr,
            |$c:ident, $d:ident, $x:ident, $y:ident| $if_at_most:expr
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

            impl Vectors for $token {
                type Few = Self;

                #[inline(always)]
                fn few(self) -> Self {
                    self
                }
            }

            $(
                // SAFETY of each block: `self` says that the processor has the set; `$width` divides `$lanes`, the
                // numbers of the array; vectors hold their numbers one after another, and `number` asks whether there
                // are so many.
                impl Numbers<$lanes> for $token {
                    type F64s = [$vector; $lanes / $width];

                    #[inline(always)]
                    fn load(self, from: &[f64; $lanes]) -> Self::F64s {
                        let mut to = Numbers::<$lanes>::splat(self, 0.0);
                        for i in 0..$lanes / $width {
                            to[i] = unsafe { $load(from.as_ptr().add($width * i)) };
                        }
                        to
                    }

                    #[inline(always)]
                    fn store(self, from: Self::F64s) -> [f64; $lanes] {
                        let mut to = [0.0; $lanes];
                        for i in 0..$lanes / $width {
                            unsafe { $store(to.as_mut_ptr().add($width * i), from[i]) };
                        }
                        to
                    }

                    #[inline(always)]
                    fn number(self, from: &Self::F64s, place: usize) -> f64 {
                        assert!(place < $lanes);
                        unsafe { from.as_ptr().cast::<f64>().add(place).read() }
                    }

                    #[inline(always)]
                    fn splat(self, number: f64) -> Self::F64s {
                        [unsafe { $splat(number) }; $lanes / $width]
                    }

                    #[inline(always)]
                    fn add(self, mut a: Self::F64s, b: Self::F64s) -> Self::F64s {
                        for i in 0..$lanes / $width {
                            a[i] = unsafe { $add(a[i], b[i]) };
                        }
                        a
                    }

                    #[inline(always)]
                    fn sub(self, mut a: Self::F64s, b: Self::F64s) -> Self::F64s {
                        for i in 0..$lanes / $width {
                            a[i] = unsafe { $sub(a[i], b[i]) };
                        }
                        a
                    }

                    #[inline(always)]
                    fn mul(self, mut a: Self::F64s, b: Self::F64s) -> Self::F64s {
                        for i in 0..$lanes / $width {
                            a[i] = unsafe { $mul(a[i], b[i]) };
                        }
                        a
                    }

                    #[inline(always)]
                    fn abs(self, mut a: Self::F64s) -> Self::F64s {
                        for i in 0..$lanes / $width {
                            a[i] = unsafe { $and_not($splat(-0.0), a[i]) };
                        }
                        a
                    }

                    #[inline(always)]
                    fn larger(self, mut a: Self::F64s, b: Self::F64s) -> Self::F64s {
                        for i in 0..$lanes / $width {
                            a[i] = unsafe { $larger(a[i], b[i]) };
                        }
                        a
                    }

                    #[inline(always)]
                    fn if_at_most(self, a: Self::F64s, b: Self::F64s, x: Self::F64s, mut y: Self::F64s) -> Self::F64s {
                        for i in 0..$lanes / $width {
                            let ($c, $d, $x, $y) = (a[i], b[i], x[i], y[i]);
                            y[i] = unsafe { $if_at_most };
                        }
                        y
                    }

                    #[inline(always)]
                    fn at_most(self, a: Self::F64s, b: Self::F64s) -> u32 {
                        let mut bits = 0;
                        for i in 0..$lanes / $width {
                            let ($a, $b) = (a[i], b[i]);
                            bits |= unsafe { $at_most } << ($width * i);
                        }
                        bits
                    }
                }
            )*
        };
    }

    vectors!(
        Avx2,
        [LANES, FEW],
        __m256d,
        4,
        _mm256_loadu_pd,
        _mm256_storeu_pd,
        _mm256_set1_pd,
        _mm256_add_pd,
        _mm256_sub_pd,
        _mm256_mul_pd,
        _mm256_max_pd,
        _mm256_andnot_pd,
        |a, b| _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LE_OQ>(a, b)).cast_unsigned(),
        |a, b, x, y| _mm256_blendv_pd(y, x, _mm256_cmp_pd::<_CMP_LE_OQ>(a, b))
    );
    vectors!(
        Avx512,
        [LANES, FEW],
        __m512d,
        8,
        _mm512_loadu_pd,
        _mm512_storeu_pd,
        _mm512_set1_pd,
        _mm512_add_pd,
        _mm512_sub_pd,
        _mm512_mul_pd,
        _mm512_max_pd,
        _mm512_andnot_pd,
        |a, b| u32::from(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b)),
        |a, b, x, y| _mm512_mask_blend_pd(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b), y, x)
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{InstructionSet, Instructions, Work};

    /// All operations on two arrays, and on the first half of each.
    struct All([f64; LANES], [f64; LANES]);

    type Results<const N: usize> = ([[u64; N]; 7], [u32; 2]);

    fn all<const N: usize>(vectors: impl Numbers<N>, a: &[f64; N], b: &[f64; N]) -> Results<N> {
        let (a, b, fourth) = (vectors.load(a), vectors.load(b), vectors.splat(b[3]));
        let results = [
            vectors.add(a, b),
            vectors.sub(a, b),
            vectors.mul(a, b),
            fourth,
            vectors.abs(a),
            vectors.larger(a, b),
            vectors.if_at_most(a, b, fourth, a),
        ];
        for x in &results {
            let bits: [u64; N] = from_fn(|place| vectors.number(x, place).to_bits());
            assert_eq!(bits, vectors.store(*x).map(f64::to_bits));
        }
        (results.map(|x| vectors.store(x).map(f64::to_bits)), [vectors.at_most(a, b), vectors.at_most(b, a)])
    }

    impl Work for All {
        type Output = (Results<LANES>, Results<FEW>);

        fn run<V: Vectors>(self, vectors: V) -> Self::Output {
            let few = |numbers: &[f64; LANES]| *numbers.first_chunk::<FEW>().unwrap();
            (all(vectors, &self.0, &self.1), all(vectors.few(), &few(&self.0), &few(&self.1)))
        }
    }

    fn assert_number_by_number<const N: usize>((results, places): Results<N>, a: &[f64; N], b: &[f64; N]) {
        let bits = |operation: fn(f64, f64) -> f64| -> [u64; N] { from_fn(|i| operation(a[i], b[i]).to_bits()) };
        let at_most = |a: &[f64; N], b: &[f64; N]| -> u32 { (0..N).filter(|&i| a[i] <= b[i]).map(|i| 1 << i).sum() };
        let is_nan = |bits: u64| f64::from_bits(bits).is_nan();
        let expected = [
            bits(|a, b| a + b),
            bits(|a, b| a - b),
            bits(|a, b| a * b),
            [b[3].to_bits(); N],
            bits(|a, _| a.abs()),
            bits(larger),
            from_fn(|i| if a[i] <= b[i] { b[3] } else { a[i] }.to_bits()),
        ];
        for (result, expected) in results.iter().flatten().zip(expected.iter().flatten()) {
            assert!(result == expected || (is_nan(*result) && is_nan(*expected)));
        }
        assert_eq!(places, [at_most(a, b), at_most(b, a)]);
    }

    #[test]
    fn every_set_computes_number_by_number() {
        let a =
            [0.0, -0.0, 1.0, -1.5, 1e-310, 1e308, f64::INFINITY, f64::NAN, 0.1, 0.2, 0.3, 1e16, -7.0, 2.0, 5e-324, 3.0];
        for turn in 0..LANES {
            let mut b = a;
            b.rotate_left(turn);
            for set in InstructionSet::available() {
                let (many, few) = Instructions::from_set(set).unwrap().run(All(a, b));
                assert_number_by_number(many, &a, &b);
                assert_number_by_number(few, a.first_chunk().unwrap(), b.first_chunk().unwrap());
            }
        }
    }
}
