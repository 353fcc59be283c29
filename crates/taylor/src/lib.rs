//! What the Taylor-series integrators of rocking bodies share.
//!
//! | module | what is in it |
//! |---|---|
//! | [`polynomial`] | every sign change of a polynomial on `[0, 1]`: impacts, uplifts, thresholds and peaks on a step |
//! | [`forcing`] | ground acceleration on a step, in powers of the step |
//! | [`rebound`] | the proof that a chattering body comes to rest |
//!
//! A step is a power series in `s = time/step` from 0 to 1, of degree [`DEGREE`] at most.

pub mod forcing;
pub mod polynomial;
pub mod rebound;

use std::array::from_fn;

pub use forcing::Forcing;
pub use polynomial::{DEGREE, first_sign_change, first_zero, leading_sign, sign_changes, value};
pub use rebound::Rebound;

/// Highest power in the series of a velocity; the rotation has one more.
pub const ORDER: usize = DEGREE - 1;

/// Terms below this part of the largest are left out of a series: half a rounding.
pub const TRUNCATION: f64 = 0.5 * f64::EPSILON;

/// Lowest order that a series is accepted at: an odd or even one has every other term zero.
pub const LEAST_ORDER: usize = 4;

/// The coefficients `c` in powers of `s/ratio`: of the same function on a step `ratio` times as long.
#[inline]
pub fn stretch(c: &mut [f64], ratio: f64) {
    let mut power = 1.0;
    for c in c {
        *c *= power;
        power *= ratio;
    }
}

/// `Σ aⱼ bₖ₋ⱼ`, j from 0 to k: the coefficient of the product of two series.
#[inline(always)]
pub fn product(a: &[f64], b: &[f64], k: usize) -> f64 {
    a[..=k].iter().zip(b[..=k].iter().rev()).map(|(a, b)| a * b).sum()
}

/// Factors of several products of two series side by side, a lane for each product.
#[derive(Debug, Clone)]
pub struct Factors<const N: usize> {
    first: [[f64; N]; DEGREE + 1],
    second: [[f64; N]; DEGREE + 1],
}

impl<const N: usize> Default for Factors<N> {
    fn default() -> Self {
        Self { first: [[0.0; N]; DEGREE + 1], second: [[0.0; N]; DEGREE + 1] }
    }
}

impl<const N: usize> Factors<N> {
    /// `Σ aⱼ bₖ₋ⱼ`, j from 0 to k, of each lane, with the coefficients `k` of the factors given: those before are
    /// what was given before. Nothing but the two last additions waits for what is given.
    ///
    /// # Panics
    /// If `k` is above [`DEGREE`].
    #[inline(always)]
    pub fn products(&mut self, first: [f64; N], second: [f64; N], k: usize) -> [f64; N] {
        let sums = if k == 0 {
            from_fn(|i| first[i] * second[i])
        } else {
            let between = self.first[1..k].iter().zip(self.second[1..k].iter().rev());
            let sums: [f64; N] = between.fold([0.0; N], |sums, (a, b)| from_fn(|i| sums[i] + a[i] * b[i]));
            let (a, b) = (self.first[0], self.second[0]);
            from_fn(|i| sums[i] + a[i] * second[i] + first[i] * b[i])
        };
        (self.first[k], self.second[k]) = (first, second);
        sums
    }

    /// Replaces the coefficients `k` of a lane's factors.
    ///
    /// # Panics
    /// If `k` is above [`DEGREE`] or `lane` not below the number of lanes.
    #[inline(always)]
    pub fn replace(&mut self, lane: usize, [first, second]: [f64; 2], k: usize) {
        (self.first[k][lane], self.second[k][lane]) = (first, second);
    }
}

/// [`product`] without the terms of `a₀` and `b₀`, which an implicit recurrence has on its other side.
#[inline]
pub fn inner_product(a: &[f64], b: &[f64], k: usize) -> f64 {
    if k < 2 { 0.0 } else { product(&a[1..k], &b[1..k], k - 2) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lanes_are_products(a in prop::array::uniform16(-3.0..3.0_f64), b in prop::array::uniform16(-3.0..3.0_f64)) {
            let mut factors = Factors::default();
            for k in 0..16 {
                let [one, square, late] = factors.products([a[k], b[k], 0.0], [b[k], b[k], 0.0], k);
                let size: f64 = (0..=k).map(|j| (a[j] * b[k - j]).abs()).sum();
                prop_assert!((one - product(&a, &b, k)).abs() <= 1e-15 * size);
                prop_assert!((square - product(&b, &b, k)).abs() <= 1e-14 * 9.0 * (k + 1) as f64);
                prop_assert!((late - inner_product(&a, &b, k)).abs() <= 1e-15 * size);
                if k > 0 {
                    factors.replace(2, [a[k], b[k]], k);
                }
            }
        }
    }
}
