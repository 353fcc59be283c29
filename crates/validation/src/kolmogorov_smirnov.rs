//! The two-sample test of Kolmogorov and Smirnov: `D`, the largest distance of two empirical distributions.
//!
//! Its p is offered by three rules, since programs differ:
//!
//! * exact: of all orders of the pooled values, as many as have a distance of `D` or more, by counting lattice paths.
//!   With ties it is conservative: the distance is over distinct values, the paths are those of values without ties.
//!   Beyond 10⁷ pairs of values it is Kolmogorov's, to which it tends;
//! * Kolmogorov's: that of one sample of `n₁n₂/(n₁ + n₂)` values (rounded) against a continuous distribution;
//! * that of MATLAB's `kstest2`: the limit for many values with `λ = (√n + 0.12 + 0.11/√n) D`, `n = n₁n₂/(n₁ + n₂)`,
//!   `p = 2 Σ (−1)^(j−1) exp(−2 j² λ²)`, which Table 6.2 prints.
//!
//! The test supposes independent samples. Peaks of the same motions are not: where both go up and down together the
//! distance is smaller than between independent ones, and p too large.
//!
//! # Source
//! M. A. Stephens (1970), "Use of the Kolmogorov–Smirnov, Cramér–von Mises and related statistics without extensive
//! tables"; G. Marsaglia, W. W. Tsang and J. Wang (2003), "Evaluating Kolmogorov's distribution"; J. L. Hodges (1958),
//! "The significance probability of the Smirnov two-sample test".

use crate::sample::{Sample, distinct};

/// Size above which Kolmogorov's distribution is that of the limit.
const MANY: usize = 2000;

/// Pairs of values beyond which no paths are counted: a tenth of a second.
const MOST_PAIRS: usize = 10_000_000;
/// `n d²` beyond which both sides of a distance are not so large together: p is below 1e-15.
const FAR: f64 = 18.0;

/// Distance and p.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct KolmogorovSmirnov {
    /// `D`.
    pub distance: f64,
    /// p, exact where `is_exact` says so, else Kolmogorov's.
    pub p_exact: f64,
    /// Whether `p_exact` is.
    pub is_exact: bool,
    /// p by Kolmogorov's distribution.
    pub p_kolmogorov: f64,
    /// p by the formula of `kstest2`.
    pub p_kstest2: f64,
    /// Whether values are equal: the exact p is then conservative.
    pub has_ties: bool,
}

impl KolmogorovSmirnov {
    /// Of two samples, both sides.
    pub fn from_samples(one: &Sample, other: &Sample) -> Self {
        let (n, m) = (one.len(), other.len());
        let (steps, has_ties) = largest_distance(one, other);
        let distance = steps as f64 / (n * m) as f64;
        Self {
            distance,
            p_exact: best_p(n, m, steps),
            is_exact: is_exact(n, m),
            p_kolmogorov: two_sample_kolmogorov_p(n, m, distance),
            p_kstest2: kstest2_p(n, m, distance),
            has_ties,
        }
    }

    /// `D` alone.
    pub fn distance_of(one: &Sample, other: &Sample) -> f64 {
        largest_distance(one, other).0 as f64 / (one.len() * other.len()) as f64
    }

    /// The least distance whose exact p is at most `level` for samples of `n` and `m` values; +∞ where even 1 is not.
    pub fn critical_distance(n: usize, m: usize, level: f64) -> f64 {
        let (mut low, mut high) = (0, n * m);
        if best_p(n, m, high) > level {
            return f64::INFINITY;
        }
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            if best_p(n, m, middle) > level { low = middle } else { high = middle }
        }
        high as f64 / (n * m) as f64
    }
}

/// `D` in units of `1/(n m)`, a whole number, and whether values are equal.
fn largest_distance(one: &Sample, other: &Sample) -> (usize, bool) {
    let (n, m) = (one.len(), other.len());
    let (mut i, mut j, mut steps) = (0_usize, 0_usize, 0_usize);
    let mut has_ties = false;
    for (_, of_one, of_other) in distinct(one, other) {
        (i, j) = (i + of_one, j + of_other);
        steps = steps.max((i * m).abs_diff(j * n));
        has_ties |= of_one + of_other > 1;
    }
    (steps, has_ties)
}

/// p of a distance by the formula of `kstest2` for samples of `n` and `m` values.
pub fn kstest2_p(n: usize, m: usize, distance: f64) -> f64 {
    let size = (n as f64 * m as f64 / (n + m) as f64).sqrt();
    limit_p((size + 0.12 + 0.11 / size) * distance)
}

/// `2 Σ (−1)^(j−1) exp(−2 j² λ²)`.
fn limit_p(lambda: f64) -> f64 {
    // below, the sum is 1 to the last digit, and its terms do not fall
    if lambda < 0.05 {
        return 1.0;
    }
    let mut sum = 0.0;
    let mut sign = 1.0;
    for j in 1..=1000 {
        let term = (-2.0 * (f64::from(j) * lambda).powi(2)).exp();
        sum += sign * term;
        sign = -sign;
        if term < 1e-18 {
            break;
        }
    }
    (2.0 * sum).clamp(0.0, 1.0)
}

/// Whether the orders of so many values are few enough to count.
fn is_exact(n: usize, m: usize) -> bool {
    n.saturating_mul(m) <= MOST_PAIRS
}

/// p of a distance of `steps/(n m)`: exact, or Kolmogorov's where that would take long.
fn best_p(n: usize, m: usize, steps: usize) -> f64 {
    if is_exact(n, m) {
        exact_p(n, m, steps)
    } else {
        two_sample_kolmogorov_p(n, m, steps as f64 / (n as f64 * m as f64))
    }
}

/// p of a distance by Kolmogorov's distribution of `n m/(n + m)` values.
fn two_sample_kolmogorov_p(n: usize, m: usize, distance: f64) -> f64 {
    kolmogorov_p(((n * m) as f64 / (n + m) as f64).round_ties_even(), distance)
}

/// Probability that the path of a random order of `n` and `m` values is somewhere `steps` or more from the diagonal, in
/// units of `1/(n m)`: all first passages are added, so that small p keep their digits.
fn exact_p(n: usize, m: usize, steps: usize) -> f64 {
    if steps == 0 {
        return 1.0;
    }
    let is_outside = |i: usize, j: usize| (i * m).abs_diff(j * n) >= steps;
    // inside[j]: probability that the path is at (i, j) and was never outside
    let mut inside = vec![0.0; m + 1];
    let mut outside = 0.0;
    inside[0] = 1.0;
    for i in 0..=n {
        for j in 0..=m {
            let here = inside[j];
            if here == 0.0 || (i == n && j == m) {
                continue;
            }
            let left = (n - i + m - j) as f64;
            let (along, across) = (here * (m - j) as f64 / left, here * (n - i) as f64 / left);
            if j < m {
                if is_outside(i, j + 1) { outside += along } else { inside[j + 1] += along }
            }
            // the place of (i, j) is that of (i + 1, j) from here on
            inside[j] = 0.0;
            if i < n {
                if is_outside(i + 1, j) { outside += across } else { inside[j] = across }
            }
        }
    }
    outside.min(1.0)
}

/// P(D ≥ d) of one sample of `n` values against a continuous distribution.
fn kolmogorov_p(n: f64, d: f64) -> f64 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a rounded count
    let count = n as usize;
    if count == 0 || d <= 0.0 {
        return 1.0;
    }
    if d >= 1.0 {
        return 0.0;
    }
    if count > MANY {
        return limit_p(n.sqrt() * d);
    }
    if d >= 0.5 || n * d * d > FAR { 2.0 * one_sided_p(count, d) } else { 1.0 - kolmogorov_cdf(count, d) }
}

/// P(D⁺ ≥ d) (Smirnov); where d ≥ ½, D⁺ and D⁻ are not both so large.
fn one_sided_p(n: usize, d: f64) -> f64 {
    let count = n as f64;
    let mut sum = 0.0;
    let mut log_binomial = 0.0_f64;
    for j in 0..n {
        let share = j as f64 / count;
        let left = 1.0 - d - share;
        if left <= 0.0 {
            break;
        }
        sum += (log_binomial + (j as f64 - 1.0) * (d + share).ln() + (n - j) as f64 * left.ln()).exp();
        log_binomial += ((n - j) as f64 / (j + 1) as f64).ln();
    }
    (d * sum).min(1.0)
}

/// P(D < d): the element of a power of a matrix (Marsaglia, Tsang and Wang).
fn kolmogorov_cdf(n: usize, d: f64) -> f64 {
    let scaled = n as f64 * d;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // below n
    let k = scaled as usize + 1;
    let (size, h) = (2 * k - 1, k as f64 - scaled);
    let at = |i: usize, j: usize| i * size + j;
    let mut matrix = vec![0.0; size * size];
    for i in 0..size {
        for j in 0..size {
            matrix[at(i, j)] = if i + 1 >= j { 1.0 } else { 0.0 };
        }
    }
    for i in 0..size {
        let power = |exponent: usize| h.powi(i32::try_from(exponent).unwrap_or(i32::MAX));
        matrix[at(i, 0)] -= power(i + 1);
        matrix[at(size - 1, i)] -= power(size - i);
    }
    if 2.0 * h - 1.0 > 0.0 {
        matrix[at(size - 1, 0)] += (2.0 * h - 1.0).powi(i32::try_from(size).unwrap_or(i32::MAX));
    }
    for i in 0..size {
        for j in 0..=i {
            for factor in 1..=i + 1 - j {
                matrix[at(i, j)] /= factor as f64;
            }
        }
    }
    // the power, its largest element held near one; the binary exponent beside it
    let (mut result, mut exponent) = (identity(size), 0);
    for bit in (0..usize::BITS - n.leading_zeros()).rev() {
        result = multiply(&result, &result, size);
        exponent *= 2;
        if n >> bit & 1 == 1 {
            result = multiply(&result, &matrix, size);
        }
        let middle = result[at(k - 1, k - 1)];
        if middle > 1e100 {
            for value in &mut result {
                *value *= 1e-100;
            }
            exponent += 100;
        }
    }
    let mut value = result[at(k - 1, k - 1)];
    for i in 1..=n {
        value *= i as f64 / n as f64;
        if value < 1e-100 {
            value *= 1e100;
            exponent -= 100;
        }
    }
    (value * 10.0_f64.powi(exponent)).clamp(0.0, 1.0)
}

fn identity(size: usize) -> Vec<f64> {
    (0..size * size).map(|index| f64::from(u8::from(index / size == index % size))).collect()
}

fn multiply(a: &[f64], b: &[f64], size: usize) -> Vec<f64> {
    let mut product = vec![0.0; size * size];
    for (row, of_product) in a.chunks_exact(size).zip(product.chunks_exact_mut(size)) {
        for (a, row) in row.iter().zip(b.chunks_exact(size)).filter(|(a, _)| **a != 0.0) {
            for (product, b) in of_product.iter_mut().zip(row) {
                *product += a * b;
            }
        }
    }
    product
}

/// What a p says, in the words of Table 6.1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Evidence {
    /// p < 0.01.
    VeryStrong,
    /// 0.01 ≤ p < 0.05.
    Strong,
    /// 0.05 ≤ p < 0.10.
    MediumWeak,
    /// p ≥ 0.10.
    SmallOrNone,
}

impl Evidence {
    /// That of a p.
    pub fn from_p(p: f64) -> Self {
        match p {
            p if p < 0.01 => Self::VeryStrong,
            p if p < 0.05 => Self::Strong,
            p if p < 0.10 => Self::MediumWeak,
            _ => Self::SmallOrNone,
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::VeryStrong => "very strong",
            Self::Strong => "strong",
            Self::MediumWeak => "medium to weak",
            Self::SmallOrNone => "small or none",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where paths are no longer counted, p goes on as it was, to 3 %.
    #[test]
    fn many_values_have_the_p_of_the_limit() {
        for (n, m) in [(3000, 3000), (100_000, 99)] {
            for lambda in [0.6, 0.9, 1.2, 1.6, 2.0] {
                let size = (n * m) as f64 / (n + m) as f64;
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a count
                let steps = (lambda / size.sqrt() * (n * m) as f64) as usize;
                let (exact, kolmogorov) =
                    (exact_p(n, m, steps), two_sample_kolmogorov_p(n, m, steps as f64 / (n * m) as f64));
                assert!((kolmogorov / exact - 1.0).abs() < 0.03, "{n} {m} {lambda}: {kolmogorov} beside {exact}");
            }
        }
    }

    #[test]
    fn many_values_take_no_longer() {
        let values = |shift: f64| Sample::new((0..200_000).map(|i| f64::from(i) + shift).collect()).unwrap();
        let begin = std::time::Instant::now();
        let found = KolmogorovSmirnov::from_samples(&values(0.0), &values(800.5));
        assert!(!found.is_exact && (found.distance - 0.004_005).abs() < 1e-12, "{found:?}");
        assert!((found.p_exact / found.p_kstest2 - 1.0).abs() < 0.02, "{found:?}");
        let critical = KolmogorovSmirnov::critical_distance(200_000, 2000, 0.1);
        assert!((critical / (1.2238 / (2000.0_f64 / 1.01).sqrt()) - 1.0).abs() < 0.02, "{critical}");
        assert!(begin.elapsed().as_secs() < 30);
    }
}
