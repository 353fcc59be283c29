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
    a[..=k].iter().zip(b[..=k].iter().rev()).map(|(a, b)| a * b).sum()
}

/// The coefficients `k` of several products at once, so that no addition waits for another's.
///
/// # Panics
/// Never for `k` up to [`DEGREE`].
#[inline]
pub fn products<const N: usize>(pairs: [(&[f64; DEGREE + 1], &[f64; DEGREE + 1]); N], k: usize) -> [f64; N] {
    assert!(k <= DEGREE);
    let mut sums = [0.0; N];
    // two ranges that exclude their ends: that they stay within the arrays is seen at compile time
    let terms = k + 1;
    for (j, i) in (0..terms).zip((0..terms).rev()) {
        for (sum, (a, b)) in sums.iter_mut().zip(pairs) {
            *sum += a[j] * b[i];
        }
    }
    sums
}

/// The coefficients `k` of the products of `a` and `b`, which hold their coefficients `[order][lane]`, lane by lane.
/// The sums are those of [`products`]; vectors of the processor add them.
///
/// # Panics
/// If `a` or `b` has not `k + 1` orders.
#[inline]
pub fn products_by_lane<const N: usize>(a: &[[f64; N]], b: &[[f64; N]], k: usize) -> [f64; N] {
    let mut sums = [0.0; N];
    for (a, b) in a[..=k].iter().zip(b[..=k].iter().rev()) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums
}

/// The same without the terms of `a₀` and `b₀`, which an implicit recurrence has on its other side.
#[inline]
pub fn inner_product(a: &[f64], b: &[f64], k: usize) -> f64 {
    if k < 2 { 0.0 } else { product(&a[1..k], &b[1..k], k - 2) }
}
