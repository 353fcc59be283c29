//! Stumpff functions: one formula for harmonic, parabolic and hyperbolic motion.
//!
//! `c_n(x) = Σ_j (−x)^j/(2j + n)!`, so with `x = k t²` and `z = √x`: `c0 = cos z`, `c1 = sin z/z`,
//! `c2 = (1 − cos z)/z²`, `c3 = (z − sin z)/z³` where `k > 0`; `cosh` and `sinh` where `k < 0`; `1, 1, 1/2, 1/6` where
//! `k = 0`. They stay accurate where the differences of trigonometric functions cancel.
//!
//! # Source
//! K. Stumpff, Himmelsmechanik I (1959), as used in universal-variable orbit propagation.

/// The functions `c0…c3` at one argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stumpff {
    /// `cos z`.
    pub c0: f64,
    /// `sin z/z`.
    pub c1: f64,
    /// `(1 − cos z)/z²`.
    pub c2: f64,
    /// `(z − sin z)/z³`.
    pub c3: f64,
}

/// Largest arguments of the series and the terms that suffice up to there: the first one left out is
/// below 2e-17 of the sum.
pub(crate) const NEAR: f64 = 0.1;
pub(crate) const NEAR_TERMS: usize = 6;
const MIDDLE: f64 = 1.0;
const MIDDLE_TERMS: usize = 10;
/// Beyond this one the closed forms lose at most two bits.
const SERIES_LIMIT: f64 = 9.0;
const TERMS: usize = 14;

const fn inverse_factorials() -> [(f64, f64); TERMS] {
    let mut table = [(0.0, 0.0); TERMS];
    let mut factorial = 1.0; // n! is exact up to 22!, and its inverse is rounded once
    let mut j = 0;
    let mut n = 1.0;
    while j < TERMS {
        n += 1.0;
        factorial *= n;
        let even = 1.0 / factorial;
        n += 1.0;
        factorial *= n;
        table[j] = (even, 1.0 / factorial);
        j += 1;
    }
    table
}

impl Stumpff {
    /// `1/(2j + 2)!` and `1/(2j + 3)!` for `j = 0, 1, …`.
    pub(crate) const TABLE: [(f64, f64); TERMS] = inverse_factorials();

    /// The functions at `x = k t²`.
    #[inline(always)]
    pub fn at(x: f64) -> Self {
        if x == 0.0 {
            Self { c0: 1.0, c1: 1.0, c2: 0.5, c3: 1.0 / 6.0 }
        } else if x.abs() <= NEAR {
            Self::series::<NEAR_TERMS>(x)
        } else {
            Self::at_large(x)
        }
    }

    /// The functions near zero, where the fewest terms suffice; `None` elsewhere.
    #[inline(always)]
    pub(crate) fn near_zero(x: f64) -> Option<Self> {
        (x.abs() <= NEAR).then(|| Self::series::<NEAR_TERMS>(x))
    }

    /// An even number of terms that suffice up to `abs(x)`, if there is one.
    pub(crate) fn terms(x: f64) -> Option<usize> {
        match x.abs() {
            size if size <= NEAR => Some(NEAR_TERMS),
            size if size <= MIDDLE => Some(MIDDLE_TERMS),
            size if size <= SERIES_LIMIT => Some(TERMS),
            _ => None,
        }
    }

    #[inline(always)]
    fn at_large(x: f64) -> Self {
        match x.abs() {
            size if size <= MIDDLE => return Self::series::<MIDDLE_TERMS>(x),
            size if size <= SERIES_LIMIT => return Self::series::<TERMS>(x),
            _ => {}
        }
        let z = x.abs().sqrt();
        let (c0, c1) = if x > 0.0 { (z.cos(), z.sin() / z) } else { (z.cosh(), z.sinh() / z) };
        Self { c0, c1, c2: (1.0 - c0) / x, c3: (1.0 - c1) / x }
    }

    /// Both series to `N` terms, `N` even: by pairs of terms and then Horner in `x²`, which halves the
    /// chain of dependent operations.
    #[inline(always)]
    pub(crate) fn series<const N: usize>(x: f64) -> Self {
        let square = x * x;
        let (mut c2, mut c3) = (0.0, 0.0);
        for pair in Self::TABLE[..N].chunks_exact(2).rev() {
            c2 = (pair[0].0 - x * pair[1].0) + square * c2;
            c3 = (pair[0].1 - x * pair[1].1) + square * c3;
        }
        Self { c0: 1.0 - x * c2, c1: 1.0 - x * c3, c2, c3 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn series_meets_closed_forms_at_the_limit() {
        for x in [0.1, -0.1, 1.0, -1.0, SERIES_LIMIT, -SERIES_LIMIT] {
            let series = Stumpff::at(x);
            let closed = Stumpff::at(x * (1.0 + f64::EPSILON));
            for (a, b) in
                [(series.c0, closed.c0), (series.c1, closed.c1), (series.c2, closed.c2), (series.c3, closed.c3)]
            {
                assert!((a - b).abs() < 1e-15 * b.abs().max(1.0), "{a} {b}");
            }
        }
    }

    proptest! {
        // Identities that hold for every x: c0 + x c2 = 1, c1 + x c3 = 1, c0² + x c1² = 1 and c2 = c1(x/4)²/2.
        #[test]
        fn identities(x in -30.0_f64..60.0) {
            let s = Stumpff::at(x);
            let size = s.c0.abs().max(1.0);
            prop_assert!((s.c0 * s.c0 + x * s.c1 * s.c1 - 1.0).abs() < 1e-14 * size * size);
            prop_assert!((s.c0 + x * s.c2 - 1.0).abs() < 1e-14 * size);
            prop_assert!((s.c1 + x * s.c3 - 1.0).abs() < 1e-14 * size);
            let half = Stumpff::at(x / 4.0).c1;
            prop_assert!((s.c2 - 0.5 * half * half).abs() < 4e-15 * size);
        }
    }
}
