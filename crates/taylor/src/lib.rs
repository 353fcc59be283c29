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
pub fn stretch(c: &mut [f64], ratio: f64) {
    let mut power = 1.0;
    for c in c {
        *c *= power;
        power *= ratio;
    }
}

/// `Σ aⱼ bₖ₋ⱼ`, j from 0 to k: the coefficient of the product of two series.
#[inline]
pub fn product(a: &[f64], b: &[f64], k: usize) -> f64 {
    let (a, b) = (&a[..=k], &b[..=k]);
    // two sums, so that one addition need not wait for the other
    let (pairs, last) = a.as_chunks::<2>();
    let (turned_last, turned) = b.as_rchunks::<2>();
    let mut sums = [0.0; 2];
    for (a, b) in pairs.iter().zip(turned.iter().rev()) {
        sums[0] += a[0] * b[1];
        sums[1] += a[1] * b[0];
    }
    let rest: f64 = last.iter().zip(turned_last).map(|(a, b)| a * b).sum();
    sums[0] + sums[1] + rest
}

/// The same without the terms of `a₀` and `b₀`, which an implicit recurrence has on its other side.
#[inline]
pub fn inner_product(a: &[f64], b: &[f64], k: usize) -> f64 {
    if k < 2 { 0.0 } else { product(&a[1..k], &b[1..k], k - 2) }
}
