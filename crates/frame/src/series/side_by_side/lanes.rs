//! Numbers and series of several motions.

use uplift_instructions::larger;
use uplift_taylor::{ORDER, TRUNCATION};

/// Motions side by side.
pub(crate) const LANES: usize = 8;

pub(super) type Lanes = [f64; LANES];

/// Coefficients of each motion.
pub(super) type Series = [Lanes; ORDER + 1];

pub(super) const ZERO: Lanes = [0.0; LANES];

/// A value of each motion. `array::from_fn` is not always inlined.
#[inline(always)]
pub(super) fn lanes(of: impl Fn(usize) -> f64) -> Lanes {
    let mut all = ZERO;
    for (lane, own) in all.iter_mut().enumerate() {
        *own = of(lane);
    }
    all
}

/// [`Convergence`](crate::series) of one series of each motion: 1 where the last two terms are negligible.
pub(super) struct Convergence {
    largest: Lanes,
    last: Lanes,
}

impl Convergence {
    #[inline(always)]
    pub(super) fn from(first: Lanes) -> Self {
        let first = lanes(|i| first[i].abs());
        Self { largest: first, last: first }
    }

    #[inline(always)]
    pub(super) fn take(&mut self, terms: &Lanes) -> Lanes {
        let terms = lanes(|i| terms[i].abs());
        self.largest = lanes(|i| larger(terms[i], self.largest[i]));
        let negligible: Lanes = lanes(|i| {
            let least = TRUNCATION * self.largest[i];
            if terms[i] <= least && self.last[i] <= least { 1.0 } else { 0.0 }
        });
        self.last = terms;
        negligible
    }
}

/// Coefficients `k` of products, summed in the order of [`uplift_taylor::Factors`].
#[inline(always)]
pub(super) fn products<const N: usize>(factors: [(&Series, &Series); N], k: usize) -> [Lanes; N] {
    let mut sums = inner_products(factors, k);
    for (sum, (a, b)) in sums.iter_mut().zip(factors) {
        *sum = if k == 0 {
            lanes(|i| a[0][i] * b[0][i])
        } else {
            lanes(|i| sum[i] + a[0][i] * b[k][i] + a[k][i] * b[0][i])
        };
    }
    sums
}

/// The same without the terms of the first coefficients.
#[inline(always)]
pub(super) fn inner_products<const N: usize>(factors: [(&Series, &Series); N], k: usize) -> [Lanes; N] {
    let mut sums = [ZERO; N];
    for j in 1..k {
        for (sum, (a, b)) in sums.iter_mut().zip(factors) {
            *sum = lanes(|i| sum[i] + a[j][i] * b[k - j][i]);
        }
    }
    sums
}

/// 1 or −1; 0 of zero.
#[inline(always)]
pub(super) fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

/// The coefficient `k` of the product with a straight line.
#[inline(always)]
pub(super) fn line([begin, change]: &[Lanes; 2], series: &[Lanes], k: usize) -> Lanes {
    if k == 0 {
        lanes(|i| begin[i] * series[0][i])
    } else {
        lanes(|i| begin[i] * series[k][i] + change[i] * series[k - 1][i])
    }
}

/// [`uplift_taylor::product`] of each motion.
#[inline(always)]
pub(super) fn product(a: &[Lanes], b: &[Lanes], k: usize) -> Lanes {
    let mut sum = [-0.0; LANES];
    for j in 0..=k {
        sum = lanes(|i| sum[i] + a[j][i] * b[k - j][i]);
    }
    sum
}
