//! The two-sample test of Cramér and von Mises: the squared distance of two empirical distributions.
//!
//! `T = U/(n m N) − (4 n m − 1)/(6 N)`, `N = n + m`, with `U = n Σ (rᵢ − i)² + m Σ (sⱼ − j)²` of the ranks `r`, `s`
//! of the two samples among all, midranks where values are equal.
//!
//! p is exact, over all orders, for samples of at most 20 values without ties, else by the limit distribution with the
//! first two moments of `T`.
//!
//! # Source
//! T. W. Anderson (1962), "On the distribution of the two-sample Cramér–von Mises criterion"; S. Csörgő and
//! J. J. Faraway (1996), "The exact and asymptotic distributions of Cramér–von Mises statistics", Eq. 1.3.

use std::collections::BTreeMap;

use statrs::function::gamma::ln_gamma;

use crate::sample::{Sample, distinct};

/// Largest size of samples whose p is exact by itself.
const FEW: usize = 20;

/// Statistic and p.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct CramerVonMises {
    /// `T`.
    pub statistic: f64,
    /// p by the rule that `is_exact` says.
    pub p: f64,
    /// Whether p is exact.
    pub is_exact: bool,
    /// p by the limit distribution.
    pub p_limit: f64,
}

impl CramerVonMises {
    /// Of two samples.
    pub fn from_samples(one: &Sample, other: &Sample) -> Self {
        let values = distinct(one, other);
        let (n, m) = (one.len(), other.len());
        let mut sums = [0.0; 2];
        let (mut below, mut counts) = (0.0, [0.0; 2]);
        let mut has_ties = false;
        for (_, of_one, of_other) in &values {
            let tied = (of_one + of_other) as f64;
            has_ties |= tied > 1.0;
            let rank = below + 0.5 * (tied + 1.0);
            for (sample, count) in [*of_one, *of_other].into_iter().enumerate() {
                for _ in 0..count {
                    counts[sample] += 1.0;
                    sums[sample] += f64::powi(rank - counts[sample], 2);
                }
            }
            below += tied;
        }
        let (nf, mf) = (n as f64, m as f64);
        let (product, total) = (nf * mf, nf + mf);
        let statistic = (nf * sums[0] + mf * sums[1]) / (product * total) - (4.0 * product - 1.0) / (6.0 * total);
        let p_limit = limit_p(nf, mf, statistic);
        let is_exact = n.max(m) <= FEW && !has_ties;
        let p = if is_exact { exact_p(n, m, statistic) } else { p_limit };
        Self { statistic, p, is_exact, p_limit }
    }
}

/// Part of all orders whose statistic is as large: `T = n m/(N L)² Σ (a i − b j)²` over the `N` places of a path, with
/// `a = L/n`, `b = L/m` and `L` their least common multiple, so that sums are whole numbers.
fn exact_p(n: usize, m: usize, statistic: f64) -> f64 {
    let multiple = n / greatest_common_divisor(n, m) * m;
    let (a, b) = (multiple / n, multiple / m);
    let total = (n + m) as f64;
    let scale = (n * m) as f64 / (total * multiple as f64).powi(2);
    // between two whole numbers, on whose side rounding does not matter
    let least = statistic / scale - 0.5;
    // row[j]: probability of each sum of paths to (i, j)
    let mut row: Vec<BTreeMap<u64, f64>> = vec![BTreeMap::new(); m + 1];
    for i in 0..=n {
        for j in 0..=m {
            if i == 0 && j == 0 {
                row[0].insert(0, 1.0);
                continue;
            }
            let step = (a * i).abs_diff(b * j) as u64;
            let left = (n + m - i - j + 1) as f64;
            let mut here: BTreeMap<u64, f64> = BTreeMap::new();
            let mut add = |from: &BTreeMap<u64, f64>, probability: f64| {
                for (sum, weight) in from {
                    *here.entry(sum + step * step).or_insert(0.0) += weight * probability;
                }
            };
            if i > 0 {
                add(&row[j], (n - i + 1) as f64 / left);
            }
            if j > 0 {
                let before = std::mem::take(&mut row[j - 1]);
                add(&before, (m - j + 1) as f64 / left);
                row[j - 1] = before;
            }
            row[j] = here;
        }
    }
    row[m].iter().filter(|(sum, _)| **sum as f64 >= least).map(|(_, weight)| weight).sum::<f64>().min(1.0)
}

fn greatest_common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}

/// p by the limit distribution, `T` brought to its mean 1/6 and variance 1/45.
fn limit_p(n: f64, m: f64, statistic: f64) -> f64 {
    let (total, product) = (n + m, n * m);
    let mean = (1.0 + 1.0 / total) / 6.0;
    let variance = (total + 1.0) * (4.0 * product * total - 3.0 * (n * n + m * m) - 2.0 * product)
        / (45.0 * total * total * 4.0 * product);
    // of one value each the statistic is the same whatever they are
    if variance <= 0.0 {
        return 1.0;
    }
    let reduced = 1.0 / 6.0 + (statistic - mean) / (45.0 * variance).sqrt();
    // below, the distribution is 0 to the last digit
    if reduced < 0.003 { 1.0 } else { (1.0 - limit_cdf(reduced)).clamp(0.0, 1.0) }
}

/// `Σ Γ(k + ½)/(k! π^{3/2} √x) √(4k + 1) e^{−q} K_{1/4}(q)`, `q = (4k + 1)²/(16x)`.
fn limit_cdf(x: f64) -> f64 {
    let mut sum = 0.0;
    for k in 0..100 {
        let k = f64::from(k);
        let y = 4.0 * k + 1.0;
        let q = y * y / (16.0 * x);
        let factor = (ln_gamma(k + 0.5) - ln_gamma(k + 1.0)).exp() / (std::f64::consts::PI.powf(1.5) * x.sqrt());
        let term = factor * y.sqrt() * (-2.0 * q).exp() * scaled_bessel_k(0.25, q);
        sum += term;
        if term < 1e-17 {
            break;
        }
    }
    sum
}

/// `e^q K_ν(q) = ∫ exp(−q (cosh t − 1)) cosh νt dt` from 0 to ∞, by the trapezoidal rule, which converges faster
/// than any power of its step for such an integrand.
fn scaled_bessel_k(order: f64, q: f64) -> f64 {
    let step = 1.0 / 64.0;
    let mut sum = 0.5;
    for i in 1..4000 {
        let t = step * f64::from(i);
        let term = (-2.0 * q * (0.5 * t).sinh().powi(2)).exp() * (order * t).cosh();
        sum += term;
        if term < 1e-18 * sum {
            break;
        }
    }
    step * sum
}
